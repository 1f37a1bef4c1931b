#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "error.h"
#include "image/atomic_file.h"
#include "image/output.h"

namespace airlight {
namespace {

constexpr int zip_rows = 16;  // ZIP compresses so many scan lines together

class Stream : public Imf::OStream {
 public:
  Stream(AtomicFile& file, const std::string& name) : Imf::OStream(name.c_str()), file_(file) {}
  void write(const char bytes[], int size) override {
    file_.write(std::string_view(bytes, std::size_t(size)));
  }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  AtomicFile& file_;
};

Imf::PixelType pixel_type(const Layer& layer, ExrType type) {
  if (layer.storage == Storage::id) return Imf::UINT;
  return layer.storage == Storage::colour && type == ExrType::half ? Imf::HALF : Imf::FLOAT;
}

std::size_t size_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

/// Writes the row as the file keeps it.
void store(std::span<const float> row, Imf::PixelType type, char* out) {
  const auto put = [&out](auto value) {
    std::memcpy(out, &value, sizeof value);
    out += sizeof value;
  };
  for (const float value : row) {
    if (type == Imf::UINT)
      put(std::uint32_t(value));
    else if (type == Imf::HALF)
      put(half(std::clamp(value, -65504.0F, 65504.0F)).bits());
    else
      put(value);
  }
}

/// The rows of one layer that are written together.
struct Block {
  const Layer& layer;
  Imf::PixelType type;
  std::vector<std::string> names;  // of the channels, as in the file
  std::size_t row_bytes;
  std::vector<char> rows;  // empty until their number is known
};

std::vector<Block> blocks_of(const Picture& picture, ExrType exr_type) {
  std::vector<Block> blocks;
  const auto add = [&](const Layer& layer, const std::string& prefix) {
    const Imf::PixelType type = pixel_type(layer, exr_type);
    std::vector<std::string> names;
    for (const std::string& channel : layer.channels) names.push_back(prefix + channel);
    const std::size_t row_bytes = std::size_t(picture.width) * names.size() * size_of(type);
    blocks.push_back({layer, type, names, row_bytes, {}});
  };
  for (const Layer& layer : picture.layers) add(layer, blocks.empty() ? "" : layer.name + ".");
  if (picture.alpha) add(*picture.alpha, "");
  return blocks;
}

/// Threads to compress with: as many as the machine has, but at most 32 MB of buffers. A thread
/// takes 16 rows here and, inside the library, two line buffers of 16 rows with two copies of each
/// for the compression.
int compression_threads(const std::vector<Block>& blocks) {
  std::size_t row_bytes = 0;
  for (const Block& block : blocks) row_bytes += block.row_bytes;
  const std::size_t affordable = (std::size_t{32} << 20) / (row_bytes * zip_rows * 7);
  const int threads = int(
      std::clamp<std::size_t>(affordable, 1, std::max(1U, std::thread::hardware_concurrency())));
  if (Imf::globalThreadCount() < threads) Imf::setGlobalThreadCount(threads);
  return threads;
}

void add_metadata(Imf::Header& header, const std::string& key, const MetadataValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    header.insert(key, Imf::DoubleAttribute(*number));
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    header.insert(key, Imf::StringAttribute(*text));
  } else {
    const std::int64_t whole = std::get<std::int64_t>(value);
    if (whole == std::int32_t(whole))
      header.insert(key, Imf::IntAttribute(std::int32_t(whole)));
    else  // the format has no wider whole numbers
      header.insert(key, Imf::StringAttribute(std::to_string(whole)));
  }
}

Imf::Header header_of(const Picture& picture, const std::vector<Block>& blocks) {
  const Crop crop = picture.crop.value_or(Crop{0, 0, picture.width, picture.height});
  const Imath::Box2i display({0, 0}, {crop.full_width - 1, crop.full_height - 1});
  const Imath::Box2i data({crop.x0, crop.y0},
                          {crop.x0 + picture.width - 1, crop.y0 + picture.height - 1});
  Imf::Header header(display, data, 1, {0, 0}, 1, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  for (const Block& block : blocks)
    for (const std::string& name : block.names)
      header.channels().insert(name, Imf::Channel(block.type));
  for (const auto& [key, value] : picture.metadata) add_metadata(header, key, value);
  return header;
}

void write_rows(Imf::OutputFile& out, std::vector<Block>& blocks, int rows_at_once,
                const Picture& picture, const std::filesystem::path& path) {
  const Imath::V2i corner = out.header().dataWindow().min;
  for (Block& block : blocks) block.rows.resize(block.row_bytes * std::size_t(rows_at_once));
  std::vector<float> row;
  for (int first = 0; first < picture.height; first += rows_at_once) {
    const int count = std::min(rows_at_once, picture.height - first);
    for (int y = 0; y < count; ++y)
      for (Block& block : blocks) {
        row.resize(std::size_t(picture.width) * block.names.size());
        fill_row(block.layer, first + y, row, path);
        store(row, block.type, block.rows.data() + std::size_t(y) * block.row_bytes);
      }
    Imf::FrameBuffer frame;
    for (Block& block : blocks) {
      const std::size_t pixel_bytes = block.names.size() * size_of(block.type);
      for (std::size_t c = 0; c < block.names.size(); ++c)
        frame.insert(block.names[c],
                     Imf::Slice::Make(block.type, block.rows.data() + c * size_of(block.type),
                                      {corner.x, corner.y + first}, picture.width, count,
                                      pixel_bytes, block.row_bytes));
    }
    out.setFrameBuffer(frame);
    out.writePixels(count);
  }
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Picture& picture, ExrType type) {
  AtomicFile file(path);
  try {
    std::vector<Block> blocks = blocks_of(picture, type);
    Stream stream(file, path.string());
    const int threads = compression_threads(blocks);
    Imf::OutputFile out(stream, header_of(picture, blocks), threads);
    write_rows(out, blocks, threads * zip_rows, picture, path);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {  // the library's own
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  }
  file.commit();
}

}  // namespace airlight
