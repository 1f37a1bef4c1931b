#include "scene/load_scene.h"

#include <fmt/format.h>

#include "error.h"
#include "extension.h"
#include "scene/animation.h"
#include "scene/reader.h"
#include "scene/scene_document.h"
#include "scene/stand_in.h"

namespace airlight {
namespace {

/// The moment that a document shows.  [s]
double seconds_of(const Value& document) {
  RenderSettings render;
  if (const auto found = Cursor(document).find("render")) read_table(*found, render);
  return render.seconds();
}

void apply_all(const std::vector<Override>& overrides, Value& document) {
  for (const Override& change : overrides) apply(change, document);
}

}  // namespace

/// What has been read: a scene file, or a model and the scene file that it stands for.
class SceneFile::Content {
 public:
  Content(Value document, std::filesystem::path folder)
      : document_(std::move(document)), files_{std::move(folder)} {}

  explicit Content(const std::filesystem::path& path) : files_{path.parent_path()} {
    const std::string extension = extension_of(path);
    if (extension == ".toml") {
      document_ = read_document(path);
      return;
    }
    if (extension != ".obj" && extension != ".gltf" && extension != ".glb")
      throw Error(path.string() + ": is no scene by its name; accepted: .glb, .gltf, .obj, .toml");
    model_ = files_.folder / path.filename();
    name_ = path.string();
    const ModelFile& file = files_.open(*model_);
    const auto begin = [&](const Model& model) {
      stand_in_.emplace(model, model_->filename().string());
      document_ = parse_document(stand_in_->toml(model), name_);
    };
    moves_ = !file.still();
    moves_ ? begin(file.at(0)) : begin(*file.still());
  }

  /// The scene file as it reads at its frame, and when that is.
  std::pair<Value, double> document(const std::vector<Override>& overrides) const {
    Value document = document_;
    apply_all(overrides, document);
    const double seconds = seconds_of(document);
    if (moves_) {
      document = parse_document(stand_in_->toml(files_.open(*model_).at(seconds)), name_);
      apply_all(overrides, document);
    }
    animate(document);
    apply_all(overrides, document);  // what the user says holds
    return {std::move(document), seconds};
  }

  /// `keep`: files are kept for the next frame.
  Scene scene(const std::vector<Override>& overrides, bool keep) const {
    const auto [document, seconds] = this->document(overrides);
    Files files = files_;
    files.seconds = seconds;
    files.keep = keep;
    Scene scene = scene_of(document, files);
    if (!stand_in_) return scene;
    if (std::string remark = stand_in_->remark(overrides); !remark.empty())
      scene.assumptions.push_back(std::move(remark));
    return scene;
  }

  const Files& files() const { return files_; }

 private:
  Value document_;
  Files files_;
  std::string name_;  ///< of a model, for errors
  std::optional<std::filesystem::path> model_;
  std::optional<StandIn> stand_in_;
  bool moves_ = false;
};

SceneFile::SceneFile(const std::filesystem::path& path, std::vector<Override> overrides)
    : content_(std::make_unique<Content>(path)), overrides_(std::move(overrides)) {}
SceneFile::~SceneFile() = default;
SceneFile::SceneFile(SceneFile&&) noexcept = default;

Scene SceneFile::scene(std::int64_t frame) const {
  constexpr bool keep = true;
  return content_->scene(overrides_at(frame), keep);
}

void SceneFile::check(std::int64_t frame) const {
  const Value value = content_->document(overrides_at(frame)).first;
  const SceneDocument document = read_scene_document(value);
  try {
    check_without_files(document, value);
    check_plate(document, value, content_->files());
  } catch (const Error& error) {
    throw Error(fmt::format("{} (at frame {})", error.what(), frame));
  }
}

std::vector<Override> SceneFile::overrides_at(std::int64_t frame) const {
  std::vector<Override> overrides = overrides_;
  overrides.emplace_back("render.frame", std::to_string(frame), fmt::format("frame {}", frame));
  return overrides;
}

Scene load_scene(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  constexpr bool keep = false;
  return SceneFile::Content(path).scene(overrides, keep);
}

Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<Override>& overrides) {
  constexpr bool keep = false;
  return SceneFile::Content(parse_document(text, name), std::filesystem::path(name).parent_path())
      .scene(overrides, keep);
}

}  // namespace airlight
