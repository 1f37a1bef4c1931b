#include "render/checkpoint.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "error.h"
#include "image/atomic_file.h"
#include "render/hash.h"

namespace airlight {
namespace {

constexpr std::string_view magic = "airlight checkpoint\n";
constexpr std::uint32_t format = 3;

/// What stands before the header.
struct Prelude {
  char magic[20];
  std::uint32_t format;
  std::uint64_t header_size, header_hash;  ///< [bytes], of the header alone
};
static_assert(sizeof(Prelude) == 40 && magic.size() == sizeof Prelude::magic);

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

/// Appends numbers and texts.
class Packer {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& number) {
    const auto bytes = std::as_bytes(std::span(&number, 1));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void operator()(const std::string& text) {
    (*this)(std::uint64_t(text.size()));
    const auto bytes = std::as_bytes(std::span(text));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(std::uint64_t(list.size()));
    for (const T& element : list) pack(*this, element);
  }

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Takes them back. Past the end there are zeros: a header that is no longer as it was written has
/// been refused before.
class Unpacker {
 public:
  explicit Unpacker(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& number) {
    number = {};
    if (bytes_.size() < sizeof number) return;
    std::memcpy(&number, bytes_.data(), sizeof number);
    bytes_ = bytes_.subspan(sizeof number);
  }
  void operator()(std::string& text) {
    text.resize(size());
    std::memcpy(text.data(), bytes_.data(), text.size());
    bytes_ = bytes_.subspan(text.size());
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    list.resize(size());
    for (T& element : list) pack(*this, element);
  }

 private:
  std::size_t size() {
    std::uint64_t size = 0;
    (*this)(size);
    return std::min<std::size_t>(size, bytes_.size());
  }

  std::span<const std::byte> bytes_;
};

template <class Packer, class T>
void pack(Packer& packer, T& value) {
  packer(value);
}
template <class Packer, class T>
requires std::same_as<std::remove_const_t<T>, Traits::value_type>
void pack(Packer& packer, T& trait) { packer(trait.first), packer(trait.second); }

/// A run of samples but for its counts, which stand before each tile.
struct RunStart {
  std::uint32_t seed = 0, first = 0;
};
template <class Packer, class T>
requires std::same_as<std::remove_const_t<T>, RunStart>
void pack(Packer& packer, T& run) { packer(run.seed), packer(run.first); }

/// Everything but the numbers of the tiles.
struct Header {
  Resolution full;
  PixelRect crop;
  FilmLayout layout;
  std::vector<std::string> groups;
  std::vector<RunStart> runs;
  Origin origin;

  template <class Self, class Packer>
  static void pack_all(Self& header, Packer& pack) {
    pack(header.full.width), pack(header.full.height);
    pack(header.crop.x0), pack(header.crop.y0);
    pack(header.crop.width), pack(header.crop.height);
    pack(header.layout.groups), pack(header.layout.plain), pack(header.layout.ratio);
    pack(header.layout.shadow);
    pack(header.groups), pack(header.runs);
    pack(header.origin.traits), pack(header.origin.seconds);
    pack(header.origin.instruction_set), pack(header.origin.version);
  }
};

std::uint64_t body_size(const Film& film) {
  std::uint64_t size = 0;
  for (int tile = 0; tile < film.tile_count(); ++tile)
    size += film.runs.size() * sizeof(std::uint32_t) + film.tile_bytes(tile);
  return size;
}

/// A file that is read once from its start to its end.
class Source {
 public:
  explicit Source(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    size_ = std::filesystem::file_size(path, error);
    if (!error) in_.open(path, std::ios::binary);
    if (error || !in_) fail("cannot be read: " + (error ? error.message() : std::strerror(errno)));
  }

  /// Throws Error if fewer bytes are left.
  void read(std::span<std::byte> bytes) {
    if (!in_.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size())))
      fail(fmt::format("is cut short after {} bytes", size_));
  }

  std::uint64_t size() const { return size_; }

  /// Throws "a.ckpt: <what>".
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}: {}", path_.string(), what));
  }

 private:
  const std::filesystem::path& path_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
};

template <class T>
std::span<std::byte> bytes_of(T& value) {
  return std::as_writable_bytes(std::span(&value, 1));
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Film& film, const Origin& origin,
                      std::span<FairMutex> locks) {
  Packer header;
  Header about{film.full, film.crop, film.layout, film.groups, {}, origin};
  for (const SampleRun& run : film.runs) about.runs.push_back({run.seed, run.first});
  Header::pack_all(about, header);
  Prelude prelude{{}, format, header.bytes().size(), hash_of(header.bytes())};
  std::ranges::copy(magic, prelude.magic);

  AtomicFile file(path);
  file.write(bytes_of(prelude));
  file.write(header.bytes());
  Hash hash;
  hash.add(prelude.header_hash);
  std::vector<std::byte> bytes;
  for (int tile = 0; tile < film.tile_count(); ++tile) {
    const std::size_t counts = film.runs.size() * sizeof(std::uint32_t);
    bytes.resize(counts + film.tile_bytes(tile));
    {
      std::unique_lock<FairMutex> lock;
      if (!locks.empty()) lock = std::unique_lock(locks[std::size_t(tile)]);
      for (std::size_t run = 0; run < film.runs.size(); ++run)
        std::memcpy(bytes.data() + run * sizeof(std::uint32_t),
                    &film.runs[run].counts[std::size_t(tile)], sizeof(std::uint32_t));
      film.save_tile(tile, bytes.data() + counts);
    }
    hash.add(bytes);
    file.write(bytes);
  }
  std::uint64_t sum = hash.value();
  file.write(bytes_of(sum));
  file.commit();
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  Source source(path);
  const auto need = [&](std::uint64_t size) {
    if (source.size() < size)
      source.fail(fmt::format("is cut short: {} of {} bytes", source.size(), size));
  };
  Prelude prelude{};
  if (source.size() >= magic.size()) source.read(std::as_writable_bytes(std::span(prelude.magic)));
  if (!std::ranges::equal(prelude.magic, magic)) source.fail("is no checkpoint of Airlight");
  need(sizeof prelude);
  source.read(bytes_of(prelude).subspan(magic.size()));
  if (prelude.format != format)
    source.fail(fmt::format("is a checkpoint of format {}; accepted: {}", prelude.format, format));
  if (prelude.header_size > source.size()) source.fail("is cut short or damaged in its header");
  std::vector<std::byte> bytes(prelude.header_size);
  source.read(bytes);
  if (hash_of(bytes) != prelude.header_hash) source.fail("is damaged in its header");

  Header about;
  Unpacker unpack(bytes);
  Header::pack_all(about, unpack);
  // Its memory comes when tiles are read, not before: the size of the file is checked first.
  Checkpoint result{Film(about.full, about.crop, about.layout, std::move(about.groups)),
                    std::move(about.origin)};
  Film& film = result.film;
  for (const RunStart& run : about.runs)
    film.runs.push_back(
        {run.seed, run.first, std::vector<std::uint32_t>(std::size_t(film.tile_count()))});
  const std::uint64_t size =
      sizeof prelude + bytes.size() + body_size(film) + sizeof(std::uint64_t);
  need(size);
  if (source.size() > size)
    source.fail(fmt::format("is damaged: {} bytes, not {}", source.size(), size));

  Hash hash;
  hash.add(prelude.header_hash);
  for (int tile = 0; tile < film.tile_count(); ++tile) {
    const std::size_t counts = film.runs.size() * sizeof(std::uint32_t);
    bytes.resize(counts + film.tile_bytes(tile));
    source.read(bytes);
    hash.add(bytes);
    for (std::size_t run = 0; run < film.runs.size(); ++run)
      std::memcpy(&film.runs[run].counts[std::size_t(tile)],
                  bytes.data() + run * sizeof(std::uint32_t), sizeof(std::uint32_t));
    film.load_tile(tile, bytes.data() + counts);
  }
  std::uint64_t sum = 0;
  source.read(bytes_of(sum));
  if (sum != hash.value()) source.fail("is damaged: its checksum does not fit");
  return result;
}

void merge(Checkpoint& sum, Checkpoint other) {
  if (const std::string differs = difference(other.origin.traits, sum.origin.traits);
      !differs.empty())
    throw Error(
        fmt::format("is of another render: {}; accepted: the same scene and settings", differs));
  // What does not add up, such as the depth, is that of the first sample in whatever order they
  // come.
  const auto start = [](const Checkpoint& c) {
    return std::pair(c.film.runs.at(0).seed, c.film.runs.at(0).first);
  };
  if (start(other) < start(sum)) std::swap(sum.film, other.film);
  sum.film.merge(other.film);
  sum.origin.seconds += other.origin.seconds;
  if (sum.origin.instruction_set.find(other.origin.instruction_set) == std::string::npos)
    sum.origin.instruction_set += ", " + other.origin.instruction_set;
}

}  // namespace airlight
