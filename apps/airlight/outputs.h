#pragma once
#include <filesystem>
#include <vector>

#include "image/output.h"
#include "render/film.h"
#include "scene/document.h"
#include "verb.h"

/// The files a picture goes to and how it is brought there.
class Outputs {
 public:
  /// `kinds` is what -o takes, in words.
  void declare(CLI::App& verb, const std::string& kinds = "the picture: .png, .exr or .pfm");

  /// Takes the files with an extension such as ".ckpt" out of those that pictures go to.
  std::vector<std::filesystem::path> take(const std::string& extension);

  /// Throws airlight::Error if a file could not be written, a flag has a wrong value, a name has a
  /// place for the number of a frame, or a file would be written twice: as two of these, or as one
  /// of those that a verb writes beside them.
  void check(const std::vector<std::filesystem::path>& beside = {});

  /// The files of one frame, whose number goes where the names have ####. Throws airlight::Error
  /// for a name without.
  Outputs of_frame(std::int64_t frame) const;

  /// Whether every file is there. Being written whole or not at all, they are whole, too.
  bool exist() const;

  /// Writes every file that can be written; then throws the first airlight::Error there was.
  void write(const airlight::Picture& picture) const;

  /// "sunroom.png, sunroom.exr".
  std::string names() const;

 private:
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> others_;  ///< extensions that were taken out
  std::vector<airlight::Override> changes_;
  airlight::OutputOptions options_;
};

/// "64", or "0 to 64" where some pixels have more samples than others.
std::string samples_of(const airlight::Film& film);

/// Adds to a film's picture how its samples came about.
void tell_origin(airlight::Picture& picture, const std::string& estimator,
                 const std::string& samples_per_ray, double seconds,
                 const std::string& instruction_set, const std::string& version);
