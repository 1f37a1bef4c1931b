#include "image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <functional>
#include <utility>

#include "error.h"

namespace airlight {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 18;

Error unwritable(const std::filesystem::path& path, int error) {
  const std::filesystem::path folder = path.parent_path();
  std::error_code ignored;
  if (error == ENOENT && !folder.empty() && !std::filesystem::exists(folder, ignored))
    return Error(fmt::format("{}: cannot be written: there is no folder {}", path.string(),
                             folder.string()));
  if (error == EISDIR)
    return Error(fmt::format("{}: cannot be written: it is a folder", path.string()));
  return Error(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(error)));
}

/// The file that a chain of symbolic links ends at, whether it exists or not.
std::filesystem::path follow_links(std::filesystem::path path) {
  std::error_code error;
  for (int links = 0; links < 40; ++links) {  // as many as Linux follows
    const std::filesystem::path next = std::filesystem::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;
  }
  return path;
}

std::filesystem::path folder_of(const std::filesystem::path& target) {
  return target.has_parent_path() ? target.parent_path() : ".";
}

/// A file with a new name beside the target; `path` becomes that name, empty if there can be none.
int create_beside(const std::filesystem::path& target, std::filesystem::path& path) {
  static std::atomic<unsigned> counter = 0;
  while (true) {
    path = target.parent_path() / fmt::format(".airlight-{}-{}.tmp", ::getpid(), counter++);
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) path.clear();
    if (file >= 0 || errno != EEXIST) return file;
  }
}

/// A file that has no name yet and goes away by itself if the program is killed; −1 where the file
/// system has no such thing.
int create_unnamed(const std::filesystem::path& target) {
  if (::access("/proc/self/fd", X_OK) != 0) return -1;  // it would get no name later
  return ::open(folder_of(target).c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
}

/// Makes the name of a file last through a loss of power. A folder that may not be read, or a file
/// system that knows no such thing, is no failure: the file is there.
void keep_name(const std::filesystem::path& target) {
  const int folder = ::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

/// Gives an unnamed file its name, in place of an older file of that name. No call of the system
/// does both at once: between the two the file stands under a name that belongs to the target, so
/// that what a program killed just there leaves behind is gone with the next file of that name.
/// Returns 0, or −1 with errno.
int name_unnamed(int file, const std::filesystem::path& target) {
  const std::string source = fmt::format("/proc/self/fd/{}", file);
  const auto link = [&](const std::filesystem::path& path) {
    return ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW);
  };
  if (link(target) == 0) return 0;
  if (errno != EEXIST) return -1;
  const std::filesystem::path between =
      target.parent_path() /
      fmt::format(".airlight-{:016x}.tmp", std::hash<std::string>()(target.filename()));
  while (link(between) != 0)
    if (errno != EEXIST || (::unlink(between.c_str()) != 0 && errno != ENOENT)) return -1;
  // Where it is gone, another program has replaced it by its own, as if that had come after it.
  return ::rename(between.c_str(), target.c_str()) == 0 || errno == ENOENT ? 0 : -1;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target)
    : target_(std::move(target)), final_(follow_links(target_)) {
  struct stat status;
  // A link to a pipe, as of /dev/stdout, leads to no path: the system follows it.
  if (::stat(target_.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) final_ = target_;
  const bool exists = ::stat(final_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) throw unwritable(target_, errno);
  if (exists && S_ISDIR(status.st_mode)) throw unwritable(target_, EISDIR);
  if (final_.filename().empty()) throw unwritable(target_, final_.empty() ? ENOENT : EISDIR);

  if (exists && !S_ISREG(status.st_mode)) {
    file_ = ::open(final_.c_str(), O_WRONLY | O_CLOEXEC);
  } else if (exists && ::access(final_.c_str(), W_OK) != 0) {
    throw unwritable(target_, errno);  // a rename could replace it, but its owner closed it
  } else {
    file_ = create_unnamed(final_);
    unnamed_ = file_ >= 0;
    if (!unnamed_) file_ = create_beside(final_, temporary_);
    if (file_ >= 0 && exists) ::fchmod(file_, status.st_mode & 07777);
  }
  if (file_ < 0) throw unwritable(target_, errno);
  buffer_.reserve(buffer_size);
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (error_ != 0) fail(error_);
  if (buffer_.size() + bytes.size() > buffer_size) flush();
  if (bytes.size() > buffer_size)
    write_out(bytes.data(), bytes.size());
  else
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

std::uint64_t AtomicFile::position() const { return flushed_ + buffer_.size(); }

void AtomicFile::seek(std::uint64_t position) {
  if (position == this->position()) return;
  flush();
  if (::lseek(file_, off_t(position), SEEK_SET) < 0) fail(errno);
  flushed_ = position;
}

void AtomicFile::commit() {
  flush();
  if ((unnamed_ || !temporary_.empty()) && ::fsync(file_) != 0) fail(errno);
  if (unnamed_ && name_unnamed(file_, final_) != 0) fail(errno);
  const int file = std::exchange(file_, -1);
  if (::close(file) != 0) fail(errno);
  if (!temporary_.empty() && ::rename(temporary_.c_str(), final_.c_str()) != 0) fail(errno);
  if (unnamed_ || !temporary_.empty()) keep_name(final_);
  temporary_.clear();
}

void AtomicFile::flush() {
  if (error_ != 0) fail(error_);
  write_out(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void AtomicFile::write_out(const std::byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(file_, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    data += written;
    size -= std::size_t(written);
    flushed_ += std::uint64_t(written);
  }
}

void AtomicFile::fail(int error) {
  error_ = error;
  throw unwritable(target_, error);
}

void check_writable(const std::filesystem::path& path) {
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  // Opening a pipe would wait for its reader, or end what he reads.
  if (type == std::filesystem::file_type::fifo) return;
  AtomicFile{path};
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw Error(folder.string() + ": no folder can be made here: " + failed.message());
  check_writable(folder / "index.html");
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace airlight
