#include "scene/models/gltf/nodes.h"

#include <fmt/format.h>

#include <cmath>

#include "error.h"

namespace airlight::gltf {
namespace {

constexpr int nobody = -1;

/// The parent of every node. Throws Error if one has two.
std::vector<int> find_parents(const Document& document) {
  const auto& nodes = document.model.nodes;
  std::vector<int> parents(nodes.size(), nobody);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const int child : nodes[i].children) {
      int& parent = parents[std::size_t(child)];
      if (parent != nobody)
        throw Error(fmt::format(
            "{}: nodes[{}].children: node {} is already a child of node {}; one parent each",
            document.file, i, child, parent));
      parent = int(i);
    }
  return parents;
}

/// Throws Error if going from child to parent never ends.
void check_acyclic(const Document& document, const std::vector<int>& parents) {
  std::vector<int> walked_from(parents.size(), nobody);
  for (int start = 0; start < int(parents.size()); ++start) {
    int i = start;
    for (; i != nobody && walked_from[std::size_t(i)] == nobody; i = parents[std::size_t(i)])
      walked_from[std::size_t(i)] = start;
    if (i != nobody && walked_from[std::size_t(i)] == start)
      throw Error(
          fmt::format("{}: nodes[{}]: it is its own ancestor; a tree of nodes", document.file, i));
  }
}

/// The roots of the scene that is to be shown.
std::vector<int> find_roots(const Document& document, const std::vector<int>& parents) {
  const tinygltf::Model& model = document.model;
  std::vector<int> roots;
  if (model.scenes.empty()) {
    for (int i = 0; i < int(parents.size()); ++i)
      if (parents[std::size_t(i)] == nobody) roots.push_back(i);
    return roots;
  }
  const int scene = std::max(model.defaultScene, 0);
  std::vector<bool> listed(parents.size(), false);
  for (const int node : model.scenes[std::size_t(scene)].nodes) {
    if (parents[std::size_t(node)] != nobody || listed[std::size_t(node)])
      throw Error(
          fmt::format("{}: scenes[{}].nodes: node {} is a child or listed twice; roots, once each",
                      document.file, scene, node));
    listed[std::size_t(node)] = true;
    roots.push_back(node);
  }
  return roots;
}

Vec3<double> vec3(const std::vector<double>& v, const Vec3<double>& otherwise) {
  return v.size() == 3 ? Vec3<double>(v[0], v[1], v[2]) : otherwise;
}

/// The rotation by a quaternion (x, y, z, w) of any length.
Affine rotation(const std::vector<double>& q, const std::string& where) {
  if (q.size() != 4) return {};
  const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(squared > 1e-20 && std::isfinite(squared)))
    throw Error(fmt::format("{}.rotation: a quaternion of length {:.3g}; a unit quaternion", where,
                            std::sqrt(squared)));
  const double s = 2 / squared, x = q[0], y = q[1], z = q[2], w = q[3];
  return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
          {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
          {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)},
          {0, 0, 0}};
}

Affine to_parent(const tinygltf::Node& node, const std::string& where) {
  if (const auto& m = node.matrix; m.size() == 16)  // column by column
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  const Vec3<double> scale = vec3(node.scale, {1, 1, 1});
  Affine map = rotation(node.rotation, where);
  map.x = map.x * scale.x, map.y = map.y * scale.y, map.z = map.z * scale.z;
  map.origin = vec3(node.translation, {0, 0, 0});
  return map;
}

/// A unit vector, or `otherwise` if v has no direction.
Vec3<double> direction(const Vec3<double>& v, const Vec3<double>& otherwise) {
  const double l = length(v);
  return l > 0 && std::isfinite(l) ? v * (1 / l) : otherwise;
}

const tinygltf::Light* light_of(const tinygltf::Model& model, const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_lights_punctual");
  if (found == node.extensions.end()) return nullptr;
  return &model.lights[std::size_t(found->second.Get("light").GetNumberAsInt())];
}

}  // namespace

std::vector<PlacedNode> place_nodes(const Document& document, const Poses& poses) {
  const std::vector<int> parents = find_parents(document);
  check_acyclic(document, parents);
  std::vector<PlacedNode> waiting;
  for (const int root : find_roots(document, parents)) waiting.push_back({root, {}});
  std::reverse(waiting.begin(), waiting.end());
  std::vector<PlacedNode> placed;
  while (!waiting.empty()) {  // depth first, children in order; no recursion: files nest as deep as
                              // they like
    PlacedNode next = waiting.back();
    waiting.pop_back();
    const tinygltf::Node& node = document.model.nodes[std::size_t(next.node)];
    const auto posed = poses.find(next.node);
    const tinygltf::Node& now = posed == poses.end() ? node : posed->second;
    next.to_world =
        next.to_world * to_parent(now, fmt::format("{}: nodes[{}]", document.file, next.node));
    next.weights = now.weights;
    if (next.weights.empty() && node.mesh >= 0)
      next.weights = document.model.meshes[std::size_t(node.mesh)].weights;
    placed.push_back(next);
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      waiting.push_back({*child, next.to_world});
  }
  return placed;
}

std::optional<Camera> find_camera(const Document& document, const std::vector<PlacedNode>& nodes,
                                  std::vector<std::string>& remarks) {
  bool saw_others = false;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document.model.nodes[std::size_t(placed.node)];
    if (node.camera < 0) continue;
    const tinygltf::Camera& found = document.model.cameras[std::size_t(node.camera)];
    if (found.type != "perspective") {
      saw_others = true;
      continue;
    }
    const Affine& to_world = placed.to_world;
    if (!std::isfinite(length(to_world.origin)))
      throw Error(fmt::format("{}: nodes[{}]: its camera is infinitely far away; a finite place",
                              document.file, placed.node));
    Camera camera;
    camera.position = to_world.origin;
    camera.target = camera.position + direction(-to_world.z, {0, 0, -1});
    camera.up = direction(to_world.y, {0, 1, 0});
    camera.fov = found.perspective.yfov * (180 / pi);
    return camera;
  }
  if (saw_others) remarks.push_back("orthographic cameras of the file are left out");
  return std::nullopt;
}

std::vector<Directional> find_lights(const Document& document, const std::vector<PlacedNode>& nodes,
                                     std::vector<std::string>& remarks) {
  std::vector<Directional> lights;
  std::size_t left_out = 0;
  for (const PlacedNode& placed : nodes) {
    const auto* found = light_of(document.model, document.model.nodes[std::size_t(placed.node)]);
    if (found == nullptr) continue;
    if (found->type != "directional") {
      ++left_out;
      continue;
    }
    const auto& color = found->color;
    Directional light;
    light.irradiance =
        color.size() == 3 ? Rgb<double>(color[0], color[1], color[2]) : Rgb<double>(1);
    light.irradiance = light.irradiance * found->intensity;
    light.direction = direction(-placed.to_world.z, {0, 0, -1});
    lights.push_back(light);
  }
  if (left_out > 0)
    remarks.push_back(fmt::format("{} point and spot lights of the file are left out", left_out));
  return lights;
}

}  // namespace airlight::gltf
