#include "scene/models/gltf/vertices.h"

#include <fmt/format.h>

#include "error.h"

namespace airlight::gltf {
namespace {

Vec3<double> vec3(const std::array<float, 4>& v) { return {v[0], v[1], v[2]}; }

Affine sum(const Affine& a, const Affine& b, double weight) {
  return {a.x + b.x * weight, a.y + b.y * weight, a.z + b.z * weight, a.origin + b.origin * weight};
}

}  // namespace

std::optional<std::vector<Affine>> joints_of(const Document& document, int skin,
                                             const std::vector<PlacedNode>& nodes) {
  const Json& told = document.skins.at(std::size_t(skin));
  const Json& joints = told.at("joints");
  std::vector<Affine> bind(joints.size());
  if (const auto found = told.find("inverseBindMatrices"); found != told.end())
    bind = read_matrices(document, *found, joints.size(),
                         fmt::format("skins[{}].inverseBindMatrices", skin));
  std::vector<const Affine*> placed(document.model.nodes.size(), nullptr);
  for (const PlacedNode& node : nodes) placed[std::size_t(node.node)] = &node.to_world;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Affine* joint = placed[joints[i].get<std::size_t>()];
    if (joint == nullptr) return std::nullopt;
    bind[i] = *joint * bind[i];
  }
  return bind;
}

std::optional<Accessor> find_attribute(const Document& document,
                                       const std::map<std::string, int>& attributes,
                                       const std::string& name, int type,
                                       const std::string& where) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return std::nullopt;
  return Accessor(document, found->second, type, where + "." + name);
}

Vertices::Vertices(const Document& document, const tinygltf::Primitive& primitive,
                   const PlacedNode& node, const std::vector<Affine>* joints,
                   const std::string& where)
    : where_(fmt::format("{}: {}", document.file, where)),
      node_to_world_(node.to_world),
      joints_(joints) {
  const auto find = [&](const std::map<std::string, int>& attributes, const std::string& name,
                        int type, const std::string& of) {
    auto found = find_attribute(document, attributes, name, type, where + "." + of);
    if (found && positions_ && found->size() != positions_->size())
      throw Error(fmt::format("{}.{}.{}: {} elements; as many as positions, {}", where_, of, name,
                              found->size(), positions_->size()));
    return found;
  };
  constexpr int vec3 = TINYGLTF_TYPE_VEC3, vec4 = TINYGLTF_TYPE_VEC4;
  positions_ = find(primitive.attributes, "POSITION", vec3, "attributes");
  normals_ = find(primitive.attributes, "NORMAL", vec3, "attributes");
  for (std::size_t i = 0; i < std::min(primitive.targets.size(), node.weights.size()); ++i) {
    if (node.weights[i] == 0) continue;
    const std::string of = fmt::format("targets[{}]", i);
    targets_.push_back({node.weights[i], find(primitive.targets[i], "POSITION", vec3, of),
                        find(primitive.targets[i], "NORMAL", vec3, of)});
  }
  for (int set = 0; joints_ != nullptr; ++set) {
    auto bound = find(primitive.attributes, fmt::format("JOINTS_{}", set), vec4, "attributes");
    auto weights = find(primitive.attributes, fmt::format("WEIGHTS_{}", set), vec4, "attributes");
    if (!bound || !weights) break;
    if (!bound->is_unsigned())
      throw Error(
          fmt::format("{}.attributes.JOINTS_{}: its components are signed or fractions; "
                      "unsigned whole numbers",
                      where_, set));
    bonds_.push_back({*std::move(bound), *std::move(weights)});
  }
}

std::pair<Vec3<double>, Vec3<double>> Vertices::operator[](std::size_t i) const {
  Vec3<double> position = vec3(positions_->floats(i)), normal{0, 0, 0};
  if (normals_) normal = vec3(normals_->floats(i));
  for (const Target& target : targets_) {
    if (target.positions) position = position + vec3(target.positions->floats(i)) * target.weight;
    if (target.normals) normal = normal + vec3(target.normals->floats(i)) * target.weight;
  }
  const Affine map = to_world(i);
  return {map.point(position), map.normal(normal)};
}

/// By joints, whose weights count as parts of their sum.
Affine Vertices::to_world(std::size_t i) const {
  Affine map{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  double all = 0;
  for (const Bond& bond : bonds_) {
    const std::array<float, 4> joints = bond.joints.floats(i), weights = bond.weights.floats(i);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!(weights[k] > 0)) continue;
      if (!(double(joints[k]) < double(joints_->size())))
        throw Error(fmt::format("{}.attributes: vertex {} is bound to joint {}; a joint below {}",
                                where_, i, joints[k], joints_->size()));
      map = sum(map, (*joints_)[std::size_t(joints[k])], weights[k]);
      all += double(weights[k]);
    }
  }
  if (!(all > 0)) return node_to_world_;
  return sum({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, map, 1 / all);
}

}  // namespace airlight::gltf
