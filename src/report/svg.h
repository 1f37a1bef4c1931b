#pragma once
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "report/ticks.h"

namespace airlight {

struct Axis {
  std::string label = "";
  Scale scale = Scale::linear;
  std::optional<double> low = std::nullopt;   ///< where the axis starts; none: where the data do
  std::optional<double> high = std::nullopt;  ///< where it ends
};

/// A curve through points, or the points alone.
struct Line {
  std::string name = "";  ///< in the legend; "" stays out of it
  std::vector<double> x = {}, y = {};
  std::vector<double> error = {};  ///< half length of the error bar of each point; empty: no bars
  bool markers = true;
  bool joined = true;
  bool dashed = false;
  std::optional<int> colour = std::nullopt;  ///< of the palette; none: the next one in turn
};

/// A histogram: heights.size() + 1 edges. Filled bars, or the stair that outlines them.
struct Bars {
  std::string name = "";
  std::vector<double> edges = {}, heights = {};
  bool filled = true;
  std::optional<int> colour = std::nullopt;
};

/// The area between two curves.
struct Band {
  std::string name = "";
  std::vector<double> x = {}, low = {}, high = {};
  std::optional<int> colour = std::nullopt;
};

/// A thin line across the whole plot, with its label beside it.
struct Rule {
  double at = 0;
  std::string label = "";
  bool horizontal = false;
};

/// Parts of the x axis tinted over the whole height: where a ray is lit, say. Takes no colour of
/// the palette unless it is given one.
struct Shade {
  std::string name = "";
  std::vector<std::pair<double, double>> intervals = {};
  std::optional<int> colour = std::nullopt;
};

using Mark = std::variant<Line, Bars, Band, Rule, Shade>;

/// A plot of anything over anything else.
///
///     Plot plot{.title = "Convergence"};
///     plot.x = {"samples per pixel", Scale::log2};
///     plot.y = {"RMSE", Scale::log};
///     plot.marks.push_back(Line{.name = "rewv", .x = spp, .y = rmse, .error = spread});
///     page.figure({svg(plot), "The error falls by half where samples are four times as many."});
///
/// Tints, bands, bars, rules and lines are drawn in this order, marks of one kind in their own.
/// Points that are not finite (or beyond 1e100), or not positive (or below 1e-100) on a log axis,
/// are left out and interrupt their line. Colours and marker shapes follow the order of the marks
/// and are told apart with every kind of colour vision (Okabe and Ito 2008).
struct Plot {
  std::string title = "";
  Axis x = {}, y = {};
  std::vector<Mark> marks = {};
  double width = 640;  ///< pixels, legend and labels included
  double height = 400;
};

/// A complete SVG document, white by itself; inside a Page it takes the page's colours, light or
/// dark. Throws Error where the lists of a mark are not equally long.
std::string svg(const Plot& plot);

/// Several plots under each other, for different quantities over one x axis: their left edges are
/// in line, and where they measure x on the same scale they show the same part of it.
std::string svg(std::span<const Plot> plots);

}  // namespace airlight
