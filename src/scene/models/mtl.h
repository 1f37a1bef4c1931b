#pragma once
#include <tiny_obj_loader.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/models/model.h"

namespace airlight {

/// Reads the MTL files that a line of an OBJ file beside them names, with `joint` for blanks: one
/// with blanks in its name, or else all of several. One that is missing is no error but a remark;
/// one without its numbers throws Error.
class MtlReader : public tinyobj::MaterialReader {
 public:
  explicit MtlReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* indices, std::string* warning,
                  std::string* error) override;

  /// What is missing or out of range, a sentence each.
  const std::vector<std::string>& remarks() const { return remarks_; }

  /// The names of the materials that are grey because no line tells their colour.
  const std::vector<std::string>& colourless() const { return colourless_; }

 private:
  void read(const std::filesystem::path& path, std::vector<tinyobj::material_t>& materials,
            std::map<std::string, int>& indices, std::string* warning, std::string* error);

  std::filesystem::path folder_;
  std::vector<std::string> remarks_, colourless_;
};

/// Turns materials as an MTL file describes them into ours, in the same order, and adds their
/// textures to the model's. Kd, map_Kd, d or Tr, map_d and Tf count. An alpha channel of map_Kd
/// cuts out if there is no map_d, as leaves do. No material (null) is grey. Names of textures count
/// from `folder`. Throws Error if one cannot be read.
std::vector<Material> convert_mtl(const std::vector<const tinyobj::material_t*>& materials,
                                  const std::filesystem::path& folder,
                                  std::vector<Texture>& textures);

/// Scales and shifts texture coordinates as the options -s and -o of map_Kd say.
void place_texture(const tinyobj::material_t& mtl, Mesh& mesh);

}  // namespace airlight
