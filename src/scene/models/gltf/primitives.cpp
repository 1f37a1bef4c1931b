#include "scene/models/gltf/primitives.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "error.h"
#include "scene/models/gltf/accessor.h"
#include "scene/models/gltf/vertices.h"
#include "scene/models/normals.h"

namespace airlight::gltf {
namespace {

constexpr std::size_t most_triangles = std::size_t{1} << 28;

/// The corners of a primitive in the order they are drawn: by its indices, or one after the other.
class Corners {
 public:
  Corners(const Document& document, const tinygltf::Primitive& primitive, std::size_t vertices,
          const std::string& where)
      : document_(document), vertices_(vertices), where_(where + ".indices") {
    if (primitive.indices < 0) return;
    indices_.emplace(document, primitive.indices, TINYGLTF_TYPE_SCALAR, where_);
    if (!indices_->is_unsigned())
      throw Error(
          fmt::format("{}: {}: its components are signed or fractions; unsigned whole numbers",
                      document.file, where_));
  }

  std::size_t size() const { return indices_ ? indices_->size() : vertices_; }

  std::uint32_t operator[](std::size_t i) const {
    if (!indices_) return std::uint32_t(i);
    const std::uint32_t vertex = indices_->integer(i);
    if (vertex >= vertices_)
      throw Error(fmt::format("{}: {}: index {} is {}; an index below {}, the number of positions",
                              document_.file, where_, i, vertex, vertices_));
    return vertex;
  }

 private:
  const Document& document_;
  std::size_t vertices_;
  std::string where_;
  std::optional<Accessor> indices_;
};

std::size_t count_triangles(int mode, std::size_t corners) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

/// The corners of triangle i, turned the same way throughout.
std::array<std::size_t, 3> triangle(int mode, std::size_t i) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return {3 * i, 3 * i + 1, 3 * i + 2};
  if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {0, i + 1, i + 2};
  return {i, i + 1 + i % 2, i + 2 - i % 2};
}

std::array<float, 2> place(const std::array<float, 6>& map, const std::array<float, 4>& uv) {
  const float u = map[0] * uv[0] + map[1] * uv[1] + map[2];
  const float v = map[3] * uv[0] + map[4] * uv[1] + map[5];
  return {u, 1 - v};  // ours points up
}

void add_once(const std::string& name, std::vector<std::string>& names) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

}  // namespace

void Collector::add(const PlacedNode& placed) {
  const tinygltf::Node& node = document_.model.nodes[std::size_t(placed.node)];
  if (node.mesh < 0) return;
  std::optional<std::vector<Affine>> joints;
  if (node.skin >= 0) {
    joints = joints_of(document_, node.skin, nodes_);
    saw_lost_joints_ = saw_lost_joints_ || !joints;
  }
  const auto& primitives = document_.model.meshes[std::size_t(node.mesh)].primitives;
  for (std::size_t i = 0; i < primitives.size(); ++i)
    add(primitives[i], placed, joints ? &*joints : nullptr,
        fmt::format("meshes[{}].primitives[{}]", node.mesh, i));
}

void Collector::add(const tinygltf::Primitive& primitive, const PlacedNode& node,
                    const std::vector<Affine>* joints, const std::string& where) {
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
    saw_lines_ = true;
    return;
  }
  if (!primitive.attributes.contains("POSITION"))
    return;  // glTF leaves to extensions what this means
  const std::size_t material =
      primitive.material >= 0 ? std::size_t(primitive.material) : materials_.size() - 1;
  const GltfMaterial& look = materials_[material];
  const Vertices vertices(document_, primitive, node, joints, where);
  const std::string uv_name = fmt::format("TEXCOORD_{}", look.uv_set);
  const auto uvs = look.has_texture() ? find_attribute(document_, primitive.attributes, uv_name,
                                                       TINYGLTF_TYPE_VEC2, where + ".attributes")
                                      : std::optional<Accessor>{};
  if (uvs && uvs->size() != vertices.size())
    throw Error(fmt::format("{}: {}.attributes.{}: {} elements; as many as positions, {}",
                            document_.file, where, uv_name, uvs->size(), vertices.size()));
  saw_colours_ = saw_colours_ || primitive.attributes.contains("COLOR_0");

  const Corners corners(document_, primitive, vertices.size(), where);
  const std::size_t triangles = count_triangles(primitive.mode, corners.size());
  if ((triangles_ += triangles) > most_triangles)
    throw Error(fmt::format("{}: {}: more than {} triangles up to here; fewer", document_.file,
                            where, most_triangles));

  Mesh& mesh = part_for(material, vertices.have_normals()).mesh;
  if (copied_as_.size() < vertices.size()) {
    copied_as_.resize(vertices.size());
    copied_for_.resize(vertices.size(), 0);
  }
  ++primitive_number_;
  const auto copy = [&](std::uint32_t vertex) {
    if (copied_for_[vertex] == primitive_number_) return copied_as_[vertex];
    const auto [position, normal] = vertices[vertex];
    const Vec3<float> p(position);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Error(
          fmt::format("{}: {}.attributes.POSITION: element {} is not finite; finite numbers",
                      document_.file, where, vertex));
    mesh.positions.push_back(p);
    if (vertices.have_normals()) mesh.normals.push_back(Vec3<float>(normal));
    if (look.has_texture())
      mesh.uvs.push_back(uvs ? place(look.uv_map, uvs->floats(vertex)) : std::array<float, 2>{});
    copied_for_[vertex] = primitive_number_;
    return copied_as_[vertex] = std::uint32_t(mesh.positions.size() - 1);
  };
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto [a, b, c] = triangle(primitive.mode, i);
    const std::uint32_t p = corners[a], q = corners[b], r = corners[c];
    if (p == q || q == r || r == p) continue;  // strips are stitched with these
    mesh.triangles.push_back({copy(p), copy(q), copy(r)});
  }
}

Collector::Part& Collector::part_for(std::size_t material, bool has_normals) {
  for (Part& part : parts_)
    if (part.material == material && part.has_normals == has_normals) return part;
  return parts_.emplace_back(Part{material, has_normals, {}});
}

std::vector<Object> Collector::finish(std::vector<std::string>& remarks) {
  if (saw_lines_) remarks.push_back("points and lines of the file are left out");
  if (saw_colours_) remarks.push_back("colours of vertices are left out");
  if (saw_lost_joints_)
    remarks.push_back("skinned meshes without all their joints stand as they were modelled");
  std::vector<Object> objects;
  std::vector<std::string> glowing, filtering;
  for (Part& part : parts_) {
    if (part.mesh.triangles.empty()) continue;
    mend_normals(part.mesh);
    const GltfMaterial& look = materials_[part.material];
    const std::string name =
        look.name.empty() ? fmt::format("materials[{}]", part.material) : look.name;
    if (look.glows) add_once(name, glowing);
    if (look.filters_by_texture) add_once(name, filtering);
    objects.push_back({name, std::move(part.mesh), look.material});
  }
  const auto remark = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) remarks.push_back(fmt::format("{} ({})", what, fmt::join(names, ", ")));
  };
  remark("light given off by surfaces is left out", glowing);
  remark("light passes through glass without regard to its textures", filtering);
  return objects;
}

}  // namespace airlight::gltf
