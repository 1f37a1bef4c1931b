#pragma once
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Writes small glTF files: JSON that a test changes at will, and one buffer.
struct GltfBuilder {
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
  std::string bytes;

  /// Adds numbers as an accessor of their own buffer view and returns its index.
  template <class T>
  int accessor(const std::vector<T>& numbers, int component_type, const std::string& type,
               int components) {
    json["accessors"].push_back({{"bufferView", view(numbers)},
                                 {"componentType", component_type},
                                 {"count", numbers.size() / std::size_t(components)},
                                 {"type", type}});
    return int(json["accessors"].size()) - 1;
  }

  int positions(const std::vector<float>& xyz) { return accessor(xyz, 5126, "VEC3", 3); }

  /// Adds bytes, 4-aligned, as a buffer view and returns its index.
  template <class T>
  int view(const std::vector<T>& numbers) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", numbers.size() * sizeof(T)}});
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    return int(json["bufferViews"].size()) - 1;
  }

  /// Adds a mesh of one primitive and a node that shows it, and returns the node.
  int node(nlohmann::json primitive) {
    json["meshes"].push_back({{"primitives", {std::move(primitive)}}});
    json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
    return int(json["nodes"].size()) - 1;
  }

  /// A .glb file as text.
  std::string glb() const {
    nlohmann::json document = json;
    std::string binary = bytes;
    binary.resize((binary.size() + 3) / 4 * 4);
    if (!binary.empty() && !document.contains("buffers"))
      document["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file = "glTF";
    word(file, 2);
    word(file, 20 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
    chunk(file, text, "JSON");
    if (!binary.empty()) chunk(file, binary, std::string("BIN\0", 4));
    return file;
  }

  /// A .gltf file that names a file, or carries its buffer as a data URI.
  std::string gltf(const std::string& uri) const {
    nlohmann::json document = json;
    document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
    return document.dump(1);
  }

 private:
  static void word(std::string& file, std::size_t value) {
    for (int i = 0; i < 4; ++i) file += char(value >> (8 * i) & 255);
  }
  static void chunk(std::string& file, const std::string& content, const std::string& type) {
    word(file, content.size());
    file += type + content;
  }
};

inline std::filesystem::path write_text(const std::filesystem::path& path,
                                        const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  return path;
}
