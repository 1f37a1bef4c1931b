#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image/picture.h"
#include "image/tone_map.h"

namespace airlight {

/// Precision of the colour layers of an EXR file.
enum class ExrType {
  half,    ///< 16 bit floats; finite values beyond 65504 are written as 65504
  single,  ///< 32 bit floats
};

struct OutputOptions {
  ExrType exr = ExrType::half;
  Display display;  ///< how PNG shows linear light
};

/// Writes the picture in the format that the extension names: .exr, .pfm or .png. The file appears
/// whole or not at all. Throws Error for an unknown extension, a value that is not finite, or a
/// file that cannot be written.
void write_picture(const std::filesystem::path& path, const Picture& picture,
                   const OutputOptions& options = {});

/// Throws what `write_picture` would throw for this path before its first pixel, so that a long
/// render fails early: an unknown extension, a missing directory, a target that is a directory or
/// may not be written. `others` are extensions that the caller takes beside those of pictures.
void check_picture_path(const std::filesystem::path& path,
                        const std::vector<std::string>& others = {});

/// OpenEXR: scan lines, ZIP, all layers, metadata as header attributes.
void write_exr(const std::filesystem::path& path, const Picture& picture, ExrType type);

/// Portable float map: the beauty in 32 bit, nothing else.
void write_pfm(const std::filesystem::path& path, const Picture& picture);

/// PNG: the beauty in 8 bit sRGB, metadata as text chunks. With alpha, colours are divided by it,
/// as the format wants; where the beauty is brighter than alpha (light that a medium adds), alpha
/// is raised to it, or the colour would not fit below 1. Over black, one sees the beauty either
/// way.
void write_png(const std::filesystem::path& path, const Picture& picture,
               const Display& display = {});

}  // namespace airlight
