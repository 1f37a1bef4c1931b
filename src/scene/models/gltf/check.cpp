#include "scene/models/gltf/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <limits>

#include "error.h"

namespace airlight::gltf {
namespace {

constexpr int deepest = 64;
constexpr double largest_integer =
    9007199254740992;  // 2^53, beyond which JSON's numbers are not exact
constexpr double largest_int = std::numeric_limits<int>::max();

const std::vector<std::string> supported_extensions = {
    "KHR_lights_punctual",        "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission", "KHR_mesh_quantization",
    "KHR_texture_transform",
};

bool is_supported(const std::string& extension) {
  return std::ranges::find(supported_extensions, extension) != supported_extensions.end();
}

/// JSON as an error shows it.
std::string shown(const Json& value) {
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() > 40 ? text.substr(0, 40) + "..." : text;
}

/// A value of the document and where it stands, such as "meshes[2].primitives[0]".
struct Place {
  const Json* value;
  std::string path;

  std::string below(const std::string& key) const { return path.empty() ? key : path + "." + key; }
};

class Checker {
 public:
  Checker(const Json& document, const std::string& file) : root_{&document, ""}, file_(file) {}

  void check() const {
    if (!root_.value->is_object()) fail("the document", shown(*root_.value), "an object");
    for (const char* list :
         {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers", "images", "textures",
          "samplers", "materials", "cameras", "animations", "skins"})
      array(root_, list);
    asset();
    extensions();
    index(root_, "scene", "scenes");
    each(root_, "scenes", [&](const Place& scene) { indices(scene, "nodes", "nodes"); });
    each(root_, "nodes", [&](const Place& p) { node(p); });
    each(root_, "meshes", [&](const Place& p) { mesh(p); });
    each(root_, "accessors", [&](const Place& p) { accessor(p); });
    each(root_, "bufferViews", [&](const Place& p) { buffer_view(p); });
    each(root_, "buffers", [&](const Place& p) { buffer(p); });
    each(root_, "images", [&](const Place& p) { image(p); });
    each(root_, "textures", [&](const Place& p) { texture(p); });
    each(root_, "samplers", [&](const Place& p) { sampler(p); });
    each(root_, "materials", [&](const Place& p) { material(p); });
    each(root_, "cameras", [&](const Place& p) { camera(p); });
    each(root_, "skins", [&](const Place& p) { skin(p); });
    each(root_, "animations", [&](const Place& p) { animation(p); });
    if (const auto lights = extension(root_, "KHR_lights_punctual"))
      each(*lights, "lights", [&](const Place& p) { light(p); });
  }

 private:
  static constexpr bool required = true;

  [[noreturn]] void fail(const std::string& path, const std::string& found,
                         const std::string& accepted) const {
    throw Error(fmt::format("{}: {}: {}; {}", file_, path, found, accepted));
  }

  // The kinds of members.

  std::optional<Place> member(const Place& parent, const char* key, bool is_required = false,
                              const char* accepted = "it is required") const {
    const auto found = parent.value->find(key);
    if (found != parent.value->end()) return Place{&*found, parent.below(key)};
    if (is_required) fail(parent.below(key), "missing", accepted);
    return std::nullopt;
  }

  std::optional<Place> object(const Place& parent, const char* key,
                              bool is_required = false) const {
    auto place = member(parent, key, is_required);
    if (place && !place->value->is_object()) fail(place->path, shown(*place->value), "an object");
    return place;
  }

  std::optional<Place> extension(const Place& parent, const char* name) const {
    const auto all = object(parent, "extensions");
    return all ? object(*all, name) : std::nullopt;
  }

  std::optional<Place> array(const Place& parent, const char* key, bool is_required = false) const {
    auto place = member(parent, key, is_required);
    if (place && !place->value->is_array()) fail(place->path, shown(*place->value), "an array");
    return place;
  }

  static Place element(const Place& list, std::size_t i) {
    return {&(*list.value)[i], fmt::format("{}[{}]", list.path, i)};
  }

  template <class Visit>
  void each(const Place& parent, const char* key, Visit&& visit, bool is_required = false) const {
    const auto list = array(parent, key, is_required);
    for (std::size_t i = 0; list && i < list->value->size(); ++i) {
      const Place item = element(*list, i);
      if (!item.value->is_object()) fail(item.path, shown(*item.value), "an object");
      visit(item);
    }
  }

  void in_range(const Place& place, double low, double high, bool whole) const {
    const bool right_type = whole ? place.value->is_number_integer() : place.value->is_number();
    if (right_type && place.value->get<double>() >= low && place.value->get<double>() <= high)
      return;
    const bool bounded = high < std::numeric_limits<double>::max();
    fail(place.path, shown(*place.value),
         bounded ? fmt::format("{} from {} to {}", whole ? "a whole number" : "a number", low, high)
                 : "a number");
  }

  void integer(const Place& parent, const char* key, double low, double high = largest_integer,
               bool is_required = false) const {
    if (const auto place = member(parent, key, is_required)) in_range(*place, low, high, true);
  }

  void number(const Place& parent, const char* key, double low, double high,
              bool is_required = false) const {
    if (const auto place = member(parent, key, is_required)) in_range(*place, low, high, false);
  }

  void numbers(const Place& parent, const char* key, std::size_t count,
               double low = std::numeric_limits<double>::lowest(),
               double high = std::numeric_limits<double>::max()) const {
    const auto list = array(parent, key);
    if (!list) return;
    if (list->value->size() != count)
      fail(list->path, fmt::format("{} values", list->value->size()),
           fmt::format("{} numbers", count));
    for (std::size_t i = 0; i < count; ++i) in_range(element(*list, i), low, high, false);
  }

  void text(const Place& parent, const char* key, bool is_required = false) const {
    const auto place = member(parent, key, is_required);
    if (place && !place->value->is_string()) fail(place->path, shown(*place->value), "a text");
  }

  void word(const Place& parent, const char* key, std::initializer_list<const char*> words,
            bool is_required = false) const {
    const auto place = member(parent, key, is_required);
    if (!place) return;
    const auto is = [&](const char* w) { return place->value->is_string() && *place->value == w; };
    if (std::none_of(words.begin(), words.end(), is))
      fail(place->path, shown(*place->value), fmt::format("{}", fmt::join(words, ", ")));
  }

  void code(const Place& parent, const char* key, std::initializer_list<int> codes,
            bool is_required = false) const {
    const auto place = member(parent, key, is_required);
    if (!place) return;
    const auto is = [&](int c) { return place->value->is_number_integer() && *place->value == c; };
    if (std::none_of(codes.begin(), codes.end(), is))
      fail(place->path, shown(*place->value), fmt::format("{}", fmt::join(codes, ", ")));
  }

  void flag(const Place& parent, const char* key) const {
    const auto place = member(parent, key);
    if (place && !place->value->is_boolean())
      fail(place->path, shown(*place->value), "true or false");
  }

  std::size_t count(const char* list) const {
    const auto found = root_.value->find(list);
    return found == root_.value->end() || !found->is_array() ? 0 : found->size();
  }

  void in_list(const Place& place, std::size_t size, const char* list) const {
    const Json& value = *place.value;
    if (value.is_number_unsigned() && value.get<std::uint64_t>() < size) return;
    fail(place.path, shown(value),
         size == 0 ? fmt::format("there are no {}", list)
                   : fmt::format("an index from 0 to {} into {}", size - 1, list));
  }

  void index(const Place& parent, const char* key, const char* list,
             bool is_required = false) const {
    if (const auto place = member(parent, key, is_required)) in_list(*place, count(list), list);
  }

  void indices(const Place& parent, const char* key, const char* list) const {
    const auto place = array(parent, key);
    for (std::size_t i = 0; place && i < place->value->size(); ++i)
      in_list(element(*place, i), count(list), list);
  }

  // The parts of a document.

  void asset() const {
    const auto place = object(root_, "asset", required);
    text(*place, "version", required);
    text(*place, "minVersion");
    for (const char* key : {"version", "minVersion"}) {
      const auto version = member(*place, key);
      if (!version) continue;
      const auto number = version->value->get<std::string>();
      const bool accepted =
          key == std::string("version") ? number.starts_with("2.") : number == "2.0";
      if (!accepted) fail(version->path, shown(*version->value), "\"2.0\"");
    }
  }

  void extensions() const {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
      const auto list = array(root_, key);
      for (std::size_t i = 0; list && i < list->value->size(); ++i) {
        const Place name = element(*list, i);
        if (!name.value->is_string()) fail(name.path, shown(*name.value), "a text");
        const auto extension = name.value->get<std::string>();
        if (key == std::string("extensionsRequired") && !is_supported(extension))
          fail(name.path, fmt::format("{} is not supported", extension),
               fmt::format("{}", fmt::join(supported_extensions, ", ")));
      }
    }
  }

  void node(const Place& node) const {
    text(node, "name");
    indices(node, "children", "nodes");
    index(node, "mesh", "meshes");
    index(node, "camera", "cameras");
    index(node, "skin", "skins");
    weights(node);
    numbers(node, "matrix", 16);
    numbers(node, "translation", 3);
    numbers(node, "rotation", 4);
    numbers(node, "scale", 3);
    const auto punctual = extension(node, "KHR_lights_punctual");
    if (!punctual) return;
    const auto all = extension(root_, "KHR_lights_punctual");
    const auto lights = all ? array(*all, "lights") : std::nullopt;
    in_list(*member(*punctual, "light", required), lights ? lights->value->size() : 0, "lights");
  }

  void weights(const Place& parent) const {
    if (const auto list = array(parent, "weights")) numbers(parent, "weights", list->value->size());
  }

  void skin(const Place& skin) const {
    array(skin, "joints", required);
    indices(skin, "joints", "nodes");
    index(skin, "inverseBindMatrices", "accessors");
  }

  void mesh(const Place& mesh) const {
    text(mesh, "name");
    weights(mesh);
    each(
        mesh, "primitives", [&](const Place& p) { primitive(p); }, required);
  }

  void attributes(const Place& attributes) const {
    for (const auto& [key, value] : attributes.value->items())
      in_list({&value, attributes.below(key)}, count("accessors"), "accessors");
  }

  void primitive(const Place& primitive) const {
    attributes(*object(primitive, "attributes", required));
    each(primitive, "targets", [&](const Place& target) { attributes(target); });
    index(primitive, "indices", "accessors");
    index(primitive, "material", "materials");
    integer(primitive, "mode", 0, 6);
  }

  void accessor(const Place& accessor) const {
    index(accessor, "bufferView", "bufferViews");
    integer(accessor, "byteOffset", 0);
    code(accessor, "componentType", {5120, 5121, 5122, 5123, 5125, 5126}, required);
    flag(accessor, "normalized");
    integer(accessor, "count", 1, largest_integer, required);
    word(accessor, "type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}, required);
    const auto sparse = object(accessor, "sparse");
    if (!sparse) return;
    integer(*sparse, "count", 1, largest_int, required);
    for (const char* key : {"indices", "values"}) {
      const auto part = object(*sparse, key, required);
      index(*part, "bufferView", "bufferViews", required);
      integer(*part, "byteOffset", 0, largest_int);
    }
    code(*object(*sparse, "indices"), "componentType", {5121, 5123, 5125}, required);
  }

  void buffer_view(const Place& view) const {
    index(view, "buffer", "buffers", required);
    integer(view, "byteOffset", 0);
    integer(view, "byteLength", 1, largest_integer, required);
    integer(view, "byteStride", 4, 252);
  }

  void buffer(const Place& buffer) const {
    integer(buffer, "byteLength", 1, largest_integer, required);
    text(buffer, "uri");
  }

  void image(const Place& image) const {
    text(image, "uri");
    index(image, "bufferView", "bufferViews");
    if (member(image, "uri").has_value() == member(image, "bufferView").has_value())
      fail(image.path, "neither or both of uri and bufferView", "one of them");
  }

  void texture(const Place& texture) const {
    index(texture, "source", "images");
    index(texture, "sampler", "samplers");
  }

  void sampler(const Place& sampler) const {
    code(sampler, "wrapS", {10497, 33071, 33648});
    code(sampler, "wrapT", {10497, 33071, 33648});
  }

  void material(const Place& material) const {
    text(material, "name");
    word(material, "alphaMode", {"OPAQUE", "MASK", "BLEND"});
    number(material, "alphaCutoff", 0, std::numeric_limits<double>::max());
    if (const auto pbr = object(material, "pbrMetallicRoughness")) {
      numbers(*pbr, "baseColorFactor", 4, 0, 1);
      if (const auto info = object(*pbr, "baseColorTexture")) texture_info(*info);
    }
    if (const auto gloss = extension(material, "KHR_materials_pbrSpecularGlossiness")) {
      numbers(*gloss, "diffuseFactor", 4, 0, 1);
      if (const auto info = object(*gloss, "diffuseTexture")) texture_info(*info);
    }
    if (const auto transmission = extension(material, "KHR_materials_transmission"))
      number(*transmission, "transmissionFactor", 0, 1);
  }

  void texture_info(const Place& info) const {
    index(info, "index", "textures", required);
    integer(info, "texCoord", 0, largest_int);
    const auto transform = extension(info, "KHR_texture_transform");
    if (!transform) return;
    numbers(*transform, "offset", 2);
    numbers(*transform, "scale", 2);
    number(*transform, "rotation", std::numeric_limits<double>::lowest(),
           std::numeric_limits<double>::max());
    integer(*transform, "texCoord", 0, largest_int);
  }

  void camera(const Place& camera) const {
    word(camera, "type", {"perspective", "orthographic"}, required);
    if (*member(camera, "type")->value != "perspective") return;
    number(*object(camera, "perspective", required), "yfov", 1e-3, 3.14, required);
  }

  void animation(const Place& animation) const {
    const auto samplers = array(animation, "samplers", required);
    each(animation, "samplers", [&](const Place& sampler) {
      index(sampler, "input", "accessors", required);
      index(sampler, "output", "accessors", required);
      word(sampler, "interpolation", {"LINEAR", "STEP", "CUBICSPLINE"});
    });
    each(
        animation, "channels",
        [&](const Place& channel) {
          in_list(*member(channel, "sampler", required), samplers->value->size(), "samplers");
          const auto target = object(channel, "target", required);
          index(*target, "node", "nodes");
          text(*target, "path", required);
          if (member(*target, "node"))
            word(*target, "path", {"translation", "rotation", "scale", "weights"});
        },
        required);
  }

  void light(const Place& light) const {
    word(light, "type", {"directional", "point", "spot"}, required);
    numbers(light, "color", 3, 0, std::numeric_limits<double>::max());
    number(light, "intensity", 0, std::numeric_limits<double>::max());
  }

  Place root_;
  std::string file_;
};

}  // namespace

Json parse_json(std::string_view text, const std::string& file) {
  const auto watch_depth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest)
      throw Error(
          fmt::format("{}: JSON nested deeper than {} levels; a glTF 2.0 document", file, deepest));
    return true;
  };
  try {
    return Json::parse(text, watch_depth);
  } catch (const Json::parse_error& error) {
    const std::string_view before =
        text.substr(0, std::min(text.size(), error.byte > 0 ? error.byte - 1 : 0));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
    throw Error(fmt::format("{}:{}:{}: not JSON from here on; a glTF 2.0 document", file, line,
                            before.size() - start + 1));
  } catch (const Json::exception&) {  // a number beyond double
    throw Error(fmt::format("{}: a number beyond 1.8e308; finite numbers", file));
  }
}

void check_document(const Json& document, const std::string& file) {
  Checker(document, file).check();
}

std::vector<std::string> extensions_left_out(const Json& document) {
  std::vector<std::string> left_out;
  for (const Json& name : document.value("extensionsUsed", Json::array()))
    if (!is_supported(name)) left_out.push_back(name);
  return left_out;
}

}  // namespace airlight::gltf
