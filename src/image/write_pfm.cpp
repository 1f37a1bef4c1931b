#include <fmt/format.h>

#include <bit>
#include <vector>

#include "image/atomic_file.h"
#include "image/output.h"

namespace airlight {

void write_pfm(const std::filesystem::path& path, const Picture& picture) {
  AtomicFile file(path);
  const char* byte_order = std::endian::native == std::endian::little ? "-1.0" : "1.0";
  file.write(fmt::format("PF\n{} {}\n{}\n", picture.width, picture.height, byte_order));
  std::vector<float> row(std::size_t(picture.width) * 3);
  for (int y = picture.height - 1; y >= 0; --y) {  // the format starts at the bottom
    fill_row(picture.layers.front(), y, row, path);
    file.write(std::as_bytes(std::span(row)));
  }
  file.commit();
}

}  // namespace airlight
