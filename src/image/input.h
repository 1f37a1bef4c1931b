#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "image/image.h"

namespace airlight {

/// Reads a picture as linear light. The format is told by the file's content: EXR, PFM, PNG, HDR
/// (Radiance), JPG, BMP or TGA. sRGB codes are decoded; grey becomes RGB; what is transparent in a
/// PNG lies over black.
///
/// `layer` names a layer of an EXR file, "" its beauty; other formats have the beauty alone. A
/// layer with R, G and B gives these, any other all its channels in alphabetical order (X, Y, Z).
/// Of a cropped EXR file only the crop is read. Throws Error if the file cannot be read or is not
/// such a picture.
Image read_image(const std::filesystem::path& path, const std::string& layer = "");

/// Whether a file's content holds linear light without an end (EXR, PFM, HDR) rather than codes for
/// a screen, which end at white.
bool holds_radiance(const std::filesystem::path& path);

/// The metadata of an EXR or PNG file as text, numbers in their shortest exact form; empty for
/// other formats.
std::map<std::string, std::string> read_metadata(const std::filesystem::path& path);

}  // namespace airlight
