#include "image/output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "error.h"
#include "extension.h"
#include "image/atomic_file.h"

namespace airlight {
namespace {

struct Format {
  const char* extension;
  void (*write)(const std::filesystem::path&, const Picture&, const OutputOptions&);
};

constexpr std::array formats{
    Format{".exr",
           [](auto& path, auto& picture, auto& options) { write_exr(path, picture, options.exr); }},
    Format{".pfm", [](auto& path, auto& picture, auto&) { write_pfm(path, picture); }},
    Format{".png", [](auto& path, auto& picture,
                      auto& options) { write_png(path, picture, options.display); }},
};

const Format& format_of(const std::filesystem::path& path,
                        const std::vector<std::string>& others = {}) {
  const auto found = std::ranges::find(formats, extension_of(path), &Format::extension);
  if (found != formats.end()) return *found;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(fmt::format("{}: is a folder; accepted: a file in it, such as {}", path.string(),
                            (path / "picture.png").string()));
  std::vector<std::string> accepted;
  for (const Format& format : formats) accepted.push_back(format.extension);
  accepted.insert(accepted.end(), others.begin(), others.end());
  throw Error(fmt::format("{}: unknown picture format \"{}\"; accepted: {}", path.string(),
                          path.extension().string(), fmt::join(accepted, ", ")));
}

}  // namespace

void write_picture(const std::filesystem::path& path, const Picture& picture,
                   const OutputOptions& options) {
  format_of(path).write(path, picture, options);
}

void check_picture_path(const std::filesystem::path& path, const std::vector<std::string>& others) {
  format_of(path, others);
  check_writable(path);
}

}  // namespace airlight
