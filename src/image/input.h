#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "image/picture.h"

namespace airlight {

/// Reads a picture as linear light. The format is told by the file's content: EXR, PFM, PNG, HDR
/// (Radiance), JPG, BMP or TGA. sRGB codes are decoded; grey becomes RGB; what is transparent in a
/// PNG lies over black; a JPG is turned as its EXIF data say; the exposure that an HDR file tells
/// is taken back.
///
/// `layer` names a layer of an EXR file, "" its beauty; other formats have the beauty alone. A
/// layer with R, G and B gives these, any other all its channels in alphabetical order (X, Y, Z).
/// Of an EXR file the picture is read that it is a crop of, zero beside the crop, and without what
/// lies beyond the picture's edges. Throws Error if the file cannot be read or is not such a
/// picture.
Image read_image(const std::filesystem::path& path, const std::string& layer = "");

/// The same of a file whose content is linear light without an end (EXR, PFM, HDR); none where it
/// is codes for a screen, which end at white. Throws Error for a crop, too.
std::optional<Image> read_radiance(const std::filesystem::path& path);

/// Numbers that are no colours, one a pixel.
struct Numbers {
  Image image;             ///< of one channel
  bool are_codes = false;  ///< whole numbers from 0 to 255 or 65535, in a unit that nobody told
};

/// Reads numbers that are no colours, such as depths, one a pixel and as they stand in the file:
/// floats of EXR and PFM, codes from 0 to 255 or 65535 of a grey PNG. `channel` names a channel of
/// an EXR file by its whole name ("depth.Z"); "" stands for its only one, or Z, or depth.Z. Beside
/// a crop numbers are zero. Throws Error if the file cannot be read or has more than one number a
/// pixel.
Numbers read_numbers(const std::filesystem::path& path, const std::string& channel = "");

/// An EXR file with all its layers, which keep their pixels, as something to write again. Throws
/// Error if it cannot be read or is no EXR file.
Picture read_picture(const std::filesystem::path& path);

/// The metadata of an EXR or PNG file as text, numbers in their shortest exact form; empty for
/// other formats.
std::map<std::string, std::string> read_metadata(const std::filesystem::path& path);

}  // namespace airlight
