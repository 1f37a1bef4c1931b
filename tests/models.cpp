// Models from elsewhere: what OBJ and glTF files mean, and what is said about broken ones.
#include "scene/models/model.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

#include "error.h"
#include "scene/load_scene.h"
#include "support/folder.h"
#include "support/gltf_builder.h"

namespace airlight {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const Mesh& mesh_of(const Model& model, std::size_t object = 0) {
  return std::get<Mesh>(model.objects.at(object).geometry);
}

/// Sum of the triangles' areas.
double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3<float> a = mesh.positions.at(t[0]), b = mesh.positions.at(t[1]),
                      c = mesh.positions.at(t[2]);
    sum += length(cross(b - a, c - a)) / 2;
  }
  return sum;
}

/// Sum of the triangles' area vectors: tells which way they face.
Vec3<float> facing(const Mesh& mesh) {
  Vec3<float> sum;
  for (const auto& t : mesh.triangles) {
    const Vec3<float> a = mesh.positions.at(t[0]);
    sum = sum + cross(mesh.positions.at(t[1]) - a, mesh.positions.at(t[2]) - a) * 0.5F;
  }
  return sum;
}

class Models : public ::testing::Test {
 protected:
  Model load(const std::string& name, const std::string& text) {
    return load_model(write_text(scratch_ / name, text));
  }

  /// The one line said about a broken file, without the folder.
  std::string complaint(const std::string& name, const std::string& text) {
    try {
      load(name, text);
    } catch (const Error& error) {
      std::string line = error.what();
      EXPECT_EQ(line.find('\n'), line.npos) << line;
      const std::string folder = scratch_.path().string() + "/";
      for (std::size_t at; (at = line.find(folder)) != line.npos;) line.erase(at, folder.size());
      return line;
    }
    return "accepted";
  }

  /// Writes a picture of w by h texels, all alike.
  void picture(const std::string& name, std::array<std::uint8_t, 4> rgba) {
    // The smallest format that is written by hand: TGA, 32 bits, one texel.
    std::string tga(18, '\0');
    tga[2] = 2, tga[12] = 1, tga[14] = 1, tga[16] = 32, tga[17] = 8;
    for (const int c : {2, 1, 0, 3}) tga += char(rgba[std::size_t(c)]);
    write_text(scratch_ / name, tga);
  }

  test::Folder scratch_;
};

using Obj = Models;
using Gltf = Models;

// ---- Wavefront OBJ

TEST_F(Obj, triangulates_polygons) {
  const Model quad = load("a.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(mesh_of(quad).triangles.size(), 2U);
  EXPECT_EQ(mesh_of(quad).positions.size(), 4U);
  EXPECT_NEAR(area(mesh_of(quad)), 2, 1e-6);
  // An L, which a fan around its first corner would leave.
  const Model l =
      load("b.obj", "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n");
  EXPECT_EQ(mesh_of(l).triangles.size(), 4U);
  EXPECT_NEAR(area(mesh_of(l)), 3, 1e-6);
}

TEST_F(Obj, shares_vertices_where_all_indices_agree) {
  const Model model = load("a.obj",
                           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 3\n"
                           "f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/2/1\nf -4/2/1 -2/1/-1 -1/2/1\n");
  const Mesh& mesh = mesh_of(model);
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(mesh.positions.size(), 5U);  // corner 1 has two texture coordinates
  EXPECT_EQ(mesh.normals.size(), 5U);
  EXPECT_EQ(mesh.normals[0], Vec3<float>(0, 0, 1));
  EXPECT_EQ(mesh.uvs[mesh.triangles[1][2]], (std::array<float, 2>{1, 1}));
}

TEST_F(Obj, makes_an_object_of_each_material) {
  write_text(
      scratch_ / "a.mtl",
      "newmtl red\nKd 0.8 0.1 0.2\nnewmtl glass\nKd 1 1 1\nd 0.25\nTf 0.2 0.9 0.4\nnewmtl unused\n"
      "map_Kd nowhere.png\nnewmtl thin\nKd 1\nTr 0.25\n");
  const Model model =
      load("a.obj",
           "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl glass\nf 1 2 3\nusemtl red\nf 1 2 3\n"
           "g again\nusemtl glass\nf 3 2 1\nusemtl thin\nf 1 2 3\n");
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_EQ(model.objects[0].name, "glass");
  EXPECT_EQ(mesh_of(model, 0).triangles.size(), 2U);
  EXPECT_EQ(model.objects[0].material.opacity, 0.25);
  EXPECT_NEAR(model.objects[0].material.tint.g, 0.9, 1e-7);
  EXPECT_EQ(model.objects[1].name, "red");
  EXPECT_NEAR(model.objects[1].material.albedo.r, 0.8, 1e-7);
  EXPECT_TRUE(model.objects[1].material.is_opaque());
  EXPECT_EQ(model.objects[2].material.opacity, 0.75);
  EXPECT_THAT(model.remarks, IsEmpty());
}

TEST_F(Obj, shares_textures_and_lets_alpha_cut_out) {
  picture("wood.tga", {10, 200, 30, 255});
  picture("leaf tex.tga", {10, 200, 30, 0});
  picture("mask.tga", {128, 128, 128, 255});
  write_text(scratch_ / "a.mtl",
             "newmtl a\nKd 0 0 0\nmap_Kd wood.tga\nnewmtl b\nKd 0.5 0.5 0.5\nmap_Kd -s 2 3 -o 0.5 "
             "wood.tga\n"
             "newmtl leaf\nmap_Kd .\\leaf tex.tga\nnewmtl mask\nmap_d mask.tga\nmap_Kd -clamp on "
             "wood.tga\n");
  const Model model = load("a.obj",
                           "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 1\nusemtl a\nf 1 2 "
                           "3\nusemtl b\nf 1/1 2/1 3/1\n"
                           "usemtl leaf\nf 1 2 3\nusemtl mask\nf 1 2 3\n");
  ASSERT_EQ(model.objects.size(), 4U);
  const auto material = [&](std::size_t i) { return model.objects[i].material; };
  EXPECT_EQ(material(0).albedo, Rgb<double>(1));  // black would hide the picture
  EXPECT_EQ(material(0).albedo_texture, material(1).albedo_texture);
  EXPECT_EQ(material(1).albedo, Rgb<double>(0.5));
  EXPECT_TRUE(material(0).is_opaque());
  EXPECT_EQ(material(2).opacity_texture, material(2).albedo_texture);
  EXPECT_TRUE(material(2).opacity_from_alpha);
  EXPECT_FALSE(material(3).opacity_from_alpha);
  EXPECT_FALSE(model.textures.at(std::size_t(material(3).opacity_texture)).srgb);
  EXPECT_TRUE(model.textures.at(std::size_t(material(3).albedo_texture)).srgb);
  EXPECT_EQ(model.textures.at(std::size_t(material(3).albedo_texture)).wrap_u, Wrap::clamp);
  EXPECT_EQ(model.textures.size(), 4U);
  EXPECT_EQ(mesh_of(model, 1).uvs.at(0), (std::array<float, 2>{2.5F, 3}));  // scaled, then shifted
}

TEST_F(Obj, is_grey_without_its_materials_and_says_so) {
  const Model model =
      load("a.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  EXPECT_EQ(model.objects[0].name, "a");
  EXPECT_EQ(model.objects[0].material.albedo, Rgb<double>(0.5));
  EXPECT_THAT(model.remarks,
              ElementsAre("gone.mtl is missing", "surfaces without a material are grey"));
}

TEST_F(Obj, takes_the_numbers_of_materials_as_they_are_meant_or_says_what_is_wrong) {
  const auto with_material = [&](const std::string& lines) {
    write_text(scratch_ / "a.mtl", "newmtl m\n" + lines);
    return "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
  };
  const auto complaint_of = [&](const std::string& lines) {
    return complaint("a.obj", with_material(lines));
  };
  EXPECT_EQ(complaint_of("Kd 0.1 nan 0.1\n"),
            "a.mtl:2: \"Kd 0.1 nan 0.1\" lacks numbers; accepted: three finite numbers, or one for "
            "all three");
  EXPECT_THAT(complaint_of("illum 2\nKd 0.1 0.2\n"), StartsWith("a.mtl:3: \"Kd 0.1 0.2\" lacks"));
  EXPECT_THAT(complaint_of("Kd spectral red.rfl 1\n"), StartsWith("a.mtl:2: \"Kd spectral"));
  EXPECT_THAT(complaint_of("Tf 1 1\n"), StartsWith("a.mtl:2: "));
  EXPECT_EQ(complaint_of("d inf\n"),
            "a.mtl:2: \"d inf\" lacks numbers; accepted: one finite number");
  EXPECT_THAT(complaint_of("Tr\n"), StartsWith("a.mtl:2: \"Tr\" lacks"));

  const auto material_of = [&](const std::string& lines, const std::string& remark) {
    const Model model = load("a.obj", with_material(lines));
    EXPECT_EQ(model.remarks.size(), remark.empty() ? 0U : 1U);
    if (!remark.empty()) {
      EXPECT_THAT(model.remarks.at(0), HasSubstr(remark));
    }
    return model.objects.at(0).material;
  };
  EXPECT_EQ(material_of("Kd 0.25\n", "").albedo, Rgb<double>(0.25));
  EXPECT_EQ(material_of("\tKd  +.5  5e-1 0.5 # grey\nd 0.5\n", "").albedo, Rgb<double>(0.5));
  EXPECT_EQ(material_of("d 7\nKd 1\n", "a.mtl:2: \"d 7\" leaves [0, 1]").opacity, 1);
  EXPECT_EQ(material_of("Kd 2 -1 1\nd -1\n", "(2 such lines in all)").albedo, Rgb<double>(1, 0, 1));
}

TEST_F(Obj, gives_materials_without_a_colour_that_of_their_picture_or_grey) {
  picture("red.tga", {255, 0, 0, 255});
  write_text(
      scratch_ / "a.mtl",
      "newmtl m\nillum 2\nnewmtl unused\nillum 2\nnewmtl n\nmap_Kd red.tga\nnewmtl o\nKd 0 0 0\n");
  const Model model = load("a.obj",
                           "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"
                           "usemtl n\nf 1 2 3\nusemtl o\nf 1 2 3\n");
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_EQ(model.objects[0].material.albedo, Rgb<double>(0.5));
  EXPECT_EQ(model.objects[1].material.albedo, Rgb<double>(1));
  EXPECT_EQ(model.objects[2].material.albedo, Rgb<double>(0));
  EXPECT_THAT(model.remarks, ElementsAre("materials without a colour (Kd) are grey (m)"));
}

TEST_F(Obj, keeps_blanks_in_names) {
  write_text(
      scratch_ / "my colours.mtl",
      "newmtl light red\nKd 1 0 0\nnewmtl light blue \nKd 0 0 1\nnewmtl Material #25\nKd 0 1 0\n");
  write_text(scratch_ / "grey.mtl", "newmtl grey # as walls are\nKd 0.25\n");
  const std::string faces =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl light blue\nf 1 2 3\nusemtl\tMaterial #25  \r\nf 1 2 3\n"
      "usemtl grey # 2\nf 1 2 3\n";
  for (const char* libraries : {"mtllib my colours.mtl\nmtllib grey.mtl\n",
                                "mtllib my\\ colours.mtl # both\nmtllib .\\grey.mtl\n"}) {
    const Model model = load("a.obj", libraries + faces);
    EXPECT_THAT(model.remarks, ElementsAre()) << libraries;
    ASSERT_EQ(model.objects.size(), 3U);
    EXPECT_EQ(model.objects[0].name, "light blue");
    EXPECT_EQ(model.objects[0].material.albedo, Rgb<double>(0, 0, 1));
    EXPECT_EQ(model.objects[1].name, "Material #25");
    EXPECT_EQ(model.objects[1].material.albedo, Rgb<double>(0, 1, 0));
    EXPECT_EQ(model.objects[2].name, "grey");
  }
}

TEST_F(Obj, reads_all_material_files_of_a_line) {
  write_text(scratch_ / "a.mtl", "newmtl a\nKd 1 0 0\n");
  write_text(scratch_ / "b.mtl", "newmtl b\nKd 0 0 1\n");
  const Model model =
      load("a.obj", "mtllib a.mtl gone.mtl b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl b\nf 1 2 3\n");
  EXPECT_EQ(model.objects.at(0).material.albedo, Rgb<double>(0, 0, 1));
  EXPECT_THAT(model.remarks, ElementsAre("gone.mtl is missing"));
}

TEST_F(Obj, goes_on_after_a_backslash) {
  const std::string start =
      "v 0 0 \\\n0\nv 1 0 0\r\nv 0 1 0\nv 1 1 0\n# C:\\models\\\nf 1 2 \\\r\n \\\n4 3\n";
  const Model model = load("a.obj", start);
  EXPECT_EQ(mesh_of(model, 0).triangles.size(), 2U);
  EXPECT_THAT(complaint("b.obj", start + "f 1 2 9\n"), StartsWith("b.obj:10: \"f 1 2 9\" names"));
  EXPECT_THAT(complaint("c.obj", start + "f 1 2 3 \\"), StartsWith("c.obj:10: "));
}

TEST_F(Obj, may_begin_with_the_mark_of_utf_8) {
  const std::string mark = "\xef\xbb\xbf";
  write_text(scratch_ / "a.mtl", mark + "newmtl m\nKd 1 0 0\n");
  const Model model =
      load("a.obj", mark + "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib a.mtl\nusemtl m\nf 1 2 3\n");
  EXPECT_EQ(mesh_of(model, 0).positions.size(), 3U);
  EXPECT_EQ(model.objects[0].material.albedo, Rgb<double>(1, 0, 0));
}

TEST_F(Obj, tells_of_faces_that_are_left_out) {
  const Model model = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\nf 3\n");
  EXPECT_EQ(mesh_of(model, 0).triangles.size(), 1U);
  EXPECT_THAT(model.remarks,
              Contains(HasSubstr("a.obj:4: \"f 1 2\" has less than three vertices and "
                                 "is left out (2 such faces in all)")));
}

TEST_F(Obj, says_what_is_broken_and_where) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
  EXPECT_EQ(
      complaint("a.obj", v + "f 1 2 9\n"),
      "a.obj:5: \"f 1 2 9\" names vertex 9; there are 4, counted from 1, or from -1 backwards");
  EXPECT_EQ(
      complaint("a.obj", v + "f 1 2 3 9\n"),
      "a.obj:5: \"f 1 2 3 9\" names vertex 9; there are 4, counted from 1, or from -1 backwards");
  EXPECT_EQ(
      complaint("a.obj", v + "\nf 0 1 2\n"),
      "a.obj:6: \"f 0 1 2\" names vertex 0; there are 4, counted from 1, or from -1 backwards");
  EXPECT_THAT(complaint("a.obj", v + "f -1 -2 -5\n"),
              HasSubstr("a.obj:5: \"f -1 -2 -5\" names vertex -5"));
  EXPECT_THAT(complaint("a.obj", v + "f 1/1 2/1 3/1\n"),
              HasSubstr("names texture coordinate 1; there are 0"));
  EXPECT_THAT(complaint("a.obj", v + "f 1//2 2//2 3//2\n"),
              HasSubstr("names normal 2; there are 0"));
  EXPECT_THAT(complaint("a.obj", v + "f one 2 3\n"), HasSubstr("names vertex one"));
  EXPECT_EQ(complaint("a.obj", "v 0 0 0\r\nv 1 nan 0\r\n"),
            "a.obj:2: \"v 1 nan 0\" lacks numbers; three finite numbers");
  EXPECT_THAT(complaint("a.obj", "v 0 0\nf 1 1 1\n"),
              HasSubstr("a.obj:1: \"v 0 0\" lacks numbers"));
  EXPECT_THAT(complaint("a.obj", v + "v 1e39 0 0\nf 1 2 5\n"),
              HasSubstr("a.obj:5: \"v 1e39 0 0\" has a coordinate"));
  EXPECT_EQ(complaint("a.obj", v), "a.obj: no faces; at least one line such as \"f 1 2 3\"");
  EXPECT_THAT(complaint("a.obj", ""), HasSubstr("a.obj: no faces"));
  EXPECT_THAT(complaint("a.ply", ""),
              HasSubstr("a.ply: \".ply\" is no model file; .obj, .gltf, .glb"));
  write_text(scratch_ / "a.mtl", "newmtl m\nmap_Kd wood.png\n");
  EXPECT_EQ(
      complaint("a.obj", "mtllib a.mtl\nusemtl m\n" + v + "f 1 2 3\n"),
      "wood.png: cannot be read: No such file or directory (wanted by map_Kd of material \"m\")");
}

// ---- glTF

/// The unit square in z = 0 as four positions.
const std::vector<float> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

/// A document that shows the square once, as two indexed triangles.
GltfBuilder square_document() {
  GltfBuilder gltf;
  const int positions = gltf.positions(square);
  const int indices = gltf.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
  gltf.node({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  return gltf;
}

TEST_F(Gltf, converts_triangles_strips_and_fans) {
  const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  for (const auto& [mode, corners] : {std::pair{5, strip}, {6, square}}) {
    GltfBuilder gltf;
    gltf.node({{"attributes", {{"POSITION", gltf.positions(corners)}}}, {"mode", mode}});
    const Model model = load("a.glb", gltf.glb());
    EXPECT_EQ(mesh_of(model).triangles.size(), 2U);
    EXPECT_EQ(facing(mesh_of(model)), Vec3<float>(0, 0, 1)) << "mode " << mode;
  }
  const Model model = load("a.glb", square_document().glb());
  EXPECT_EQ(mesh_of(model).positions.size(), 4U);
  EXPECT_EQ(facing(mesh_of(model)), Vec3<float>(0, 0, 1));
}

TEST_F(Gltf, leaves_out_points_and_lines_with_a_remark) {
  for (int mode = 0; mode < 4; ++mode) {
    GltfBuilder gltf = square_document();
    gltf.node({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
    const Model model = load("a.glb", gltf.glb());
    EXPECT_EQ(mesh_of(model).triangles.size(), 2U);
    EXPECT_THAT(model.remarks, ElementsAre("points and lines of the file are left out"));
  }
}

TEST_F(Gltf, reads_indices_of_every_type) {
  for (const int type : {5121, 5123, 5125}) {
    GltfBuilder gltf;
    const int positions = gltf.positions(square);
    const int indices = type == 5121   ? gltf.accessor<std::uint8_t>({3, 1, 2}, type, "SCALAR", 1)
                        : type == 5123 ? gltf.accessor<std::uint16_t>({3, 1, 2}, type, "SCALAR", 1)
                                       : gltf.accessor<std::uint32_t>({3, 1, 2}, type, "SCALAR", 1);
    gltf.node({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    const Model model = load("a.glb", gltf.glb());
    EXPECT_EQ(mesh_of(model).positions.size(), 3U);
    EXPECT_EQ(mesh_of(model).positions[0], Vec3<float>(0, 1, 0));
  }
}

TEST_F(Gltf, finds_its_buffer_in_a_file_or_in_the_text) {
  const GltfBuilder gltf = square_document();
  write_text(scratch_ / "my buffer.bin", gltf.bytes + "padding");
  EXPECT_NEAR(area(mesh_of(load("a.gltf", gltf.gltf("my%20buffer.bin")))), 1, 1e-6);
  GltfBuilder small;
  small.bytes = std::string("\0\0\x80\x3f", 4);  // one number: 1.0
  small.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 4}}};
  small.json["accessors"] = {{{"componentType", 5126},
                              {"count", 3},
                              {"type", "VEC3"},
                              {"sparse",
                               {{"count", 1},
                                {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                {"values", {{"bufferView", 0}}}}}}};
  small.node({{"attributes", {{"POSITION", 0}}}});
  EXPECT_THAT(
      complaint("a.gltf", small.gltf("data:application/octet-stream;base64,AACAPw==")),
      HasSubstr(
          "accessors[0].sparse.indices.bufferView: 1; an index from 0 to 0 into bufferViews"));
}

TEST_F(Gltf, replaces_what_a_sparse_accessor_gives_apart) {
  for (const bool has_base : {true, false}) {
    GltfBuilder gltf;
    const int places = gltf.view<std::uint8_t>({1, 2, 3});
    const int values = gltf.view<float>({5, 0, 0, 5, 7, 0, 0, 7, 0});
    json accessor = {{"componentType", 5126},
                     {"count", 4},
                     {"type", "VEC3"},
                     {"sparse",
                      {{"count", 3},
                       {"indices", {{"bufferView", places}, {"componentType", 5121}}},
                       {"values", {{"bufferView", values}}}}}};
    if (has_base) accessor["bufferView"] = gltf.view(square);
    gltf.json["accessors"].push_back(accessor);
    gltf.node({{"attributes", {{"POSITION", 0}}}, {"mode", 6}});
    EXPECT_NEAR(area(mesh_of(load("a.glb", gltf.glb()))), 35, 1e-5);
  }
}

TEST_F(Gltf, reads_interleaved_and_normalised_attributes) {
  picture("t.tga", {255, 255, 255, 255});
  GltfBuilder gltf;
  struct Vertex {
    float p[3];
    std::int8_t n[4];
    std::uint16_t uv[2];
  };
  const int view = gltf.view<Vertex>({{{0, 0, 0}, {0, 0, 127, 0}, {0, 0}},
                                      {{1, 0, 0}, {0, 0, 127, 0}, {65535, 0}},
                                      {{0, 1, 0}, {0, 0, -128, 0}, {0, 32768}}});
  gltf.json["bufferViews"][std::size_t(view)]["byteStride"] = sizeof(Vertex);
  const auto add = [&](int offset, int component_type, const char* type, bool normalized) {
    gltf.json["accessors"].push_back({{"bufferView", view},
                                      {"byteOffset", offset},
                                      {"componentType", component_type},
                                      {"count", 3},
                                      {"type", type},
                                      {"normalized", normalized}});
  };
  add(0, 5126, "VEC3", false), add(12, 5120, "VEC3", true), add(16, 5123, "VEC2", true);
  gltf.json["images"] = {{{"uri", "t.tga"}}};
  gltf.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  gltf.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  gltf.json["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorTexture",
          {{"index", 0},
           {"texCoord", 1},
           {"extensions",
            {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"scale", {2, 1}}}}}}}}}}}};
  gltf.node({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_1", 2}}}, {"material", 0}});
  const Model model = load("a.glb", gltf.glb());
  const Mesh& mesh = mesh_of(model);
  EXPECT_EQ(mesh.normals[0], Vec3<float>(0, 0, 1));
  EXPECT_EQ(mesh.normals[2], Vec3<float>(0, 0, -1));
  EXPECT_FLOAT_EQ(mesh.uvs[1][0], 2.5F);
  EXPECT_FLOAT_EQ(mesh.uvs[2][1], 1 - 32768 / 65535.0F);  // v points up here, down there
  EXPECT_EQ(model.textures[0].wrap_u, Wrap::clamp);
  EXPECT_EQ(model.textures[0].wrap_v, Wrap::mirror);
  EXPECT_TRUE(model.textures[0].srgb);
}

TEST_F(Gltf, multiplies_the_transforms_of_ancestors) {
  GltfBuilder gltf = square_document();
  const double h = std::sqrt(0.5);
  gltf.json["nodes"][0]["rotation"] = {0, 0, h, h};  // a quarter turn about z
  gltf.json["nodes"][0]["scale"] = {2, 1, 1};
  gltf.json["nodes"][0]["translation"] = {0, 0, 3};
  gltf.json["nodes"].push_back(
      {{"children", {0}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 10, 0, 0, 1}}});
  gltf.json["scenes"] = {{{"nodes", json::array()}}, {{"nodes", {1}}}};
  gltf.json["scene"] = 1;
  const Model model = load("a.glb", gltf.glb());
  const Vec3<float> corner = mesh_of(model).positions[1];  // (1, 0, 0) → (0, 2, 3) → (10, 2, −3)
  EXPECT_NEAR(corner.x, 10, 1e-6);
  EXPECT_NEAR(corner.y, 2, 1e-6);
  EXPECT_NEAR(corner.z, -3, 1e-6);
  gltf.json["scene"] = 0;
  EXPECT_THAT(complaint("a.glb", gltf.glb()), HasSubstr("a.glb: no triangles in its scene"));
}

TEST_F(Gltf, understands_alpha_modes_and_transmission) {
  picture("t.tga", {255, 255, 255, 100});
  GltfBuilder gltf = square_document();
  gltf.json["images"] = {{{"uri", "t.tga"}}};
  gltf.json["textures"] = {{{"source", 0}}};
  const json pbr = {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                    {"baseColorTexture", {{"index", 0}}}};
  gltf.json["materials"] = {
      {{"name", "opaque"}, {"pbrMetallicRoughness", pbr}},
      {{"name", "mask"},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.25},
       {"pbrMetallicRoughness", pbr}},
      {{"name", "blend"}, {"alphaMode", "BLEND"}, {"pbrMetallicRoughness", pbr}},
      {{"name", "glass"},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 1}}}},
       {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}}}}}};
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  for (int i = 1; i < 4; ++i)
    gltf.node({{"attributes", {{"POSITION", 0}}}, {"mode", 6}, {"material", i}});
  gltf.node({{"attributes", {{"POSITION", 0}}}, {"mode", 6}});
  const Model model = load("a.glb", gltf.glb());
  ASSERT_EQ(model.objects.size(), 5U);
  const auto material = [&](std::size_t i) { return model.objects[i].material; };
  EXPECT_EQ(material(0).albedo, Rgb<double>(0.1, 0.2, 0.3));
  EXPECT_TRUE(material(0).is_opaque());
  EXPECT_EQ(material(1).opacity, 0.4);
  EXPECT_EQ(material(1).cutoff, 0.25);
  EXPECT_TRUE(material(1).opacity_from_alpha);
  EXPECT_EQ(material(2).cutoff, -1);
  EXPECT_EQ(material(2).opacity_texture, 0);
  EXPECT_EQ(material(3).opacity, 0.25);
  EXPECT_EQ(material(3).tint, Rgb<double>(0.1, 0.2, 0.3));
  EXPECT_EQ(material(4).albedo, Rgb<double>(1));
}

TEST_F(Gltf, takes_the_diffuse_colour_of_older_materials) {
  picture("t.tga", {255, 255, 255, 100});
  GltfBuilder gltf = square_document();
  gltf.json["images"] = {{{"uri", "t.tga"}}};
  gltf.json["textures"] = {{{"source", 0}}};
  json& material = gltf.json["materials"][0];
  json& gloss = material["extensions"]["KHR_materials_pbrSpecularGlossiness"];
  gloss = {{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}}, {"diffuseTexture", {{"index", 0}}}};
  material["alphaMode"] = "BLEND";
  material["pbrMetallicRoughness"] = {
      {"baseColorFactor", {1, 0, 0, 1}}};  // for who knows no better
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  gltf.json["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
  const Model model = load("a.glb", gltf.glb());
  EXPECT_EQ(model.objects[0].material.albedo, Rgb<double>(0.1, 0.2, 0.3));
  EXPECT_EQ(model.objects[0].material.opacity, 0.4);
  EXPECT_EQ(model.objects[0].material.albedo_texture, 0);
  EXPECT_THAT(model.remarks, IsEmpty());
  gloss["diffuseTexture"]["index"] = 1;
  EXPECT_THAT(complaint("a.glb", gltf.glb()), HasSubstr("diffuseTexture.index: 1; an index"));
}

TEST_F(Gltf, cuts_out_glass_as_a_whole) {
  picture("t.tga", {255, 255, 255, 100});
  GltfBuilder gltf = square_document();
  gltf.json["images"] = {{{"uri", "t.tga"}}};
  gltf.json["textures"] = {{{"source", 0}}};
  const json glass = {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}}};
  const auto mask = [&](const char* name, double alpha) -> json {
    return {{"name", name},
            {"alphaMode", "MASK"},
            {"extensions", glass},
            {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, alpha}}}}};
  };
  gltf.json["materials"] = {mask("there", 0.6), mask("gone", 0.4), mask("cut", 1)};
  gltf.json["materials"][2]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  for (const int i : {1, 2})
    gltf.node({{"attributes", {{"POSITION", 0}}}, {"mode", 6}, {"material", i}});
  const Model model = load("a.glb", gltf.glb());
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_EQ(model.objects[0].material.opacity, 0.25);
  EXPECT_EQ(model.objects[0].material.tint, Rgb<double>(1, 0.5, 0));
  EXPECT_EQ(model.objects[1].material.opacity, 0);
  EXPECT_EQ(model.objects[1].material.tint, Rgb<double>(1));
  EXPECT_EQ(model.objects[2].material.opacity, 1);
  EXPECT_EQ(model.objects[2].material.cutoff, 0.5);
  EXPECT_THAT(model.remarks,
              ElementsAre("light passes through glass without regard to its textures (cut)"));
}

TEST_F(Gltf, tells_what_it_leaves_out) {
  GltfBuilder gltf = square_document();
  gltf.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "KHR_texture_transform"};
  gltf.json["cameras"] = {
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 10}}}}};
  gltf.json["nodes"].push_back({{"camera", 0}});
  gltf.json["materials"] = {{{"name", "lamp"}, {"emissiveFactor", {0, 0, 1}}},
                            {{"name", "unused"}, {"emissiveFactor", {0, 0, 1}}}};
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  EXPECT_THAT(load("a.glb", gltf.glb()).remarks,
              ElementsAre("extensions of the file are left out (EXT_mesh_gpu_instancing)",
                          "light given off by surfaces is left out (lamp)",
                          "orthographic cameras of the file are left out"));
  gltf.json["extensionsUsed"] = {1};
  EXPECT_EQ(complaint("a.glb", gltf.glb()), "a.glb: extensionsUsed[0]: 1; a text");
}

TEST_F(Gltf, takes_the_camera_and_directional_lights) {
  GltfBuilder gltf = square_document();
  gltf.json["cameras"] = {
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 10}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", pi / 3}, {"znear", 0.1}}}}};
  const double h = std::sqrt(0.5);
  const json quarter_about_y = {0, h, 0, h};  // −z goes to −x
  gltf.json["nodes"].push_back({{"camera", 0}});
  gltf.json["nodes"].push_back(
      {{"camera", 1}, {"translation", {1, 2, 3}}, {"rotation", quarter_about_y}});
  gltf.json["extensionsRequired"] = {"KHR_lights_punctual"};
  gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}}, {{"type", "directional"}, {"color", {1, 0.5, 0}}, {"intensity", 4}}};
  for (const int i : {0, 1})
    gltf.json["nodes"].push_back({{"rotation", quarter_about_y},
                                  {"scale", {3, 3, 3}},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  const Model model = load("a.glb", gltf.glb());
  ASSERT_TRUE(model.camera.has_value());
  EXPECT_EQ(model.camera->position, Vec3<double>(1, 2, 3));
  EXPECT_NEAR(model.camera->target.x, 0, 1e-12);
  EXPECT_NEAR(model.camera->fov, 60, 1e-12);
  ASSERT_EQ(model.lights.size(), 1U);
  const Directional& sun = model.lights[0];
  EXPECT_EQ(sun.irradiance, Rgb<double>(4, 2, 0));
  EXPECT_NEAR(sun.direction.x, -1, 1e-12);
  EXPECT_THAT(model.remarks, ElementsAre("1 point and spot lights of the file are left out"));
}

TEST_F(Gltf, refuses_what_is_required_and_not_supported_by_name) {
  GltfBuilder gltf = square_document();
  gltf.json["extensionsUsed"] = {"KHR_materials_ior"};
  EXPECT_EQ(complaint("a.glb", gltf.glb()), "accepted");
  gltf.json["extensionsRequired"] = {"KHR_texture_transform", "KHR_draco_mesh_compression"};
  EXPECT_EQ(complaint("a.glb", gltf.glb()),
            "a.glb: extensionsRequired[1]: KHR_draco_mesh_compression is not supported; "
            "KHR_lights_punctual, KHR_materials_pbrSpecularGlossiness, "
            "KHR_materials_transmission, KHR_mesh_quantization, KHR_texture_transform");
}

/// What a change to the JSON of the square makes of it.
struct Broken {
  const char* pointer;  ///< JSON pointer
  json value;
  const char* said;
};

TEST_F(Gltf, says_what_is_broken_and_where) {
  const Broken table[] = {
      {"/asset/version", "1.0", "asset.version: \"1.0\"; \"2.0\""},
      {"/asset", json(), "asset: null; an object"},
      {"/scene", 3, "scene: 3; there are no scenes"},
      {"/nodes/0/mesh", 1, "nodes[0].mesh: 1; an index from 0 to 0 into meshes"},
      {"/nodes/0/mesh", -1, "nodes[0].mesh: -1; an index"},
      {"/nodes/0/mesh", "0", "nodes[0].mesh: \"0\"; an index"},
      {"/nodes/0/mesh", 0.5, "nodes[0].mesh: 0.5; an index"},
      {"/nodes/0/mesh", 4294967296, "nodes[0].mesh: 4294967296; an index"},
      {"/nodes/0/children", {0}, "nodes[0]: it is its own ancestor; a tree of nodes"},
      {"/nodes/0/matrix", {1, 2, 3}, "nodes[0].matrix: 3 values; 16 numbers"},
      {"/nodes/0/scale", {1, "2", 3}, "nodes[0].scale[1]: \"2\"; a number"},
      {"/nodes/0/rotation",
       {0, 0, 0, 0},
       "nodes[0].rotation: a quaternion of length 0; a unit quaternion"},
      {"/nodes/0/scale",
       {1e300, 1e300, 1e300},
       "meshes[0].primitives[0].attributes.POSITION: element 1 is not finite; finite numbers"},
      {"/nodes/0/extensions",
       {{"KHR_lights_punctual", {{"light", 0}}}},
       "light: 0; there are no lights"},
      {"/meshes", json::object(), "meshes: {}; an array"},
      {"/meshes/0/primitives/0", 7, "meshes[0].primitives[0]: 7; an object"},
      {"/meshes/0/primitives/0/mode", 7,
       "meshes[0].primitives[0].mode: 7; a whole number from 0 to 6"},
      {"/meshes/0/primitives/0/indices", 2,
       "meshes[0].primitives[0].indices: 2; an index from 0 to 1 into accessors"},
      {"/meshes/0/primitives/0/indices", 0,
       "meshes[0].primitives[0].indices: accessors[0] has elements of another type"},
      {"/meshes/0/primitives/0/attributes/POSITION", 1,
       "POSITION: accessors[1] has elements of another type; VEC3"},
      {"/meshes/0/primitives/0/attributes/NORMAL", 2, "attributes.NORMAL: 2; an index"},
      {"/meshes/0/primitives/0/material", 0,
       "meshes[0].primitives[0].material: 0; there are no materials"},
      {"/meshes/0/primitives", json::array(), "no triangles in its scene"},
      {"/accessors/0/count", 5,
       "5 elements of 12 bytes from byte 0 on; bufferViews[0] has 48 bytes"},
      {"/accessors/0/count", 9007199254740991,
       "elements of 12 bytes from byte 0 on; bufferViews[0] has 48 bytes"},
      {"/accessors/0/count", 0, "accessors[0].count: 0; a whole number from 1"},
      {"/accessors/0/count", 2, "index 2 is 2; an index below 2, the number of positions"},
      {"/accessors/0/byteOffset", 1, "4 elements of 12 bytes from byte 1 on"},
      {"/accessors/0/byteOffset", 9007199254740991, "from byte 9007199254740991 on"},
      {"/accessors/0/componentType", 5130,
       "accessors[0].componentType: 5130; 5120, 5121, 5122, 5123, 5125, 5126"},
      {"/accessors/0/type", "VEC5", "accessors[0].type: \"VEC5\"; SCALAR, VEC2"},
      {"/accessors/1/componentType", 5122,
       "primitives[0].indices: its components are signed or fractions"},
      {"/accessors/0/bufferView", 9,
       "accessors[0].bufferView: 9; an index from 0 to 1 into bufferViews"},
      {"/bufferViews/0/byteLength", 100000,
       "bufferViews[0] wants bytes 0 to 100000 of a buffer of 60"},
      {"/bufferViews/0/byteOffset", 9007199254740992, "bufferViews[0] wants bytes"},
      {"/bufferViews/0/byteStride", 3,
       "bufferViews[0].byteStride: 3; a whole number from 4 to 252"},
      {"/bufferViews/0/buffer", 1, "bufferViews[0].buffer: 1; an index from 0 to 0 into buffers"},
      {"/buffers",
       {{{"byteLength", 1000}}},
       "buffers[0].byteLength: 1000, but there are only 60 bytes"},
      {"/buffers",
       {{{"byteLength", 60}, {"uri", "gone.bin"}}},
       "buffers[0].uri: gone.bin: cannot be read: No such file or directory"},
      {"/buffers",
       {{{"byteLength", 60}, {"uri", "data:text/plain,abc"}}},
       "a data URI that is not base64"},
      {"/buffers",
       {{{"byteLength", 60}, {"uri", "https://a.b/c.bin"}}},
       "\"https://a.b/c.bin\" is not in a file"},
  };
  for (const Broken& broken : table) {
    GltfBuilder gltf = square_document();
    gltf.json["buffers"] = {{{"byteLength", gltf.bytes.size()}}};
    gltf.json[json::json_pointer(broken.pointer)] = broken.value;
    const std::string said = complaint("a.glb", gltf.glb());
    EXPECT_THAT(said, HasSubstr(broken.said)) << broken.pointer << " = " << broken.value;
    EXPECT_TRUE(said.starts_with("a.glb: ")) << said;
  }
}

TEST_F(Gltf, refuses_positions_that_are_not_finite) {
  for (const float bad :
       {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    GltfBuilder gltf;
    std::vector<float> positions = square;
    positions[7] = bad;
    gltf.node({{"attributes", {{"POSITION", gltf.positions(positions)}}}});
    EXPECT_EQ(complaint("a.glb", gltf.glb()),
              "a.glb: meshes[0].primitives[0].attributes.POSITION: element 2 is not finite; finite "
              "numbers");
  }
}

TEST_F(Gltf, refuses_graphs_that_are_no_trees) {
  GltfBuilder gltf = square_document();
  gltf.json["nodes"].push_back({{"children", {0}}});
  gltf.json["nodes"].push_back({{"children", {0}}});
  EXPECT_THAT(complaint("a.glb", gltf.glb()),
              HasSubstr("nodes[2].children: node 0 is already a child of node 1"));
  gltf.json["nodes"] = {
      {{"mesh", 0}}, {{"children", {2}}}, {{"children", {3}}}, {{"children", {1}}}};
  EXPECT_THAT(complaint("a.glb", gltf.glb()), HasSubstr("it is its own ancestor"));
  gltf.json["nodes"] = {{{"mesh", 0}}, {{"children", {0}}}};
  gltf.json["scenes"] = {{{"nodes", {0, 1}}}};
  EXPECT_THAT(complaint("a.glb", gltf.glb()),
              HasSubstr("scenes[0].nodes: node 0 is a child or listed twice"));
}

TEST_F(Gltf, says_where_json_and_chunks_end) {
  EXPECT_EQ(complaint("a.gltf", "{\n  \"asset\": {\"version\": \"2.0\"},\n  oops\n}"),
            "a.gltf:3:3: not JSON from here on; a glTF 2.0 document");
  EXPECT_THAT(complaint("a.gltf", ""), HasSubstr("a.gltf:1:1: not JSON"));
  EXPECT_THAT(complaint("a.gltf", "[]"), HasSubstr("the document: []; an object"));
  EXPECT_THAT(complaint("a.gltf", std::string(100000, '[')),
              HasSubstr("nested deeper than 64 levels"));
  EXPECT_THAT(complaint("a.gltf", "{\"a\": 1e999}"), HasSubstr("a number beyond 1.8e308"));
  const std::string glb = square_document().glb();
  EXPECT_EQ(complaint("a.glb", glb.substr(0, 100)),
            fmt::format("a.glb: it ends after 100 of {} bytes; a whole .glb file", glb.size()));
  std::string other = glb;
  other[4] = 1;
  EXPECT_EQ(complaint("a.glb", other), "a.glb: binary glTF of version 1; version 2");
}

// ---- In a scene file

using InScenes = Models;

TEST_F(InScenes, stand_where_the_scene_puts_them) {
  picture("t.tga", {255, 255, 255, 255});
  write_text(scratch_ / "m.mtl", "newmtl red\nKd 0.5 0.1 0.2\nmap_Kd t.tga\nKe 1 1 1\n");
  write_text(scratch_ / "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const Scene scene = load_scene(write_text(scratch_ / "s.toml", R"(
[[objects]]
type = "rectangle"
albedo_texture = "t.tga"
[[objects]]
type = "mesh"
file = "m.obj"
name = "chair"
scale = 2
rotate = [0, 90, 0]
translate = [0, 0, 5]
tint = [1, 0.5, 1]
)"));
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[1].name, "chair.red");
  const Vec3<float> corner = std::get<Mesh>(scene.objects[1].geometry).positions[1];
  EXPECT_NEAR(corner.z, 3, 1e-6);  // (1, 0, 0) → (2, 0, 0) → (0, 0, −2) → (0, 0, 3)
  EXPECT_EQ(scene.objects[1].material.albedo_texture, 1);
  EXPECT_NEAR(scene.objects[1].material.albedo.g, 0.1, 1e-7);
  EXPECT_EQ(scene.objects[1].material.tint, Rgb<double>(1, 0.5, 1));
  EXPECT_THAT(scene.assumptions, ElementsAre("light given off by surfaces is left out (red)"));
}

TEST_F(InScenes, are_complained_about_at_their_line) {
  const auto path =
      write_text(scratch_ / "s.toml", "[[objects]]\ntype = \"mesh\"\nfile = \"gone.obj\"\n");
  try {
    load_scene(path);
    FAIL() << "a missing file was accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("s.toml:3:8: objects.0.file names a model that is not to be had: "));
    EXPECT_THAT(error.what(), HasSubstr("gone.obj: cannot be read: No such file or directory"));
  }
}

/// A rectangle of an OBJ file that faces along u × v.
std::string rectangle(Vec3<double> corner, Vec3<double> u, Vec3<double> v) {
  std::string text;
  for (const Vec3<double>& p : {corner, corner + u, corner + u + v, corner + v})
    text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  return text + "f -4 -3 -2 -1\n";
}

/// A box of 6 by 3 by 8 m whose walls face in, with a window in the wall at x = 0 if asked.
std::string room(bool window) {
  const std::string walls = rectangle({0, 0, 0}, {0, 0, 8}, {6, 0, 0}) +  // floor
                            rectangle({0, 3, 0}, {6, 0, 0}, {0, 0, 8}) +  // ceiling
                            rectangle({0, 0, 0}, {6, 0, 0}, {0, 3, 0}) +  // z = 0
                            rectangle({0, 0, 8}, {0, 3, 0}, {6, 0, 0}) +  // z = 8
                            rectangle({6, 0, 0}, {0, 0, 8}, {0, 3, 0});   // x = 6
  if (!window) return walls + rectangle({0, 0, 0}, {0, 3, 0}, {0, 0, 8});
  return walls + rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 8}) +
         rectangle({0, 2.5, 0}, {0, 0.5, 0}, {0, 0, 8}) +
         rectangle({0, 1, 0}, {0, 1.5, 0}, {0, 0, 3}) +
         rectangle({0, 1, 5}, {0, 1.5, 0}, {0, 0, 3});
}

TEST_F(InScenes, rooms_are_seen_from_inside_with_the_sun_in_the_window) {
  const Scene scene = load_scene(write_text(scratch_ / "room.obj", room(true)));
  const auto inside = [](Vec3<double> p, double slack) {
    return p.x >= -slack && p.y >= -slack && p.z >= -slack && p.x <= 6 + slack &&
           p.y <= 3 + slack && p.z <= 8 + slack;
  };
  EXPECT_TRUE(inside(scene.camera.position, -0.1));
  EXPECT_TRUE(inside(scene.camera.target, 0));
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_LT(std::get<Directional>(scene.lights[0]).toward().x, 0);
  EXPECT_GT(std::get<Directional>(scene.lights[0]).toward().y, 0);
  const Box& fog = std::get<Box>(scene.media[0].shape);
  EXPECT_TRUE(inside(fog.min, 0.01) && inside(fog.max, 0.01));
  const double depth = scene.media[0].sigma_t.r * length(fog.max - fog.min);
  EXPECT_GT(depth, 0.4);
  EXPECT_LT(depth, 1.2);
  ASSERT_EQ(scene.assumptions.size(), 2U);
  EXPECT_EQ(scene.assumptions[0], "surfaces without a material are grey");
  EXPECT_THAT(scene.assumptions[1], HasSubstr("a camera in the room"));
}

TEST_F(InScenes, things_are_seen_from_outside_in_a_cloud) {
  const Scene scene = load_scene(write_text(scratch_ / "a.glb", square_document().glb()));
  EXPECT_GT(length(scene.camera.position - Vec3<double>(0.5, 0.5, 0)), 1);
  EXPECT_NEAR(scene.camera.target.x, 0.5, 1e-3);
  const Box& fog = std::get<Box>(scene.media[0].shape);
  EXPECT_LT(fog.min.x, 0);
  EXPECT_GT(fog.max.y, 1);
  EXPECT_GT(fog.max.z, fog.min.z);
  EXPECT_THAT(scene.assumptions, ElementsAre(HasSubstr("a camera outside")));
  EXPECT_NO_THROW(load_scene(write_text(scratch_ / "closed.obj", room(false))));
}

TEST_F(InScenes, overrides_change_what_was_filled_in) {
  const Scene scene =
      load_scene(write_text(scratch_ / "room.obj", room(true)),
                 {"lights.0.irradiance=3", "camera.position=[3, 1, 7]", "render.spp=2"});
  EXPECT_EQ(std::get<Directional>(scene.lights[0]).irradiance, Rgb<double>(3));
  EXPECT_EQ(scene.camera.position, Vec3<double>(3, 1, 7));
  EXPECT_EQ(scene.render.spp, 2);
}

TEST_F(InScenes, the_models_own_camera_and_lights_count) {
  GltfBuilder gltf = square_document();
  gltf.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", pi / 4}, {"znear", 0.1}}}}};
  gltf.json["nodes"].push_back({{"camera", 0}, {"translation", {4321.0 / 3, 2, 30}}});
  gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"intensity", 0.1}}};
  gltf.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const Scene scene = load_scene(write_text(scratch_ / "a.glb", gltf.glb()));
  EXPECT_EQ(scene.camera.position.x, 4321.0 / 3);
  EXPECT_EQ(scene.camera.target, scene.camera.position + Vec3<double>(0, 0, -1));
  EXPECT_NEAR(scene.camera.fov, 45, 1e-12);
  EXPECT_EQ(std::get<Directional>(scene.lights.at(0)).direction, Vec3<double>(0, 0, -1));
  EXPECT_EQ(std::get<Directional>(scene.lights.at(0)).irradiance, Rgb<double>(0.1));
}

// ---- Files that something chewed on

/// Loads every damaged copy: it may be accepted or refused in one line, never more.
void chew(const test::Folder& scratch, const std::string& name, const std::string& whole,
          int copies) {
  std::minstd_rand random(7);
  int refused = 0;
  for (int i = 0; i < copies; ++i) {
    std::string text = whole;
    if (i % 3 == 0) text.resize(random() % text.size());
    for (int flips = i % 3 == 0 ? 0 : 1 + i % 4; flips > 0; --flips)
      text[random() % text.size()] = char(random());
    try {
      load_model(write_text(scratch / name, text));
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(refused, copies / 10);
  EXPECT_LT(refused, copies);
}

TEST_F(Gltf, survives_damage) {
  GltfBuilder gltf = square_document();
  gltf.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  gltf.json["nodes"].push_back({{"camera", 0}, {"children", {0}}});
  gltf.json["materials"] = {
      {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}}}};
  chew(scratch_, "a.glb", gltf.glb(), 400);
  chew(scratch_, "a.gltf", gltf.gltf("data:;base64," + std::string(80, 'A')), 400);
}

TEST_F(Obj, survives_damage) {
  write_text(scratch_ / "a.mtl", "newmtl a\nKd 1 0.5 0.2\nd 0.5\n");
  chew(scratch_, "a.obj",
       "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0.5\nvt 0 1\nvn 0 0 1\nusemtl a\nf 1/1/1 "
       "2/1/1 3/1/1\n"
       "f 1 2 3 4\nf -1 -2 -3 -4 -4\ng b\nf 4//1 3//1 1//1\n",
       400);
}

}  // namespace
}  // namespace airlight
