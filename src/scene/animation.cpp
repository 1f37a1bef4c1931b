#include "scene/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/reader.h"
#include "scene/render_settings.h"

namespace airlight {
namespace {

/// An [[animation]] table that has been checked.
struct Track {
  Cursor at;
  AnimationDocument document;
  std::vector<double> times;  ///< of the keys, ascending  [frames]

  Cursor values() const { return *at.find("values"); }
};

/// A time in frames; one that is a whole frame but for the rounding of its decimals is that frame.
double in_frames(double seconds, double fps) {
  const double time = seconds * fps, whole = std::round(time);
  return std::abs(time - whole) <= 1e-12 * std::abs(whole) ? whole : time;
}

std::vector<double> times_of(const AnimationDocument& document, const Cursor& at, double fps) {
  if (document.frames.has_value() == document.seconds.has_value())
    at.complain(fmt::format("{} when its keys are; accepted: frames, or seconds",
                            document.frames ? "says twice" : "does not say"));
  const Cursor list = *at.find(document.frames ? "frames" : "seconds");
  std::vector<double> times = document.frames ? *document.frames : *document.seconds;
  if (times.empty()) list.refuse("is empty: accepted is at least one key");
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] <= times[i - 1])
      list.element(i).refuse("does not come after the key before it: accepted are ascending keys");
  if (document.values->size() != times.size())
    at.find("values")->complain(fmt::format("has {} values for {} keys: accepted is one for each",
                                            document.values->size(), times.size()));
  if (document.seconds)
    for (double& time : times) time = in_frames(time, fps);
  return times;
}

void check_path(const Track& track, const std::vector<Track>& before) {
  const std::string& path = *track.document.path;
  const Cursor at = *track.at.find("path");
  for (const char* fixed : {"animation", "render.frame", "render.fps"})
    if (is_within(path, fixed) || is_within(fixed, path))
      at.refuse("cannot change from frame to frame");
  for (const Track& other : before)
    if (is_within(path, *other.document.path) || is_within(*other.document.path, path))
      at.refuse(fmt::format("is changed already by {}", other.at.path()));
}

/// A key's numbers: one, or those of a list.
std::vector<double> numbers_of(const Cursor& key) {
  const std::string wanted = "a number or a list of numbers; step takes anything";
  const Value::Array* array = key.value().array();
  if (!array) return {read_number(key, any_number(), wanted)};
  std::vector<double> numbers;
  for (std::size_t i = 0; i < array->size(); ++i)
    numbers.push_back(read_number(key.element(i), any_number(), wanted));
  return numbers;
}

/// The slope at a key between two others, so that the curve turns at keys only (Steffen 1990, Eq.
/// 11).
double slope_between(double h0, double s0, double h1, double s1) {
  if (s0 * s1 <= 0) return 0;
  const double through = (s0 * h1 + s1 * h0) / (h0 + h1);
  return std::copysign(2 * std::min({std::abs(s0), std::abs(s1), 0.5 * std::abs(through)}), s0);
}

/// Cubic in each interval, continuous in its slope, level where the value is held (before the first
/// key and after the last), and monotone between two keys (Steffen 1990).
double smooth(const std::vector<double>& t, const std::vector<double>& y, std::size_t i, double x) {
  const auto secant = [&](std::size_t k) { return (y[k + 1] - y[k]) / (t[k + 1] - t[k]); };
  const auto slope = [&](std::size_t k) {
    if (k == 0 || k + 1 == t.size()) return 0.;
    return slope_between(t[k] - t[k - 1], secant(k - 1), t[k + 1] - t[k], secant(k));
  };
  const double h = t[i + 1] - t[i], u = (x - t[i]) / h;
  const double a = slope(i) * h, b = slope(i + 1) * h, rise = y[i + 1] - y[i];
  return y[i] + u * (a + u * (3 * rise - 2 * a - b + u * (a + b - 2 * rise)));
}

/// The key that holds at a time: the last that is not after it, or the first.
std::size_t key_at(const std::vector<double>& times, double time) {
  const auto after = std::ranges::upper_bound(times, time);
  return after == times.begin() ? 0 : std::size_t(after - times.begin()) - 1;
}

/// ", between the keys at 3:8 and 3:13".
std::string between(const Track& track, std::size_t key) {
  const auto line_and_column = [&](std::size_t i) {
    const Place& place = track.values().element(i).value().place;
    return place.is_override() ? place.text() : fmt::format("{}:{}", place.line, place.column);
  };
  return fmt::format(", between the keys at {} and {}", line_and_column(key),
                     line_and_column(key + 1));
}

/// What a track's value is at a time, in frames.
Value value_at(const Track& track, double time) {
  const std::size_t key = key_at(track.times, time);
  Value result = (*track.document.values)[key];
  result.key_place = track.at.find("path")->value().place;
  if (track.document.interpolation == Interpolation::step) return result;

  std::vector<std::vector<double>> numbers;  // of each key
  for (std::size_t i = 0; i < track.times.size(); ++i) {
    numbers.push_back(numbers_of(track.values().element(i)));
    if (numbers.back().size() != numbers[0].size() ||
        bool(track.values().element(i).value().array()) != bool(result.array()))
      track.values().element(i).refuse("is of another kind than the other keys' values");
  }
  const bool is_held = time <= track.times[0] || key + 1 == track.times.size();
  const std::string moment = fmt::format("at frame {}", time) +
                             (is_held || time == track.times[key] ? "" : between(track, key));
  const auto component = [&](std::size_t c, Value& value) {
    std::vector<double> y;
    for (const std::vector<double>& n : numbers) y.push_back(n[c]);
    value.moment = moment;
    if (is_held)
      value.data = y[key];
    else if (track.document.interpolation == Interpolation::smooth)
      value.data = smooth(track.times, y, key, time);
    else
      value.data = std::lerp(y[key], y[key + 1],
                             (time - track.times[key]) / (track.times[key + 1] - track.times[key]));
  };
  if (auto* array = std::get_if<Value::Array>(&result.data))
    for (std::size_t c = 0; c < array->size(); ++c) component(c, (*array)[c]);
  else
    component(0, result);
  return result;
}

}  // namespace

void animate(Value& document) {
  const Cursor at(document);
  const auto list = at.find("animation");
  if (!list) return;
  RenderSettings render;
  if (const auto found = at.find("render")) read_table(*found, render);
  std::vector<AnimationDocument> animations;
  read(*list, animations, {});
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < animations.size(); ++i) {
    Track track{list->element(i), animations[i], {}};
    track.times = times_of(track.document, track.at, render.fps);
    check_path(track, tracks);
    tracks.push_back(std::move(track));
  }
  std::vector<Value> values;  // all of them before the document changes under the cursors
  for (const Track& track : tracks) values.push_back(value_at(track, double(render.frame)));
  for (std::size_t i = 0; i < tracks.size(); ++i)
    replace(*tracks[i].document.path, std::move(values[i]), document);
}

}  // namespace airlight
