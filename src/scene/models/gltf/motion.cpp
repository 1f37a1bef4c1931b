#include "scene/models/gltf/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "error.h"
#include "scene/models/gltf/accessor.h"

namespace airlight::gltf {
namespace {

using Numbers = std::vector<double>;

/// The finite numbers of an accessor, one element after the other.
Numbers numbers_of(const Document& document, int accessor, int type, std::size_t components,
                   const std::string& where) {
  const Accessor elements(document, accessor, type, where);
  Numbers numbers;
  numbers.reserve(elements.size() * components);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto element = elements.floats(i);
    for (std::size_t c = 0; c < components; ++c) {
      if (!std::isfinite(element[c]))
        throw Error(fmt::format("{}: {}: element {} is not finite; finite numbers", document.file,
                                where, i));
      numbers.push_back(element[c]);
    }
  }
  return numbers;
}

/// Along the shorter great arc from one unit quaternion to another (glTF 2.0 appendix C.4).
Numbers slerp(const Numbers& a, const Numbers& b, double t) {
  double cosine = 0;
  for (std::size_t c = 0; c < 4; ++c) cosine += a[c] * b[c];
  const double sign = cosine < 0 ? -1 : 1;
  const double angle = std::acos(std::min(1., std::abs(cosine)));
  const double sine = std::sin(angle);
  // Nearly the same: the straight way is as good, and sin(angle) no divisor.
  const double from = sine > 1e-6 ? std::sin((1 - t) * angle) / sine : 1 - t;
  const double to = sign * (sine > 1e-6 ? std::sin(t * angle) / sine : t);
  Numbers result(4);
  for (std::size_t c = 0; c < 4; ++c) result[c] = from * a[c] + to * b[c];
  return result;
}

/// A quaternion of no length stays as it is; whoever turns it into a rotation refuses it.
void normalise(Numbers& quaternion) {
  double squared = 0;
  for (const double x : quaternion) squared += x * x;
  if (squared > 0)
    for (double& x : quaternion) x /= std::sqrt(squared);
}

}  // namespace

Motion::Motion(const Document& document, std::vector<std::string>& remarks) {
  std::size_t left_out = 0;
  for (std::size_t a = 0; a < document.animations.size(); ++a) {
    const Json& animation = document.animations[a];
    const Json& channels = animation.at("channels");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Json& target = channels[c].at("target");
      const std::string path = target.at("path");
      if (!target.contains("node"))
        ++left_out;
      else
        add(document, animation, channels[c], fmt::format("animations[{}].channels[{}]", a, c));
    }
  }
  std::set<std::pair<int, Path>> driven;
  const auto twice = [&](const Channel& channel) {
    return !driven.insert({channel.node, channel.path}).second;
  };
  if (std::erase_if(channels_, twice) > 0)
    remarks.push_back("where several animations move the same node, the first does");
  if (left_out > 0)
    remarks.push_back(fmt::format("{} animation{} of other things than nodes left out", left_out,
                                  left_out == 1 ? "" : "s"));
  for (const Channel& channel : channels_)
    at_rest_.emplace(channel.node, document.model.nodes[std::size_t(channel.node)]);
}

void Motion::add(const Document& document, const Json& animation, const Json& channel,
                 const std::string& where) {
  const Json& target = channel.at("target");
  Channel result{target.at("node"), Path::translation, Way::linear, {}, {}};
  const std::string path = target.at("path");
  if (path == "rotation") result.path = Path::rotation;
  if (path == "scale") result.path = Path::scale;
  if (path == "weights") result.path = Path::weights;
  if (result.path != Path::weights &&
      document.model.nodes[std::size_t(result.node)].matrix.size() == 16)
    throw Error(fmt::format(
        "{}: {}: it moves nodes[{}], which has a matrix; translation, rotation and scale",
        document.file, where, result.node));

  const std::size_t sampler_index = channel.at("sampler");
  const Json& sampler = animation.at("samplers")[sampler_index];
  const std::string way = sampler.value("interpolation", "LINEAR");
  if (way == "STEP") result.way = Way::step;
  if (way == "CUBICSPLINE") result.way = Way::cubic_spline;
  result.times =
      numbers_of(document, sampler.at("input"), TINYGLTF_TYPE_SCALAR, 1, where + ".sampler.input");
  for (std::size_t i = 1; i < result.times.size(); ++i)
    if (result.times[i] <= result.times[i - 1])
      throw Error(
          fmt::format("{}: {}.sampler.input: time {} is not after the one before; ascending "
                      "times",
                      document.file, where, i));
  const auto [type, components] =
      result.path == Path::weights    ? std::pair(TINYGLTF_TYPE_SCALAR, std::size_t{1})
      : result.path == Path::rotation ? std::pair(TINYGLTF_TYPE_VEC4, std::size_t{4})
                                      : std::pair(TINYGLTF_TYPE_VEC3, std::size_t{3});
  result.values =
      numbers_of(document, sampler.at("output"), type, components, where + ".sampler.output");
  const std::size_t elements = result.values.size() / components;
  const std::size_t wanted = result.times.size() * (result.way == Way::cubic_spline ? 3 : 1);
  // Of weights every key has as many as there are targets.
  if (result.path == Path::weights ? elements % wanted != 0 : elements != wanted)
    throw Error(fmt::format("{}: {}.sampler.output: {} elements; {} for {} keys", document.file,
                            where, elements, wanted, result.times.size()));
  channels_.push_back(std::move(result));
}

std::vector<double> Motion::Channel::at(double seconds) const {
  const bool cubic = way == Way::cubic_spline;
  const std::size_t n = values.size() / (times.size() * (cubic ? 3 : 1));
  const auto element = [&](std::size_t i) {
    return Numbers(values.begin() + std::ptrdiff_t(i * n),
                   values.begin() + std::ptrdiff_t((i + 1) * n));
  };
  const auto value = [&](std::size_t key) { return element(cubic ? 3 * key + 1 : key); };
  const auto after = std::ranges::upper_bound(times, seconds);
  if (after == times.begin()) return value(0);
  const auto key = std::size_t(after - times.begin()) - 1;
  if (after == times.end() || way == Way::step) return value(key);

  const double h = times[key + 1] - times[key], t = (seconds - times[key]) / h;
  const Numbers a = value(key), b = value(key + 1);
  Numbers result(n);
  if (cubic) {  // Hermite's, glTF 2.0 appendix C.5
    const Numbers out = element(3 * key + 2), in = element(3 * key + 3);
    const double t2 = t * t, t3 = t2 * t;
    for (std::size_t c = 0; c < n; ++c)
      result[c] = (2 * t3 - 3 * t2 + 1) * a[c] + h * (t3 - 2 * t2 + t) * out[c] +
                  (3 * t2 - 2 * t3) * b[c] + h * (t3 - t2) * in[c];
  } else if (path == Path::rotation) {
    result = slerp(a, b, t);
  } else {
    for (std::size_t c = 0; c < n; ++c) result[c] = std::lerp(a[c], b[c], t);
  }
  if (path == Path::rotation) normalise(result);
  return result;
}

Poses Motion::poses(double seconds) const {
  Poses poses = at_rest_;
  for (const Channel& channel : channels_) {
    tinygltf::Node& node = poses.at(channel.node);
    (channel.path == Path::translation ? node.translation
     : channel.path == Path::rotation  ? node.rotation
     : channel.path == Path::weights   ? node.weights
                                       : node.scale) = channel.at(seconds);
  }
  return poses;
}

}  // namespace airlight::gltf
