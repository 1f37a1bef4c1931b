#include "scene/models/obj.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <map>
#include <streambuf>

#include "error.h"
#include "image/read_file.h"
#include "scene/models/mtl.h"
#include "scene/models/normals.h"
#include "scene/models/obj_text.h"

namespace airlight {
namespace {

/// A stream over text that is in memory already.
struct TextBuffer : std::streambuf {
  explicit TextBuffer(std::string& text) {
    setg(text.data(), text.data(), text.data() + text.size());
  }
};

/// An OBJ file as its parser leaves it.
struct Parsed {
  tinyobj::attrib_t vertices;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  bool has_thin_faces = false;  ///< with less than three vertices, which the parser left out

  std::size_t positions() const { return vertices.vertices.size() / 3; }
  std::size_t normals() const { return vertices.normals.size() / 3; }
  std::size_t uvs() const { return vertices.texcoords.size() / 2; }
};

bool is_index(int i, std::size_t size) { return i >= 0 && std::size_t(i) < size; }

/// Whether every index is −1 or names something, and every number is finite.
bool is_sound(const Parsed& obj) {
  for (const auto& shape : obj.shapes)
    for (const tinyobj::index_t& i : shape.mesh.indices)
      if (!is_index(i.vertex_index, obj.positions()) ||
          (i.normal_index != -1 && !is_index(i.normal_index, obj.normals())) ||
          (i.texcoord_index != -1 && !is_index(i.texcoord_index, obj.uvs())))
        return false;
  for (const float x : obj.vertices.vertices)
    if (!std::isfinite(x)) return false;
  return true;
}

Parsed parse(std::string& text, const std::string& file, MtlReader& reader) {
  prepare_obj(text);
  check_obj_numbers(text, file);
  Parsed obj;
  TextBuffer buffer(text);
  std::istream stream(&buffer);
  std::string warning, error;
  const bool parsed = tinyobj::LoadObj(&obj.vertices, &obj.shapes, &obj.materials, &warning, &error,
                                       &stream, &reader, true, false);
  // The parser drops quadrangles with an index of nothing, and says so.
  const bool dropped = warning.find("invalid vertex index") != std::string::npos;
  if (!parsed || dropped || !is_sound(obj)) {
    explain_broken_obj(text, file);
    throw Error(fmt::format(
        "{}: a face, line or point has an index of nothing; indices count from 1", file));
  }
  obj.has_thin_faces = warning.find("Degenerated face") != std::string::npos;
  return obj;
}

/// Sorts the faces of an OBJ into a mesh for each material, where a vertex is one triple of OBJ's
/// indices.
class Sorter {
 public:
  explicit Sorter(const Parsed& obj)
      : obj_(obj), mesh_of_material_(obj.materials.size() + 1, -1), first_(obj.positions(), none) {}

  struct Part {
    int material;  ///< index into Parsed::materials, −1 without
    Mesh mesh;
    bool all_have_normals = true, any_has_uv = false;
  };

  std::vector<Part> sort() {
    for (const auto& shape : obj_.shapes)
      for (std::size_t face = 0; face < shape.mesh.material_ids.size(); ++face)
        add(&shape.mesh.indices[3 * face], shape.mesh.material_ids[face]);
    for (Part& part : parts_) {
      if (!part.all_have_normals) part.mesh.normals = {};
      if (!part.any_has_uv) part.mesh.uvs = {};
      mend_normals(part.mesh);
    }
    return std::move(parts_);
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// A vertex made already; those that share a position form a list.
  struct Made {
    int normal, uv, part;
    std::uint32_t index, next;
  };

  void add(const tinyobj::index_t* corners, int material) {
    int& part = mesh_of_material_[std::size_t(material + 1)];
    if (part < 0) {
      part = int(parts_.size());
      parts_.push_back({material, {}});
    }
    parts_[std::size_t(part)].mesh.triangles.push_back(
        {vertex(corners[0], part), vertex(corners[1], part), vertex(corners[2], part)});
  }

  std::uint32_t vertex(const tinyobj::index_t& corner, int part) {
    std::uint32_t& first = first_[std::size_t(corner.vertex_index)];
    for (std::uint32_t i = first; i != none; i = made_[i].next) {
      const Made& made = made_[i];
      if (made.normal == corner.normal_index && made.uv == corner.texcoord_index &&
          made.part == part)
        return made.index;
    }
    const std::uint32_t index = append(corner, parts_[std::size_t(part)]);
    made_.push_back({corner.normal_index, corner.texcoord_index, part, index, first});
    first = std::uint32_t(made_.size() - 1);
    return index;
  }

  std::uint32_t append(const tinyobj::index_t& corner, Part& part) const {
    const tinyobj::attrib_t& from = obj_.vertices;
    const float* p = &from.vertices[3 * std::size_t(corner.vertex_index)];
    part.mesh.positions.push_back({p[0], p[1], p[2]});
    const bool has_normal = corner.normal_index >= 0, has_uv = corner.texcoord_index >= 0;
    const float* n = has_normal ? &from.normals[3 * std::size_t(corner.normal_index)] : zeros;
    part.mesh.normals.push_back({n[0], n[1], n[2]});
    const float* uv = has_uv ? &from.texcoords[2 * std::size_t(corner.texcoord_index)] : zeros;
    part.mesh.uvs.push_back({uv[0], uv[1]});
    part.all_have_normals = part.all_have_normals && has_normal;
    part.any_has_uv = part.any_has_uv || has_uv;
    return std::uint32_t(part.mesh.positions.size() - 1);
  }

  static constexpr float zeros[3] = {};

  const Parsed& obj_;
  std::vector<int> mesh_of_material_;  ///< at material + 1
  std::vector<std::uint32_t> first_;   ///< the head of each position's list in made_
  std::vector<Made> made_;
  std::vector<Part> parts_;
};

/// What an MTL file says of each part; null where there is none.
std::vector<const tinyobj::material_t*> materials_of(const std::vector<Sorter::Part>& parts,
                                                     const Parsed& obj) {
  std::vector<const tinyobj::material_t*> materials;
  for (const auto& part : parts)
    materials.push_back(part.material < 0 ? nullptr : &obj.materials[std::size_t(part.material)]);
  return materials;
}

std::vector<std::string> remarks_on(const std::vector<const tinyobj::material_t*>& materials,
                                    const MtlReader& reader) {
  std::vector<std::string> remarks = reader.remarks();
  std::vector<std::string> glowing, colourless;
  for (const auto* mtl : materials) {
    if (!mtl) continue;
    if (mtl->emission[0] > 0 || mtl->emission[1] > 0 || mtl->emission[2] > 0)
      glowing.push_back(mtl->name);
    if (std::ranges::find(reader.colourless(), mtl->name) != reader.colourless().end())
      colourless.push_back(mtl->name);
  }
  if (std::count(materials.begin(), materials.end(), nullptr) > 0)
    remarks.push_back("surfaces without a material are grey");
  if (!colourless.empty())
    remarks.push_back(
        fmt::format("materials without a colour (Kd) are grey ({})", fmt::join(colourless, ", ")));
  if (!glowing.empty())
    remarks.push_back(
        fmt::format("light given off by surfaces is left out ({})", fmt::join(glowing, ", ")));
  return remarks;
}

}  // namespace

Model load_obj(const std::filesystem::path& path) {
  MtlReader reader(path.parent_path());
  std::string text = read_text(path);
  const Parsed obj = parse(text, path.string(), reader);
  std::vector<Sorter::Part> parts = Sorter(obj).sort();
  if (parts.empty())
    throw Error(fmt::format("{}: no faces; at least one line such as \"f 1 2 3\"", path.string()));
  Model model;
  const auto materials = materials_of(parts, obj);
  const auto converted = convert_mtl(materials, path.parent_path(), model.textures);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (materials[i]) place_texture(*materials[i], parts[i].mesh);
    model.objects.push_back({materials[i] ? materials[i]->name : path.stem().string(),
                             std::move(parts[i].mesh), converted[i]});
  }
  model.remarks = remarks_on(materials, reader);
  if (obj.has_thin_faces) model.remarks.push_back(remark_on_thin_faces(text, path.string()));
  return model;
}

}  // namespace airlight
