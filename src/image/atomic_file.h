#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airlight {

/// A file that appears whole or not at all. Bytes go to a temporary file beside the target, which
/// `commit` renames over it; without a commit the temporary file is removed and an old target stays
/// as it was. Where the file system can, the temporary file has no name: a program that is killed
/// leaves nothing behind, or at worst a whole file that the next one for this target replaces.
/// Symbolic links are followed. A target that is no regular file
/// (/dev/stdout, a pipe) is written directly. Every failure is an Error that names the target:
/// "out.png: cannot be written: No space left on device".
class AtomicFile {
 public:
  /// Throws if the directory is missing or closed to us, or the target is a directory or read-only.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  /// Bytes from the start of the file to where the next write goes.
  std::uint64_t position() const;
  void seek(std::uint64_t position);

  /// Makes the file durable and gives it its name, which is made durable too where the file system
  /// can. Throws if this or any earlier write failed, also when the writer in between (a library's
  /// destructor) swallowed that Error.
  void commit();

 private:
  void flush();
  void write_out(const std::byte* data, std::size_t size);
  [[noreturn]] void fail(int error);

  std::filesystem::path target_;     // as the user wrote it, for errors
  std::filesystem::path final_;      // links followed
  std::filesystem::path temporary_;  // empty: there is no such name
  bool unnamed_ = false;             // the file has no name yet
  int file_ = -1;
  int error_ = 0;              // errno of the first failure
  std::uint64_t flushed_ = 0;  // where in the file the buffer starts
  std::vector<std::byte> buffer_;
};

/// Throws what AtomicFile would throw for this target, and leaves nothing behind.
void check_writable(const std::filesystem::path& path);

/// Makes a folder and those above it, if it is not there yet. Throws Error if it cannot be made or
/// written to.
void make_folder(const std::filesystem::path& folder);

/// Writes a text file whole or not at all.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace airlight
