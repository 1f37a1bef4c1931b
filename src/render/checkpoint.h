#pragma once
#include <filesystem>
#include <span>

#include "render/fair_mutex.h"
#include "render/film.h"
#include "render/traits.h"

namespace airlight {

/// Where the sums of a film come from.
struct Origin {
  Traits traits;                ///< what they are sums of
  double seconds = 0;           ///< spent on them, over all runs of the program
  std::string instruction_set;  ///< of the last one
  std::string version;          ///< of Airlight, of the last one
};

/// A film in a file: all that is needed to go on with a render, or to add it to others.
struct Checkpoint {
  Film film;
  Origin origin;
};

/// Writes a film, a tile at a time: it needs no copy of the film, and a tile may be rendered before
/// it is written or after, not meanwhile. `locks`, one a tile or none at all, are held while a tile
/// is read. The file appears whole or not at all. Throws Error if it cannot be written.
///
/// The file: "airlight checkpoint\n", format, size and hash of the header, the header; for each
/// tile the samples that it has of every run, then its numbers as the film keeps them; a hash of
/// all. Numbers are those of x86-64.
void write_checkpoint(const std::filesystem::path& path, const Film& film, const Origin& origin,
                      std::span<FairMutex> locks = {});

/// Throws Error for a file that cannot be read, is no checkpoint, is cut short or damaged.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Adds the samples of another checkpoint. Throws Error if it is of another render or shares
/// samples.
void merge(Checkpoint& sum, Checkpoint other);

}  // namespace airlight
