#include "outputs.h"

#include <optional>
#include <set>
#include <string>

#include "error.h"
#include "extension.h"
#include "flags.h"
#include "image/numbered.h"

namespace airlight {

template <>
inline constexpr Word<ToneMap> words<ToneMap>[] = {
    {"none", ToneMap::none, "clipped at 1"},
    {"filmic", ToneMap::filmic, "bright tones roll off"},
};
template <>
inline constexpr Word<ExrType> words<ExrType>[] = {
    {"half", ExrType::half, "16 bits a value"},
    {"float", ExrType::single, "32 bits a value"},
};

}  // namespace airlight

namespace {

using airlight::ExrType, airlight::ToneMap;

/// How a picture is stored and shown.
struct Development {
  double exposure = 0;
  ToneMap tonemap = ToneMap::none;
  ExrType exr = ExrType::half;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = Development;
    field("exposure", &D::exposure, airlight::unit::stop, airlight::closed(-60, 60),
          "brightens a PNG");
    field("tonemap", &D::tonemap, airlight::unit::none, airlight::any_number(),
          "how a PNG shows bright tones");
    field("exr", &D::exr, airlight::unit::none, airlight::any_number(),
          "precision of an EXR's colours");
  }
};

/// Throws Error if two of the paths, however they are written, lead to one file.
void check_distinct(const std::vector<std::filesystem::path>& files) {
  std::set<std::filesystem::path> places;
  for (const std::filesystem::path& file : files) {
    std::error_code ignored;
    const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(file), ignored);
    if (!places.insert(place).second)
      throw airlight::Error(file.string() +
                            ": would be written twice; accepted: another file for each output");
  }
}

}  // namespace

void Outputs::declare(CLI::App& verb, const std::string& kinds) {
  verb.add_option("-o,--output", files_, kinds + "; may be repeated")
      ->required()
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->group("Output");
  add_flags<Development>(verb, "", "Output", changes_);
}

std::vector<std::filesystem::path> Outputs::take(const std::string& extension) {
  std::vector<std::filesystem::path> taken;
  others_.push_back(extension);
  std::erase_if(files_, [&](const std::filesystem::path& file) {
    if (airlight::extension_of(file) != extension) return false;
    taken.push_back(file);
    return true;
  });
  return taken;
}

void Outputs::check(const std::vector<std::filesystem::path>& beside) {
  const auto wanted = read_flags<Development>(changes_);
  options_ = {.exr = wanted.exr,
              .display = {.exposure = float(wanted.exposure), .tone_map = wanted.tonemap}};
  for (const auto& file : files_) {
    if (airlight::is_pattern(file))
      throw airlight::Error(file.string() +
                            ": # stands for the number of a frame, which --frames gives");
    airlight::check_picture_path(file, others_);
  }
  std::vector<std::filesystem::path> all = files_;
  all.insert(all.end(), beside.begin(), beside.end());
  check_distinct(all);
}

Outputs Outputs::of_frame(std::int64_t frame) const {
  Outputs result = *this;
  for (auto& file : result.files_) {
    if (!airlight::is_pattern(file))
      throw airlight::Error(file.string() +
                            ": has no place for the number of a frame, which --frames wants; "
                            "accepted is a name such as out.####.png");
    file = airlight::numbered(file, frame);
  }
  return result;
}

bool Outputs::exist() const {
  return std::ranges::all_of(files_, [](const auto& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error);
  });
}

void Outputs::write(const airlight::Picture& picture) const {
  std::optional<airlight::Error> first;
  for (const auto& file : files_) try {
      airlight::write_picture(file, picture, options_);
    } catch (const airlight::Error& error) {
      if (!first) first = error;
    }
  if (first) throw *first;
}

std::string Outputs::names() const {
  std::string names;
  for (const auto& file : files_) names += (names.empty() ? "" : ", ") + file.string();
  return names;
}

std::string samples_of(const airlight::Film& film) {
  const std::string least = std::to_string(film.samples()),
                    most = std::to_string(film.most_samples());
  return least == most ? least : least + " to " + most;
}

void tell_origin(airlight::Picture& picture, const std::string& estimator,
                 const std::string& samples_per_ray, double seconds,
                 const std::string& instruction_set, const std::string& version) {
  const std::pair<std::string, airlight::MetadataValue> told[] = {
      {"estimator", estimator},
      {"samples_per_ray", samples_per_ray},
      {"seconds", seconds},
      {"isa", instruction_set},
      {"version", version}};
  picture.metadata.insert(picture.metadata.end(), std::begin(told), std::end(told));
}
