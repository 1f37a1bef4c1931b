#include "report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "error.h"
#include "report/text.h"

namespace airlight {
namespace {

// Okabe and Ito 2008, without the yellow that white paper swallows and in an order that keeps
// neighbours far apart. The page overrides them where it is dark.
constexpr std::array palette = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                "#E69F00", "#56B4E9", "#555555"};
constexpr auto tint = "#F0C000";  // of shaded intervals: lit

// Attributes are what any viewer understands; where there is CSS, a page may change the colours.
constexpr auto style = R"(<style>
.airlight-plot .paper{fill:var(--plot-paper,#fff)}
.airlight-plot .ink{fill:var(--plot-ink,#1c1c1c)}
.airlight-plot .muted{fill:var(--plot-muted,#555)}
.airlight-plot .grid{stroke:var(--plot-grid,#e4e4e4)}
.airlight-plot .axis{stroke:var(--plot-axis,#777)}
.airlight-plot .rim{stroke:var(--plot-paper,#fff)}
.airlight-plot .c0{color:var(--plot-0,#0072B2)}
.airlight-plot .c1{color:var(--plot-1,#D55E00)}
.airlight-plot .c2{color:var(--plot-2,#009E73)}
.airlight-plot .c3{color:var(--plot-3,#CC79A7)}
.airlight-plot .c4{color:var(--plot-4,#E69F00)}
.airlight-plot .c5{color:var(--plot-5,#56B4E9)}
.airlight-plot .c6{color:var(--plot-6,#555)}
</style>
)";

constexpr double tick_size = 12, label_size = 13, title_size = 15, rule_size = 11;  // of letters

/// About how wide a text comes out: the letters of the usual sans fonts are 0.5 to 0.62 em wide.
double text_width(std::string_view text, double size) { return 0.58 * size * double(length(text)); }

/// A coordinate with as many digits as eyes can use; far outside the picture where that is needed.
std::string px(double v) {
  std::string text = fmt::format("{:.2f}", std::clamp(v, -1e6, 1e6) + 0.);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

template <class... Case>
struct Overload : Case... {
  using Case::operator()...;
};

bool drawable(Scale scale, double v) {
  constexpr double most = 1e100;  // beyond, the arithmetic of ranges could overflow
  return std::abs(v) <= most && (scale == Scale::linear || v >= 1 / most);
}

/// Throws unless the list has as many entries as it must.
void expect_size(const std::string& mark, const char* list, std::size_t found, std::size_t wanted) {
  if (found != wanted)
    throw Error(fmt::format("plot of \"{}\": {} has {} values; it must have {}", mark, list, found,
                            wanted));
}

void check_sizes(const Mark& mark) {
  std::visit(Overload{[](const Line& m) {
                        expect_size(m.name, "y", m.y.size(), m.x.size());
                        if (!m.error.empty())
                          expect_size(m.name, "error", m.error.size(), m.x.size());
                      },
                      [](const Bars& m) {
                        expect_size(m.name, "edges", m.edges.size(), m.heights.size() + 1);
                      },
                      [](const Band& m) {
                        expect_size(m.name, "low", m.low.size(), m.x.size());
                        expect_size(m.name, "high", m.high.size(), m.x.size());
                      },
                      [](const auto&) {}},
             mark);
}

/// The part of an axis that is shown, and how it lies on paper.
struct Range {
  Scale scale = Scale::linear;
  double low = 0, high = 1;

  double forward(double v) const { return scale == Scale::linear ? v : std::log(v); }
  double backward(double v) const { return scale == Scale::linear ? v : std::exp(v); }
  /// 0 at the low end, 1 at the high one.
  double operator()(double v) const {
    return (forward(v) - forward(low)) / (forward(high) - forward(low));
  }
};

/// Collects the values that an axis has to show.
struct Extent {
  Scale scale;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double v) {
    if (!drawable(scale, v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  void add(const std::vector<double>& values) {
    for (const double v : values) add(v);
  }
};

/// The range that shows `extent` with a margin at both ends, in parts of its length. What is
/// nowhere negative is not shown below zero; `from_zero` starts there unless the data stay far away
/// from it.
Range range_of(const Axis& axis, Extent extent, double margin, bool from_zero) {
  Range range = {axis.scale};
  const bool linear = axis.scale == Scale::linear;
  if (axis.low && drawable(axis.scale, *axis.low)) extent.add(*axis.low);
  if (axis.high && drawable(axis.scale, *axis.high)) extent.add(*axis.high);
  if (!(extent.low <= extent.high)) extent = {axis.scale, linear ? 0. : 1., linear ? 1. : 10.};
  const bool positive = extent.low >= 0;
  if (from_zero && linear && positive && extent.low < 0.3 * extent.high) extent.low = 0;
  double low = range.forward(extent.low), high = range.forward(extent.high);
  if (!(high - low > 1e-12 * (std::abs(high) + std::abs(low)))) {  // one value only
    const double room = linear ? (low == 0 ? 1 : 0.5 * std::abs(low)) : std::log(2.);
    low -= room;
    high += room;
  }
  const double length = high - low;
  range.low = range.backward(low - margin * length);
  range.high = range.backward(high + margin * length);
  if (positive) range.low = std::max(range.low, 0.);
  if (axis.low && drawable(axis.scale, *axis.low)) range.low = *axis.low;
  if (axis.high && drawable(axis.scale, *axis.high)) range.high = *axis.high;
  if (!(range.low < range.high))
    throw Error(fmt::format("plot axis \"{}\" from {} to {}: it must start below its end",
                            axis.label, range.low, range.high));
  return range;
}

/// One plot on its way to paper.
class Drawing {
 public:
  explicit Drawing(const Plot& plot);

  /// Gives both the wider of their left margins and, if they measure alike, of their x axes.
  void align(Drawing& other);
  std::string draw() const;

 private:
  struct Key {  // one entry of the legend
    std::string name, swatch;
    double width;
  };

  void place_legend();
  void fit_width() { width_ = std::max(40., plot_.width - left_ - right_); }
  std::string axes() const;
  std::string marks() const;

  double at_x(double v) const { return x_(v) * width_; }
  double at_y(double v) const { return (1 - y_(v)) * height_; }
  bool visible(double x, double y) const { return drawable(x_.scale, x) && drawable(y_.scale, y); }
  std::string point(char command, double x, double y) const {
    return fmt::format("{}{},{}", command, px(at_x(x)), px(at_y(y)));
  }
  double base() const {  // where bars stand
    return y_.scale == Scale::linear ? std::clamp(0., y_.low, y_.high) : y_.low;
  }

  std::string draw(const Line& line, int order) const;
  std::string draw(const Bars& bars) const;
  std::string draw(const Band& band) const;
  std::string draw(const Rule& rule) const;
  std::string draw(const Shade& shade) const;

  const Plot& plot_;
  Range x_, y_;
  std::vector<int> colours_;  // of each mark; −1 has none
  std::vector<Key> keys_;
  std::vector<std::vector<std::size_t>> legend_;  // entries in each of its lines
  std::vector<Tick> y_ticks_;
  double left_, top_, right_ = 18, bottom_;
  double width_, height_;  // of the area between the axes
};

/// Opens a group in a colour of the palette.
std::string group(int colour) {
  if (colour < 0) return fmt::format("<g color=\"{}\">", tint);
  const int c = colour % int(palette.size());
  return fmt::format("<g class=\"c{}\" color=\"{}\">", c, palette[std::size_t(c)]);
}

/// A marker around the origin; the shape follows the order of the series.
std::string marker(int order, const std::string& x, const std::string& y,
                   const std::string& tooltip = "") {
  static constexpr std::array shapes = {
      "M-3.8,0a3.8,3.8 0 1,0 7.6,0a3.8,3.8 0 1,0 -7.6,0z",              // disc
      "M-3.4,-3.4h6.8v6.8h-6.8z",                                       // square
      "M0,-4.6L4.4,3.2H-4.4z",                                          // triangle
      "M0,-4.9L4.9,0L0,4.9L-4.9,0z",                                    // diamond
      "M0,4.6L4.4,-3.2H-4.4z",                                          // triangle on its tip
      "M-1.6,-4.4h3.2v2.8h2.8v3.2h-2.8v2.8h-3.2v-2.8h-2.8v-3.2h2.8z"};  // plus
  const char* shape = shapes[std::size_t(order) % shapes.size()];
  const std::string open = fmt::format(
      "<path d=\"{}\" transform=\"translate({},{})\" fill=\"currentColor\" stroke=\"#fff\" "
      "class=\"rim\"",
      shape, x, y);
  return tooltip.empty() ? open + "/>" : open + "><title>" + escape(tooltip) + "</title></path>";
}

std::optional<int> own_colour(const Mark& mark) {
  return std::visit(Overload{[](const Rule&) { return std::optional<int>(); },
                             [](const auto& m) { return m.colour; }},
                    mark);
}

Drawing::Drawing(const Plot& plot) : plot_(plot) {
  Extent x = {plot.x.scale}, y = {plot.y.scale};
  bool markers = false;
  int next = 0;
  for (const Mark& mark : plot.marks) {
    check_sizes(mark);
    std::visit(Overload{[&](const Line& m) {
                          markers |= m.markers;
                          for (std::size_t i = 0; i < m.x.size(); ++i) {
                            if (!drawable(x.scale, m.x[i]) || !drawable(y.scale, m.y[i])) continue;
                            x.add(m.x[i]);
                            y.add(m.y[i]);
                            // On a log axis a bar that reaches zero would leave no room for the
                            // rest.
                            if (m.error.empty() || y.scale != Scale::linear) continue;
                            y.add(m.y[i] - m.error[i]);
                            y.add(m.y[i] + m.error[i]);
                          }
                        },
                        [&](const Bars& m) {
                          x.add(m.edges);
                          y.add(m.heights);
                          y.add(0);
                        },
                        [&](const Band& m) {
                          x.add(m.x);
                          y.add(m.low);
                          y.add(m.high);
                        },
                        [&](const Rule& m) { (m.horizontal ? y : x).add(m.at); },
                        [&](const Shade& m) {
                          for (const auto& [from, to] : m.intervals) x.add(from), x.add(to);
                        }},
               mark);
    const bool tinted = std::holds_alternative<Shade>(mark) || std::holds_alternative<Rule>(mark);
    colours_.push_back(own_colour(mark) ? std::max(0, *own_colour(mark)) : tinted ? -1 : next++);
  }
  x_ = range_of(plot.x, x, markers ? 0.03 : 0, false);
  y_ = range_of(plot.y, y, 0.06, true);

  place_legend();
  bottom_ = plot.x.label.empty() ? 30 : 52;
  height_ = std::max(40., plot.height - top_ - bottom_);
  y_ticks_ = ticks(y_.scale, y_.low, y_.high, std::clamp(int(height_ / 45), 2, 7));
  double widest = 0;
  for (const Tick& tick : y_ticks_) widest = std::max(widest, text_width(tick.label, tick_size));
  left_ = widest + (plot.y.label.empty() ? 14 : 38);
  fit_width();
}

void Drawing::place_legend() {
  top_ = plot_.title.empty() ? 14 : 38;
  for (std::size_t i = 0; i < plot_.marks.size(); ++i) {
    std::visit(
        Overload{[&](const Line& m) {
                   std::string swatch;
                   if (m.joined)
                     swatch += fmt::format(
                         "<path d=\"M0,0H26\" stroke=\"currentColor\" stroke-width=\"2\"{}/>",
                         m.dashed ? " stroke-dasharray=\"6 4\"" : "");
                   if (m.markers) swatch += marker(colours_[i], "13", "0");
                   keys_.push_back({m.name, group(colours_[i]) + swatch + "</g>", 0});
                 },
                 [&](const Bars& m) {
                   const char* box = m.filled ? "<path d=\"M3,-5H23V5H3z\" fill=\"currentColor\" "
                                                "fill-opacity=\"0.3\" stroke=\"currentColor\"/>"
                                              : "<path d=\"M1,5H9V-4H17V2H25\" fill=\"none\" "
                                                "stroke=\"currentColor\" stroke-width=\"1.5\"/>";
                   keys_.push_back({m.name, group(colours_[i]) + box + "</g>", 0});
                 },
                 [&](const Rule&) { keys_.push_back({}); },
                 [&](const auto& m) {
                   const char* box =
                       "<path d=\"M3,-5H23V5H3z\" fill=\"currentColor\" fill-opacity=\"0.28\"/>";
                   keys_.push_back({m.name, group(colours_[i]) + box + "</g>", 0});
                 }},
        plot_.marks[i]);
  }
  std::erase_if(keys_, [](const Key& key) { return key.name.empty(); });
  double filled = 0;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    keys_[i].width = 32 + text_width(keys_[i].name, tick_size) + 16;
    if (legend_.empty() || filled + keys_[i].width > plot_.width - 60) {
      legend_.emplace_back();
      filled = 0;
    }
    legend_.back().push_back(i);
    filled += keys_[i].width;
  }
  if (!legend_.empty()) top_ += 20. * double(legend_.size()) + 4;
}

void Drawing::align(Drawing& other) {
  left_ = other.left_ = std::max(left_, other.left_);
  fit_width();
  other.fit_width();
  if (x_.scale != other.x_.scale) return;
  x_.low = other.x_.low = std::min(x_.low, other.x_.low);
  x_.high = other.x_.high = std::max(x_.high, other.x_.high);
}

std::string Drawing::draw() const {
  std::string out;
  if (!plot_.title.empty())
    out += fmt::format(
        "<text class=\"ink\" fill=\"#1c1c1c\" x=\"{}\" y=\"24\" font-size=\"{}\" "
        "font-weight=\"600\">{}</text>\n",
        px(left_), title_size, escape(plot_.title));
  double y = plot_.title.empty() ? 16 : 44;
  for (const auto& row : legend_) {
    double x = left_;
    for (const std::size_t i : row) {
      out += fmt::format(
          "<g transform=\"translate({},{})\">{}<text class=\"ink\" fill=\"#1c1c1c\" x=\"32\" "
          "y=\"4\" "
          "font-size=\"{}\">{}</text></g>\n",
          px(x), px(y), keys_[i].swatch, tick_size, escape(keys_[i].name));
      x += keys_[i].width;
    }
    y += 20;
  }
  return out + axes() + marks();
}

std::string Drawing::axes() const {
  std::string grid, marks, labels;
  const auto text = [&](double x, double y, const char* anchor, const std::string& label) {
    labels += fmt::format(
        "<text class=\"muted\" fill=\"#555\" x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n",
        px(x), px(y), anchor, escape(label));
  };
  double last = -1e9;  // right end of the label before
  for (const Tick& tick : ticks(x_.scale, x_.low, x_.high, std::clamp(int(width_ / 70), 2, 12))) {
    const double x = at_x(tick.at);
    const bool small = tick.label.empty();
    if (!small) grid += fmt::format("M{},0V{}", px(x), px(height_));
    marks += fmt::format("M{},{}v{}", px(x), px(height_), small ? 3 : 5);
    const double half = text_width(tick.label, tick_size) / 2;
    if (small || x - half < last + 4) continue;  // never one label over another
    text(x, height_ + 19, "middle", tick.label);
    last = x + half;
  }
  for (const Tick& tick : y_ticks_) {
    const double y = at_y(tick.at);
    const bool small = tick.label.empty();
    if (!small) grid += fmt::format("M0,{}H{}", px(y), px(width_));
    marks += fmt::format("M0,{}h{}", px(y), small ? -3 : -5);
    if (!small) text(-9, y + 4, "end", tick.label);
  }
  std::string out = fmt::format("<g transform=\"translate({},{})\" font-size=\"{}\">\n", px(left_),
                                px(top_), tick_size);
  out += fmt::format("<path class=\"grid\" stroke=\"#e4e4e4\" fill=\"none\" d=\"{}\"/>\n", grid);
  out += fmt::format("<path class=\"axis\" stroke=\"#777\" fill=\"none\" d=\"M0,0V{}H{}{}\"/>\n",
                     px(height_), px(width_), marks);
  out += labels;
  if (!plot_.x.label.empty())
    out += fmt::format(
        "<text class=\"ink\" fill=\"#1c1c1c\" x=\"{}\" y=\"{}\" text-anchor=\"middle\" "
        "font-size=\"{}\">{}</text>\n",
        px(width_ / 2), px(height_ + 42), label_size, escape(plot_.x.label));
  if (!plot_.y.label.empty())
    out += fmt::format(
        "<text class=\"ink\" fill=\"#1c1c1c\" transform=\"translate({},{}) rotate(-90)\" "
        "text-anchor=\"middle\" "
        "font-size=\"{}\">{}</text>\n",
        px(16 - left_), px(height_ / 2), label_size, escape(plot_.y.label));
  return out + "</g>\n";
}

std::string Drawing::marks() const {
  // Tints below all, then areas, rules, lines.
  const auto layer = [](const Mark& mark) {
    return std::visit(Overload{[](const Shade&) { return 0; }, [](const Band&) { return 1; },
                               [](const Bars&) { return 2; }, [](const Rule&) { return 3; },
                               [](const Line&) { return 4; }},
                      mark);
  };
  // An svg inside the svg cuts off what lies outside the axes, without an id that two plots would
  // share.
  std::string out = fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\n", px(left_),
                                px(top_), px(width_), px(height_));
  for (int current = 0; current < 5; ++current)
    for (std::size_t i = 0; i < plot_.marks.size(); ++i) {
      const Mark& mark = plot_.marks[i];
      if (layer(mark) != current) continue;
      const std::string content =
          std::visit(Overload{[&](const Line& m) { return draw(m, colours_[i]); },
                              [&](const auto& m) { return draw(m); }},
                     mark);
      out += group(colours_[i]) + content + "</g>\n";
    }
  return out + "</svg>\n";
}

std::string Drawing::draw(const Line& line, int order) const {
  std::string path, bars, dots;
  bool pen_down = false;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    const double x = line.x[i], y = line.y[i];
    if (!visible(x, y)) {
      pen_down = false;
      continue;
    }
    path += point(pen_down ? 'L' : 'M', x, y);
    pen_down = true;
    const double error = line.error.empty() ? 0 : line.error[i];
    if (error > 0 && std::isfinite(error)) {
      const double low = drawable(y_.scale, y - error) ? y - error : y_.low;
      bars += fmt::format("{}V{}m-3,0h6M{},{}h6", point('M', x, low), px(at_y(y + error)),
                          px(at_x(x) - 3), px(at_y(low)));
    }
    if (line.markers) {
      std::string tooltip = line.name.empty() ? "" : line.name + ": ";
      tooltip +=
          fmt::format("{}, {}", number(x, 5), number(y, error > 0 ? error : std::nan(""), 5));
      dots += marker(order, px(at_x(x)), px(at_y(y)), tooltip);
    }
  }
  std::string out;
  if (!bars.empty())
    out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"currentColor\"/>", bars);
  if (line.joined && !path.empty())
    out += fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\" "
        "stroke-linejoin=\"round\"{}/>",
        path, line.dashed ? " stroke-dasharray=\"6 4\"" : "");
  return out + dots;
}

std::string Drawing::draw(const Bars& bars) const {
  std::string area, stair;
  bool pen_down = false;
  const std::string floor = px(at_y(base()));
  for (std::size_t i = 0; i < bars.heights.size(); ++i) {
    const double from = bars.edges[i], to = bars.edges[i + 1];
    // An empty bin of a log axis has no height but is no gap: its bar lies on the floor.
    const bool empty = y_.scale != Scale::linear && bars.heights[i] <= 0;
    const double height = empty ? y_.low : bars.heights[i];
    if (!visible(from, height) || !drawable(x_.scale, to)) {
      pen_down = false;
      continue;
    }
    const std::string a = px(at_x(from)), b = px(at_x(to)), top = px(at_y(height));
    area += fmt::format("M{0},{1}V{2}H{3}V{1}z", a, floor, top, b);
    stair +=
        pen_down ? fmt::format("V{}H{}", top, b) : fmt::format("M{},{}V{}H{}", a, floor, top, b);
    const bool last = i + 1 == bars.heights.size() || !std::isfinite(bars.heights[i + 1]);
    if (last) stair.append("V").append(floor);
    pen_down = true;
  }
  std::string out;
  if (bars.filled && !area.empty())
    out += fmt::format("<path d=\"{}\" fill=\"currentColor\" fill-opacity=\"0.3\"/>", area);
  if (!stair.empty())
    out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"{}\"/>",
                       stair, bars.filled ? 1 : 1.5);
  return out;
}

std::string Drawing::draw(const Band& band) const {
  std::string out;
  for (std::size_t i = 0; i < band.x.size();) {  // one area between any two gaps
    std::string there, back;
    for (; i < band.x.size() && visible(band.x[i], band.low[i]) && visible(band.x[i], band.high[i]);
         ++i) {
      there += point(there.empty() ? 'M' : 'L', band.x[i], band.low[i]);
      back.insert(0, point('L', band.x[i], band.high[i]));
    }
    if (!there.empty())
      out += fmt::format("<path d=\"{}{}z\" fill=\"currentColor\" fill-opacity=\"0.25\"/>", there,
                         back);
    else
      ++i;
  }
  return out;
}

std::string Drawing::draw(const Rule& rule) const {
  if (!drawable(rule.horizontal ? y_.scale : x_.scale, rule.at)) return "";
  const double at = rule.horizontal ? at_y(rule.at) : at_x(rule.at);
  std::string out =
      fmt::format("<path class=\"axis\" stroke=\"#777\" stroke-dasharray=\"3 3\" d=\"{}\"/>",
                  rule.horizontal ? fmt::format("M0,{}H{}", px(at), px(width_))
                                  : fmt::format("M{},0V{}", px(at), px(height_)));
  if (rule.label.empty()) return out;
  const std::string place =
      rule.horizontal ? fmt::format("x=\"{}\" y=\"{}\" text-anchor=\"end\"", px(width_ - 4),
                                    px(at < 16 ? at + 13 : at - 4))
                      : fmt::format("transform=\"translate({},4) rotate(-90)\" text-anchor=\"end\"",
                                    px(at < 16 ? at + 12 : at - 4));
  return out + fmt::format("<text class=\"muted\" fill=\"#555\" font-size=\"{}\" {}>{}</text>",
                           rule_size, place, escape(rule.label));
}

std::string Drawing::draw(const Shade& shade) const {
  std::string path;
  for (auto [from, to] : shade.intervals) {
    if (!drawable(x_.scale, from) || !drawable(x_.scale, to)) continue;
    path += fmt::format("M{},0V{}H{}V0z", px(at_x(from)), px(height_), px(at_x(to)));
  }
  return path.empty()
             ? ""
             : fmt::format("<path d=\"{}\" fill=\"currentColor\" fill-opacity=\"0.28\"/>", path);
}

}  // namespace

std::string svg(const Plot& plot) { return svg(std::span(&plot, 1)); }

std::string svg(std::span<const Plot> plots) {
  std::vector<Drawing> drawings(plots.begin(), plots.end());
  for (int pass = 0; pass < 2; ++pass)  // the second tells the first ones what the last one needs
    for (std::size_t i = 1; i < drawings.size(); ++i) drawings[i].align(drawings[i - 1]);
  double width = 0, height = 0;
  std::string title;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    width = std::max(width, plots[i].width);
    height += plots[i].height;
    if (title.empty()) title = plots[i].title;
  }
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"airlight-plot\" role=\"img\" "
      "width=\"{0}\" "
      "height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica Neue, Helvetica, Arial, "
      "sans-serif\">\n",
      px(width), px(height));
  if (!title.empty()) out += fmt::format("<title>{}</title>\n", escape(title));
  out += style;
  out += fmt::format("<rect class=\"paper\" fill=\"#fff\" width=\"{}\" height=\"{}\"/>\n",
                     px(width), px(height));
  double y = 0;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    out += fmt::format("<g transform=\"translate(0,{})\">\n{}</g>\n", px(y), drawings[i].draw());
    y += plots[i].height;
  }
  return out + "</svg>\n";
}

}  // namespace airlight
