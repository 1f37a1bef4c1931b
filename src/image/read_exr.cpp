#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <set>
#include <stdexcept>

#include "error.h"
#include "image/decoders.h"

namespace airlight {
namespace {

class Stream : public Imf::IStream {
 public:
  explicit Stream(const Encoded& encoded)
      : Imf::IStream(encoded.name.c_str()), bytes_(encoded.bytes) {}
  bool read(char out[], int size) override {
    if (size < 0 || position_ > bytes_.size() || std::size_t(size) > bytes_.size() - position_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(out, bytes_.data() + position_, std::size_t(size));
    position_ += std::size_t(size);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t position_ = 0;
};

/// Runs `read(file)`; the library's exceptions become an Error.
template <class Read>
auto with_file(const Encoded& encoded, Read&& read) {
  try {
    Stream stream(encoded);
    Imf::InputFile file(stream, 0);
    return read(file);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    fail_to_decode(encoded, error.what());
  }
}

/// Channels of the file to read as the image's channels; "Y" alone is a grey beauty.
std::vector<std::string> channels_of(const Encoded& encoded, const Imf::ChannelList& channels,
                                     const std::string& layer) {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  std::vector<std::string> rgb;
  for (const char* colour : {"R", "G", "B"})
    if (channels.findChannel(prefix + colour) != nullptr) rgb.push_back(prefix + colour);
  if (rgb.size() == 3) return rgb;
  if (layer.empty() && channels.findChannel("Y") != nullptr &&
      channels.findChannel("RY") == nullptr)
    return {"Y"};

  std::vector<std::string> all;
  std::vector<std::string> in_layer;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    all.emplace_back(channel.name());
    const bool inside =
        all.back().starts_with(prefix) && all.back().find('.', prefix.size()) == std::string::npos;
    if (inside) in_layer.push_back(all.back());
  }
  if (layer.empty() || in_layer.empty())
    fail_to_decode(encoded, fmt::format("it has no channels {0}R, {0}G, {0}B; it has: {1}", prefix,
                                        fmt::join(all, ", ")));
  return in_layer;
}

/// The channel that holds a file's numbers.
std::string channel_of(const Encoded& encoded, const Imf::ChannelList& channels,
                       const std::string& wanted) {
  std::vector<std::string> all;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    all.emplace_back(channel.name());
  if (wanted.empty() && all.size() == 1) return all.front();
  const std::vector<std::string> candidates =
      wanted.empty() ? std::vector<std::string>{"Z", "depth.Z"} : std::vector{wanted};
  for (const std::string& candidate : candidates)
    if (std::ranges::find(all, candidate) != all.end()) return candidate;
  fail_to_decode(encoded, fmt::format("it has no channel {}; it has: {}",
                                      fmt::join(candidates, " or "), fmt::join(all, ", ")));
}

/// An image of these channels, which `frame` will fill.
Image image_of(const Encoded& encoded, const Imf::Header& header,
               const std::vector<std::string>& names, Imf::FrameBuffer& frame) {
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
  const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
  check_size(encoded, width, height);

  const Imf::ChannelList& channels = header.channels();
  Image image(int(width), int(height), int(names.size()));
  const std::size_t pixel_bytes = names.size() * sizeof(float);
  const std::size_t row_bytes = std::size_t(width) * pixel_bytes;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const Imf::Channel& channel = *channels.findChannel(names[c]);
    if (channel.xSampling != 1 || channel.ySampling != 1)
      fail_to_decode(encoded, fmt::format("channel {} has fewer samples than pixels", names[c]));
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window,
                                            pixel_bytes, row_bytes));
  }
  return image;
}

/// Fills all images of `frame` at once: every block of a file holds a part of all channels.
void read_pixels(Imf::InputFile& file, const Imf::FrameBuffer& frame) {
  const Imath::Box2i window = file.header().dataWindow();
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
}

/// What the whole picture shows of an image that fills this window of it: zeros where there is none
/// (a crop), and nothing of what lies beyond (overscan).
Image whole_of(const Encoded& encoded, Image image, const Imath::Box2i& window,
               const Imath::Box2i& full) {
  if (window == full) return image;
  const std::int64_t width = std::int64_t(full.max.x) - full.min.x + 1;
  const std::int64_t height = std::int64_t(full.max.y) - full.min.y + 1;
  check_size(encoded, width, height);
  Image whole(int(width), int(height), image.channels);
  const int x0 = std::max(window.min.x, full.min.x), x1 = std::min(window.max.x, full.max.x);
  const int y0 = std::max(window.min.y, full.min.y), y1 = std::min(window.max.y, full.max.y);
  const auto channels = std::size_t(image.channels);
  for (int y = y0; y <= y1 && x0 <= x1; ++y)
    std::ranges::copy(
        image.row(y - window.min.y)
            .subspan(std::size_t(x0 - window.min.x) * channels,
                     std::size_t(x1 - x0 + 1) * channels),
        whole.row(y - full.min.y).subspan(std::size_t(x0 - full.min.x) * channels).begin());
  return whole;
}

Image read_channels(const Encoded& encoded, Imf::InputFile& file,
                    const std::vector<std::string>& names) {
  Imf::FrameBuffer frame;
  const Imf::Header& header = file.header();
  Image image = image_of(encoded, header, names, frame);
  read_pixels(file, frame);
  return whole_of(encoded, std::move(image), header.dataWindow(), header.displayWindow());
}

Storage storage_of(Imf::PixelType type) {
  return type == Imf::HALF ? Storage::colour : type == Imf::UINT ? Storage::id : Storage::single;
}

/// Puts "sun.surface.R" into the layer "sun.surface"; channels that make a colour in their order.
void add_channel(std::vector<Layer>& layers, const std::string& name, Storage storage) {
  const std::size_t dot = name.rfind('.');
  const std::string prefix = dot == std::string::npos ? "" : name.substr(0, dot);
  auto layer = std::ranges::find(layers, prefix, &Layer::name);
  if (layer == layers.end()) layer = layers.insert(layer, Layer{prefix, {}, {}, storage});
  layer->channels.push_back(dot == std::string::npos ? name : name.substr(dot + 1));
  std::ranges::sort(layer->channels, {}, [](const std::string& channel) {
    return std::pair(std::string_view("RGBA").find(channel), channel);
  });
}

/// Gives a layer pixels to keep, which `frame` will fill.
void add_pixels(const Encoded& encoded, const Imf::Header& header, Layer& layer,
                Imf::FrameBuffer& frame) {
  std::vector<std::string> names;
  for (const std::string& channel : layer.channels)
    names.push_back(layer.name.empty() ? channel : layer.name + "." + channel);
  const auto image = std::make_shared<const Image>(image_of(encoded, header, names, frame));
  layer.fill = [image](int y, std::span<float> row) {
    std::ranges::copy(image->row(y), row.begin());
  };
}

/// visit(key, value) for everything that a file says beyond what every file does.
template <class Visit>
void for_each_attribute(const Imf::InputFile& file, Visit&& visit) {
  const Imf::Header standard;
  for (auto i = file.header().begin(); i != file.header().end(); ++i) {
    const std::string key = i.name();
    if (standard.find(key) != standard.end()) continue;
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
      visit(key, text->value());
    else if (const auto* real = dynamic_cast<const Imf::DoubleAttribute*>(&i.attribute()))
      visit(key, real->value());
    else if (const auto* real = dynamic_cast<const Imf::FloatAttribute*>(&i.attribute()))
      visit(key, real->value());
    else if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&i.attribute()))
      visit(key, whole->value());
  }
}

}  // namespace

Image decode_exr(const Encoded& encoded, const std::string& layer) {
  return with_file(encoded, [&](Imf::InputFile& file) {
    Image image =
        read_channels(encoded, file, channels_of(encoded, file.header().channels(), layer));
    if (!layer.empty() || image.channels != 1) return image;
    Image colour(image.width, image.height);
    for (std::size_t i = 0; i < colour.pixels.size(); ++i) colour.pixels[i] = image.pixels[i / 3];
    return colour;
  });
}

bool exr_is_whole(const Encoded& encoded) {
  return with_file(encoded, [](Imf::InputFile& file) {
    const Imath::Box2i window = file.header().dataWindow(), full = file.header().displayWindow();
    return window.intersects(full.min) && window.intersects(full.max);
  });
}

Image decode_exr_channel(const Encoded& encoded, const std::string& channel) {
  return with_file(encoded, [&](Imf::InputFile& file) {
    return read_channels(encoded, file, {channel_of(encoded, file.header().channels(), channel)});
  });
}

Picture exr_picture(const Encoded& encoded) {
  return with_file(encoded, [&](Imf::InputFile& file) {
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow(), full = header.displayWindow();
    Picture picture;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
      add_channel(picture.layers, i.name(), storage_of(i.channel().type));
    // The beauty has no prefix, and comes first.
    std::ranges::stable_partition(picture.layers, &std::string::empty, &Layer::name);
    if (picture.layers.empty()) fail_to_decode(encoded, "it has no channels");
    Layer& beauty = picture.layers[0];
    if (std::erase(beauty.channels, "A") > 0) picture.alpha = Layer{"", {"A"}, {}, beauty.storage};
    if (!beauty.name.empty() || beauty.channels != std::vector<std::string>{"R", "G", "B"})
      fail_to_decode(encoded, "it has no channels R, G, B");
    Imf::FrameBuffer frame;
    for (Layer& layer : picture.layers) add_pixels(encoded, header, layer, frame);
    if (picture.alpha) add_pixels(encoded, header, *picture.alpha, frame);
    read_pixels(file, frame);
    if (picture.alpha) picture.alpha->name = "alpha";
    beauty.name = "beauty";
    picture.width = window.max.x - window.min.x + 1;
    picture.height = window.max.y - window.min.y + 1;
    if (window != full)
      picture.crop = Crop{window.min.x - full.min.x, window.min.y - full.min.y,
                          full.max.x - full.min.x + 1, full.max.y - full.min.y + 1};
    for_each_attribute(file, [&](const std::string& key, const auto& value) {
      if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(value)>>)
        picture.metadata.emplace_back(key, std::int64_t(value));
      else if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(value)>>)
        picture.metadata.emplace_back(key, double(value));
      else
        picture.metadata.emplace_back(key, value);
    });
    return picture;
  });
}

std::map<std::string, std::string> exr_metadata(const Encoded& encoded) {
  return with_file(encoded, [](Imf::InputFile& file) {
    std::map<std::string, std::string> metadata;
    for_each_attribute(file, [&](const std::string& key, const auto& value) {
      metadata[key] = fmt::format("{}", value);
    });
    return metadata;
  });
}

}  // namespace airlight
