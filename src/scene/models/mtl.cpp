#include "scene/models/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "error.h"
#include "image/read_file.h"
#include "scene/models/decode_together.h"
#include "scene/models/mtl_text.h"
#include "scene/models/text_lines.h"
#include "scene/models/transparent_texels.h"

namespace airlight {
namespace {

/// Exporters on Windows write its separators.
std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

std::string with_blanks(std::string name) {
  std::replace(name.begin(), name.end(), joint, ' ');
  return name;
}

double fraction(double x) { return std::isfinite(x) ? std::clamp(x, 0.0, 1.0) : 1.0; }

Rgb<double> fraction(const tinyobj::real_t (&c)[3]) {
  return {fraction(c[0]), fraction(c[1]), fraction(c[2])};
}

bool is_black(const Rgb<double>& c) { return c == Rgb<double>(0, 0, 0); }

/// A texture that a material wants. Materials that want the same share it.
struct Wanted {
  std::string name;
  bool srgb, clamp;
  const char* key;  ///< of the first material to want it, for errors
  const std::string* material;

  bool operator==(const Wanted& other) const {
    return name == other.name && srgb == other.srgb && clamp == other.clamp;
  }
};

Wanted albedo_texture(const tinyobj::material_t& mtl) {
  return {mtl.diffuse_texname, true, mtl.diffuse_texopt.clamp, "map_Kd", &mtl.name};
}

Wanted opacity_texture(const tinyobj::material_t& mtl) {
  return {mtl.alpha_texname, false, mtl.alpha_texopt.clamp, "map_d", &mtl.name};
}

Texture load(const Wanted& wanted, const std::filesystem::path& folder) {
  try {
    Texture texture = load_texture(folder / with_slashes(wanted.name));
    texture.srgb = wanted.srgb;
    if (wanted.clamp) texture.wrap_u = texture.wrap_v = Wrap::clamp;
    return texture;
  } catch (const Error& error) {
    throw Error(fmt::format("{} (wanted by {} of material \"{}\")", error.what(), wanted.key,
                            *wanted.material));
  }
}

/// The textures of all materials, each once, and where they stand among the model's.
class TextureList {
 public:
  void want(Wanted wanted) {
    if (!wanted.name.empty() && std::find(list_.begin(), list_.end(), wanted) == list_.end())
      list_.push_back(std::move(wanted));
  }

  void load_all(const std::filesystem::path& folder, std::vector<Texture>& textures) {
    begin_ = textures.size();
    std::vector<std::function<Texture()>> loaders;
    for (const Wanted& wanted : list_) loaders.push_back([&] { return load(wanted, folder); });
    for (Texture& texture : decode_together(loaders)) textures.push_back(std::move(texture));
  }

  /// The index of a texture, −1 if it has no name.
  int find(const Wanted& wanted) const {
    if (wanted.name.empty()) return -1;
    return int(begin_) + int(std::find(list_.begin(), list_.end(), wanted) - list_.begin());
  }

 private:
  std::vector<Wanted> list_;
  std::size_t begin_ = 0;
};

Material convert(const tinyobj::material_t& mtl, int albedo_texture, int opacity_texture,
                 const std::vector<Texture>& textures) {
  const auto cuts_out = [&](int i) {
    return i >= 0 && has_transparent_texels(textures[std::size_t(i)]);
  };
  Material material;
  material.albedo = fraction(mtl.diffuse);
  material.albedo_texture = albedo_texture;
  // Some exporters write black beside a texture, which would hide it.
  if (albedo_texture >= 0 && is_black(material.albedo)) material.albedo = Rgb<double>(1);
  material.opacity = fraction(mtl.dissolve);
  // Some write d 0 beside a texture of opacity.
  if (opacity_texture >= 0 && material.opacity == 0) material.opacity = 1;
  material.opacity_texture = opacity_texture >= 0       ? opacity_texture
                             : cuts_out(albedo_texture) ? albedo_texture
                                                        : -1;
  // A picture with transparent texels is meant by its alpha, any other by its brightness.
  material.opacity_from_alpha = cuts_out(material.opacity_texture);
  const Rgb<double> filter = fraction(mtl.transmittance);
  if (!is_black(filter)) material.tint = filter;  // black is also what a file without Tf gives
  return material;
}

}  // namespace

bool MtlReader::operator()(const std::string& names, std::vector<tinyobj::material_t>* materials,
                           std::map<std::string, int>* indices, std::string* warning,
                           std::string* error) {
  const auto is_there = [&](const std::string& name) {
    return std::filesystem::is_regular_file(folder_ / name);
  };
  const std::string whole = with_blanks(names);
  std::vector<std::string> files = {whole};
  if (!is_there(whole)) {
    files.clear();
    std::string_view rest = whole;
    for (std::string_view word; !(word = next_word(rest)).empty();) files.emplace_back(word);
    if (std::ranges::none_of(files, is_there)) files = {whole};
  }
  bool any = false;
  for (const std::string& name : files)
    if (is_there(name)) {
      read(folder_ / name, *materials, *indices, warning, error);
      any = true;
    } else {
      remarks_.push_back(fmt::format("{} is missing", name));
    }
  return any;
}

void MtlReader::read(const std::filesystem::path& path, std::vector<tinyobj::material_t>& materials,
                     std::map<std::string, int>& indices, std::string* warning,
                     std::string* error) {
  const std::string content = read_text(path);
  if (auto remark = check_mtl_numbers(content, path.string()))
    remarks_.push_back(std::move(*remark));
  std::istringstream text(complete_mtl(content, colourless_));
  tinyobj::LoadMtl(&indices, &materials, &text, warning, error);
  for (tinyobj::material_t& material : materials) material.name = with_blanks(material.name);
}

void place_texture(const tinyobj::material_t& mtl, Mesh& mesh) {
  const auto& shift = mtl.diffuse_texopt.origin_offset;
  const auto& scale = mtl.diffuse_texopt.scale;
  if (mtl.diffuse_texname.empty() ||
      (shift[0] == 0 && shift[1] == 0 && scale[0] == 1 && scale[1] == 1))
    return;
  for (auto& [u, v] : mesh.uvs) u = u * scale[0] + shift[0], v = v * scale[1] + shift[1];
}

std::vector<Material> convert_mtl(const std::vector<const tinyobj::material_t*>& materials,
                                  const std::filesystem::path& folder,
                                  std::vector<Texture>& textures) {
  TextureList list;
  for (const auto* mtl : materials) {
    if (mtl == nullptr) continue;
    list.want(albedo_texture(*mtl));
    list.want(opacity_texture(*mtl));
  }
  list.load_all(folder, textures);
  std::vector<Material> converted;
  for (const auto* mtl : materials)
    converted.push_back(mtl == nullptr ? Material{}
                                       : convert(*mtl, list.find(albedo_texture(*mtl)),
                                                 list.find(opacity_texture(*mtl)), textures));
  return converted;
}

}  // namespace airlight
