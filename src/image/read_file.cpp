#include "image/read_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "error.h"

namespace airlight {
namespace {

template <class Bytes>
Bytes read_all(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  int error = file < 0 ? errno : 0;
  Bytes bytes;
  std::size_t size = 0;
  struct stat about {};  // its size is a hint, to grow once: pipes have none
  if (error == 0 && ::fstat(file, &about) == 0) bytes.resize(std::size_t(about.st_size) + 1);
  while (error == 0) {
    if (size == bytes.size()) bytes.resize(size + size / 2 + (std::size_t{1} << 16));
    const ssize_t got = ::read(file, bytes.data() + size, bytes.size() - size);
    if (got == 0) break;
    if (got > 0) size += std::size_t(got);
    if (got < 0 && errno != EINTR) error = errno;
  }
  if (file >= 0) ::close(file);
  if (error != 0)
    throw Error(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(error)));
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path) {
  return read_all<std::vector<std::byte>>(path);
}

std::string read_text(const std::filesystem::path& path) {
  auto text = read_all<std::string>(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  return text;
}

}  // namespace airlight
