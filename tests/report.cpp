// Plots, tables and pages: that they are well-formed, say the numbers they were given, and survive
// whatever text and numbers a render may hand them. The page that `Page.shows_everything_it_can`
// writes into the temporary directory is there to be looked at.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "error.h"
#include "image/atomic_file.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/page.h"
#include "report/svg.h"
#include "report/text.h"
#include "support/xml.h"

namespace airlight {
namespace {

using test::xml_fault;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t count(std::string_view text, std::string_view what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + what.size()))
    ++n;
  return n;
}

/// A PNG of one pixel, orange.
std::string orange_png() {
  constexpr std::string_view hex =
      "89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de0000000c49444154"
      "78da63f8bf800100044101a0ef9f609e0000000049454e44ae426082";
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += char(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return bytes;
}

// --- text

TEST(Text, is_escaped_for_xml) {
  EXPECT_EQ(escape("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  EXPECT_EQ(escape("σ = 0.4 ±\n1"), "σ = 0.4 ±\n1");
  EXPECT_EQ(escape(std::string_view("a\0b\x01\x7f", 5)), "ab\x7f");
}

TEST(Text, replaces_what_is_not_utf8) {
  EXPECT_EQ(escape("caf\xe9!"), "caf\uFFFD!");                        // Latin-1
  EXPECT_EQ(escape("\xc0\xaf"), "\uFFFD\uFFFD");                      // overlong
  EXPECT_EQ(escape("\xe0\x80\xaf"), "\uFFFD\uFFFD\uFFFD");            // overlong, too
  EXPECT_EQ(escape("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");            // half of a surrogate pair
  EXPECT_EQ(escape("\xf4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD");  // beyond U+10FFFF
  EXPECT_EQ(escape("€ 🌫 \xe2\x82"), "€ 🌫 \uFFFD\uFFFD");    // cut short
}

TEST(Text, marks_code_indices_and_powers) {
  EXPECT_EQ(rich("`a<b` and σ_{t} x^{2}"), "<code>a&lt;b</code> and σ<sub>t</sub> x<sup>2</sup>");
  EXPECT_EQ(rich("sphere_in_fog, `open, x_{open, x^2"), "sphere_in_fog, `open, x_{open, x^2");
}

TEST(Text, is_as_long_as_it_looks) {
  EXPECT_EQ(length(""), 0u);
  EXPECT_EQ(length("10⁻³ ± σ"), 8u);
}

TEST(Number, reads_well) {
  EXPECT_EQ(number(256), "256");
  EXPECT_EQ(number(-3), "−3");
  EXPECT_EQ(number(-0.), "0");
  EXPECT_EQ(number(35.4912), "35.49");
  EXPECT_EQ(number(0.0123456), "0.01235");
  EXPECT_EQ(number(99999.5), "1.000 × 10⁵");
  EXPECT_EQ(number(0.00099996), "0.001000");
  EXPECT_EQ(number(-1.23456e-12), "−1.235 × 10⁻¹²");
  EXPECT_EQ(number(12345.6, 3), "12346");
  EXPECT_EQ(number(nan), "–");
  EXPECT_EQ(number(-infinity), "−∞");
}

TEST(Number, shows_no_more_places_than_its_spread_allows) {
  EXPECT_EQ(number(35.4912, 0.0234, 4), "35.491 ± 0.023");
  EXPECT_EQ(number(0.0123456, 0.00056, 4), "0.01235 ± 0.00056");
  EXPECT_EQ(number(1.23456e-5, 5.6e-7, 4), "(1.235 ± 0.056) × 10⁻⁵");
  EXPECT_EQ(number(120, 34, 4), "120 ± 34");
  EXPECT_EQ(number(0, 0.012, 4), "0.000 ± 0.012");
  EXPECT_EQ(number(2.5, 0, 4), "2.500 ± 0");
  EXPECT_EQ(number(2.5, nan, 4), "2.500");
  EXPECT_EQ(number(nan, 0.1, 4), "–");
  EXPECT_EQ(number(infinity, nan, 4), "∞");
}

// --- tables

Table convergence() {
  Table table{.caption = "Error at 4 spp",
              .columns = {{"estimator"},
                          {"spp"},
                          {"RMSE", "W/(m² sr)", Best::lowest},
                          {"PSNR", "dB", Best::highest}},
              .group_by = 1};
  table.rows = {{"rm", 4, {0.0125, 0.0002}, {35.5, 0.1}},
                {"a \"b\", c", 4, {0.011, 0.0003}, 36.},
                {"rm", 16, 0.003, nan},
                {"<rewv>", 16, 0.002, infinity}};
  return table;
}

TEST(Csv, quotes_and_keeps_every_digit_of_a_float) {
  EXPECT_EQ(csv(convergence()),
            "estimator,spp,RMSE [W/(m² sr)],RMSE spread [W/(m² sr)],PSNR [dB],PSNR spread [dB]\n"
            "rm,4,0.0125,0.0002,35.5,0.1\n"
            "\"a \"\"b\"\", c\",4,0.011,0.0003,36,\n"
            "rm,16,0.003,,,\n"
            "<rewv>,16,0.002,,inf,\n");
  for (const float f : {0.1f, 16777217.f, 1.17549435e-38f, 3.4028235e38f}) {
    Table one{.columns = {{"x"}}, .rows = {{double(f)}}};
    EXPECT_EQ(std::stof(csv(one).substr(2)), f);
  }
  Table words{.columns = {{"two\nlines"}, {""}}, .rows = {{"plain", ""}, {"a\r", "b"}}};
  EXPECT_EQ(csv(words), "\"two\nlines\",\nplain,\n\"a\r\",b\n");
}

TEST(Table, is_well_formed_and_aligns_numbers) {
  const std::string out = html(convergence());
  EXPECT_EQ(xml_fault(out), "") << out;
  EXPECT_THAT(out, HasSubstr("<td>&lt;rewv&gt;</td>"));
  EXPECT_THAT(out, HasSubstr("<th class=\"number\">PSNR<span class=\"unit\">dB</span></th>"));
  EXPECT_THAT(out, HasSubstr("<td class=\"number\">0.01250 ± 0.00020</td>"));
}

TEST(Table, sets_the_best_of_each_group_in_bold) {
  const std::string out = html(convergence());
  for (const char* best : {"<b>0.01100 ± 0.00030</b>", "<b>36</b>", "<b>0.002000</b>", "<b>∞</b>"})
    EXPECT_THAT(out, HasSubstr(best));
  EXPECT_EQ(count(out, "<b>"), 4u);
  EXPECT_EQ(count(out, "<tbody>"), 2u);
}

TEST(Table, refuses_a_row_of_another_length) {
  Table table = convergence();
  table.rows.push_back({"rm", 64});
  EXPECT_THROW(html(table), Error);
  EXPECT_THROW(csv(table), Error);
  table = convergence();
  table.group_by = 4;
  EXPECT_THROW(html(table), Error);
}

// --- checks

TEST(Check, holds_within_its_range_ends_included) {
  EXPECT_TRUE((Row{"", {}, 1, 1, 2}.holds()));
  EXPECT_TRUE((Row{"", {}, 2, 1, 2}.holds()));
  EXPECT_FALSE((Row{"", {}, 2.1, 1, 2}.holds()));
  EXPECT_FALSE((Row{"", {}, nan, -infinity, infinity}.holds()));
  EXPECT_TRUE(all_hold({}));
}

const std::vector<Row> rows = {{"rewv, config A", 35.01, 35.0987654321, 34.85, 35.35},
                               {"a \"b\" < c", {}, 2e-10, -infinity, 1e-9},
                               {"broken", 1, nan, 0, infinity}};

TEST(Check, writes_json_that_reads_back_exactly) {
  const auto read = nlohmann::json::parse(json(rows));
  ASSERT_EQ(read.size(), 3u);
  for (const auto& row : read) EXPECT_EQ(row.size(), 5u);
  EXPECT_EQ(read[0]["label"], "rewv, config A");
  EXPECT_EQ(read[0]["published"], 35.01);
  EXPECT_EQ(read[0]["measured"].get<double>(), 35.0987654321);
  EXPECT_EQ(read[0]["low"], 34.85);
  EXPECT_EQ(read[0]["high"], 35.35);
  EXPECT_TRUE(read[1]["published"].is_null());
  EXPECT_TRUE(read[1]["low"].is_null());
  EXPECT_TRUE(read[2]["measured"].is_null());
  EXPECT_EQ(json({}), "[]\n");
  EXPECT_TRUE(nlohmann::json::accept(json(std::vector<Row>{{"caf\xe9", {}, 1, 0, 2}})));
}

TEST(Check, shows_what_fails) {
  const std::string out = html(rows);
  EXPECT_EQ(xml_fault(out), "") << out;
  EXPECT_EQ(count(out, "class=\"holds\""), 2u);
  EXPECT_EQ(count(out, "class=\"fails\""), 1u);
  EXPECT_THAT(out, HasSubstr("≤ 1.000 × 10⁻⁹"));
  EXPECT_THAT(out, HasSubstr("34.85 … 35.35"));
  EXPECT_EQ(count(out, "reported"), 0u);
}

TEST(Check, says_that_a_value_without_a_range_is_only_reported) {
  const std::string out = html(std::vector<Row>{{"time", 1.1, 0.9, -infinity, infinity}});
  EXPECT_EQ(xml_fault(out), "") << out;
  EXPECT_EQ(count(out, "class=\"reported\""), 1u);
  EXPECT_EQ(count(out, "holds"), 0u);
}

// --- ticks

std::vector<std::string> labels(Scale scale, double low, double high, int wanted) {
  std::vector<std::string> out;
  for (const Tick& tick : ticks(scale, low, high, wanted))
    if (!tick.label.empty()) out.push_back(tick.label);
  return out;
}

TEST(Ticks, stand_at_round_values) {
  EXPECT_THAT(labels(Scale::linear, 0, 1, 5), ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_THAT(labels(Scale::linear, -3, 3, 5), ElementsAre("−2", "0", "2"));
  EXPECT_THAT(labels(Scale::linear, 26.3, 41.2, 6), ElementsAre("30", "35", "40"));
  EXPECT_THAT(labels(Scale::linear, 0, 2e-7, 2), ElementsAre("0", "1 × 10⁻⁷", "2 × 10⁻⁷"));
  EXPECT_THAT(labels(Scale::log2, 1, 256, 9),
              ElementsAre("1", "2", "4", "8", "16", "32", "64", "128", "256"));
  EXPECT_THAT(labels(Scale::log2, 0.5, 65536, 6),
              ElementsAre("1", "4", "16", "64", "256", "1024", "4096", "16384", "65536"));
  EXPECT_THAT(labels(Scale::log, 0.0007, 2, 6), ElementsAre("0.001", "0.01", "0.1", "1"));
  EXPECT_THAT(labels(Scale::log, 1e-9, 1e-4, 6),
              ElementsAre("10⁻⁹", "10⁻⁸", "10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴"));
  EXPECT_THAT(labels(Scale::log, 0.8, 30, 6), ElementsAre("1", "2", "5", "10", "20"));
}

TEST(Ticks, are_few_and_inside_and_never_none) {
  for (const Scale scale : {Scale::linear, Scale::log, Scale::log2})
    for (const double low : {1e-30, 1e-3, 0.97, 1., 3., 1e5})
      for (const double factor : {1.0001, 1.1, 1.9, 2.5, 8., 40., 1e3, 1e7, 1e30})
        for (const int wanted : {2, 5, 9}) {
          const auto all = ticks(scale, low, low * factor, wanted);
          const auto shown = labels(scale, low, low * factor, wanted);
          EXPECT_GE(shown.size(), 1u) << int(scale) << ' ' << low << ' ' << factor << ' ' << wanted;
          EXPECT_LE(shown.size(), 2u * unsigned(wanted) + 1)
              << int(scale) << ' ' << low << ' ' << factor;
          for (std::size_t i = 0; i < all.size(); ++i) {
            EXPECT_GE(all[i].at, low - 1e-6 * low * factor);
            EXPECT_LE(all[i].at, low * factor * (1 + 1e-6));
            EXPECT_TRUE(i == 0 || all[i].at > all[i - 1].at);
          }
          // Two ticks never read the same.
          EXPECT_EQ(std::set(shown.begin(), shown.end()).size(), shown.size())
              << int(scale) << ' ' << low << ' ' << factor << ' ' << wanted << ' ' << shown[0];
        }
}

// --- plots

/// Six estimators that converge as they should, one of them with gaps.
Plot convergence_plot() {
  Plot plot{.title = "Error over samples",
            .x = {"samples per pixel", Scale::log2},
            .y = {"RMSE  [W/(m² sr)]", Scale::log}};
  const char* names[] = {"rm",   "mcds", "mcwvds",      "rees",
                         "reds", "rewv", "equiangular", "rm (per step)"};
  for (int i = 0; i < 8; ++i) {
    Line line{.name = names[i]};
    for (int k = 0; k <= 8; ++k) {
      const double spp = std::exp2(k);
      line.x.push_back(spp);
      line.y.push_back(0.08 / (i + 1) * std::pow(spp, -0.5 - 0.05 * i));
      line.error.push_back(line.y.back() * 0.12);
    }
    if (i == 3) line.y[4] = nan;
    if (i == 7) line.dashed = true;
    plot.marks.push_back(line);
  }
  return plot;
}

/// What `probe` shows of a ray: where it is lit, transmittance, pdf and samples.
std::vector<Plot> probe_plots() {
  std::vector<double> t, transmittance, pdf, samples, at;
  for (int i = 0; i <= 200; ++i) {
    t.push_back(2 + 6 * i / 200.);
    transmittance.push_back(std::exp(-0.4 * (t.back() - 2)));
    pdf.push_back(0.4 * transmittance.back() / (1 - std::exp(-2.4)));
  }
  for (int i = 0; i < 8; ++i) {
    at.push_back(2 - std::log1p(-(i + 0.5) / 8 * (1 - std::exp(-2.4))) / 0.4);
    samples.push_back(0.4 * std::exp(-0.4 * (at.back() - 2)) / (1 - std::exp(-2.4)));
  }
  const Shade lit{"lit", {{2.6, 3.4}, {4.1, 5.9}, {7.5, 8}}};
  Plot upper{.title = "Pixel 120, 80", .height = 240};
  upper.y.label = "transmittance";
  upper.marks = {lit, Rule{2, "enter"}, Rule{8, "exit"},
                 Line{.name = "red", .x = t, .y = transmittance, .markers = false, .colour = 1}};
  Plot lower{.height = 260};
  lower.x.label = "distance along the ray  [m]";
  lower.y.label = "pdf  [1/m]";
  lower.marks = {lit, Line{.name = "pdf", .x = t, .y = pdf, .markers = false},
                 Line{.name = "samples", .x = at, .y = samples, .joined = false}};
  return {upper, lower};
}

Plot histogram_plot() {
  Plot plot{.title = "Samples against pdf", .x = {"t  [m]"}, .y = {"density  [1/m]"}};
  Bars bars{.name = "10⁶ samples"};
  Line pdf{.name = "pdf", .markers = false};
  Band band{.name = "± 4 σ"};
  for (int i = 0; i <= 64; ++i) {
    const double x = 3 * i / 64., p = std::exp(-x);
    bars.edges.push_back(x);
    if (i < 64) bars.heights.push_back(p * (1 + 0.06 * std::sin(i * 37.)));
    pdf.x.push_back(x);
    pdf.y.push_back(p);
    band.x.push_back(x);
    band.low.push_back(p - 0.08 * std::sqrt(p));
    band.high.push_back(p + 0.08 * std::sqrt(p));
  }
  plot.marks = {bars, band, pdf, Rule{0.2, "4 σ", true}};
  return plot;
}

TEST(Svg, is_well_formed_whatever_is_plotted) {
  EXPECT_EQ(xml_fault(svg(convergence_plot())), "");
  EXPECT_EQ(xml_fault(svg(probe_plots())), "");
  EXPECT_EQ(xml_fault(svg(histogram_plot())), "");
  EXPECT_EQ(xml_fault(svg(Plot{})), "");
  EXPECT_EQ(xml_fault(svg(std::vector<Plot>{})), "");
  Plot hostile{.title = "</text><script>", .x = {"a & b"}, .y = {"\"quoted\" \xff"}};
  hostile.marks = {Line{.name = "<i>", .x = {1}, .y = {2}}, Rule{1, "<b>"}, Shade{"&", {{0, 1}}}};
  EXPECT_EQ(xml_fault(svg(hostile)), "");
  EXPECT_THAT(svg(hostile), Not(HasSubstr("<script>")));
}

TEST(Svg, leaves_out_what_cannot_be_drawn) {
  for (const Scale scale : {Scale::linear, Scale::log, Scale::log2}) {
    Plot plot{.x = {"x", scale}, .y = {"y", scale}};
    const std::vector<double> odd = {nan, infinity, -infinity, 0, -1, 1e308, 1e-308, 2, 3};
    plot.marks = {
        Line{.name = "line", .x = odd, .y = odd, .error = odd},
        Bars{.name = "bars", .edges = {1, 2, nan, 3, 4}, .heights = {1, nan, 0, infinity}},
        Band{.name = "band", .x = odd, .low = odd, .high = odd},
        Rule{nan, "rule"},
        Rule{-1, "rule", true},
        Shade{"shade", {{nan, 1}, {0, infinity}}}};
    const std::string out = svg(plot);
    EXPECT_EQ(xml_fault(out), "");
    EXPECT_THAT(out, Not(HasSubstr("nan")));
    EXPECT_THAT(out, Not(HasSubstr("inf")));
  }
}

TEST(Svg, interrupts_a_line_at_a_gap) {
  const auto path_of = [](std::vector<double> y) {
    return svg(Plot{.marks = {Line{.x = {1, 2, 3, 4, 5}, .y = std::move(y), .markers = false}}});
  };
  const auto starts = [](const std::string& out) {  // of the line's path: it alone is 2 wide
    const std::size_t end = out.find("\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\"");
    const std::size_t begin = out.rfind("d=\"", end);
    return count(out.substr(begin, end - begin), "M");
  };
  EXPECT_EQ(starts(path_of({1, 2, 3, 2, 1})), 1u);
  EXPECT_EQ(starts(path_of({1, 2, nan, 2, 1})), 2u);
}

TEST(Svg, puts_points_where_they_belong) {
  // A plot area of known size: the left edge and the top are read off the inner svg.
  Plot plot{.x = {.low = 0, .high = 4}, .y = {.scale = Scale::log, .low = 0.01, .high = 100}};
  plot.marks = {Line{.x = {1}, .y = {0.1}}};
  const std::string out = svg(plot);
  const auto value = [&](const std::string& key, std::size_t from) {
    const std::size_t at = out.find(key, from) + key.size();
    return std::stod(out.substr(at));
  };
  const std::size_t inner = out.find("<svg x=");
  const double width = value("width=\"", inner), height = value("height=\"", inner);
  const std::size_t place = out.find("translate(", inner);
  EXPECT_NEAR(value("translate(", inner), width / 4, 0.01);
  EXPECT_NEAR(value(",", place), height * 3 / 4, 0.01);
}

TEST(Svg, gives_colours_in_order_and_keeps_those_asked_for) {
  const std::vector<double> v = {1, 2};
  Plot plot{.marks = {Shade{"lit", {{1, 2}}}, Line{.name = "a", .x = v, .y = v},
                      Line{.name = "b", .x = v, .y = v, .colour = 4},
                      Line{.name = "c", .x = v, .y = v}}};
  const std::string out = svg(plot);
  EXPECT_EQ(count(out, "<g class=\"c0\""), 2u);  // in the legend and in the plot
  EXPECT_EQ(count(out, "<g class=\"c1\""), 2u);
  EXPECT_EQ(count(out, "<g class=\"c2\""), 0u);
  EXPECT_EQ(count(out, "<g class=\"c4\""), 2u);
}

TEST(Svg, refuses_lists_that_do_not_fit_together) {
  EXPECT_THROW(svg(Plot{.marks = {Line{.x = {1, 2}, .y = {1}}}}), Error);
  EXPECT_THROW(svg(Plot{.marks = {Line{.x = {1}, .y = {1}, .error = {1, 2}}}}), Error);
  EXPECT_THROW(svg(Plot{.marks = {Bars{.edges = {1, 2}, .heights = {1, 2}}}}), Error);
  EXPECT_THROW(svg(Plot{.marks = {Band{.x = {1, 2}, .low = {1, 2}, .high = {1}}}}), Error);
  EXPECT_THROW(svg(Plot{.x = {.low = 2, .high = 1}}), Error);
}

TEST(Svg, shows_the_same_part_of_x_throughout_a_stack) {
  std::vector<Plot> plots = probe_plots();
  plots.insert(plots.begin(), plots[0]);
  plots.front().y.label = "";              // a narrower margin,
  const Line far{.x = {12}, .y = {1e-9}};  // a longer axis
  plots.front().marks.push_back(far);
  const std::string out = svg(plots);
  EXPECT_EQ(count(out, ">12</text>"), 3u);
  std::set<std::string> frames, tints;
  for (std::size_t at = out.find("<svg x=\""); at != out.npos; at = out.find("<svg x=\"", at + 1)) {
    frames.insert(out.substr(at, out.find(" y=", at) - at));
    const std::size_t path = out.find("d=\"M", at);  // tints lie below all else
    tints.insert(out.substr(path, out.find(",", path) - path));
  }
  EXPECT_EQ(frames.size(), 1u);
  EXPECT_EQ(tints.size(), 1u);
}

// --- pages

TEST(Page, carries_its_pictures) {
  Page page("Title");
  page.figure({orange_png(), "An orange pixel"});
  const std::string out = page.html();
  // coreutils' base64 of the same bytes
  EXPECT_THAT(
      out,
      HasSubstr("src=\"data:image/png;base64,"
                "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mP4v4ABAARBAaDvn2CeAAAA"
                "AElFTkSuQmCC\""));
  EXPECT_THAT(out, HasSubstr("width=\"1\" height=\"1\""));
  EXPECT_THROW(page.figure({"GIF89a", "no"}), Error);
  EXPECT_THROW(page.figure({"", "no"}), Error);
}

TEST(Page, shows_everything_it_can) {
  Page page("Single scattering in a box of fog: six estimators compared",
            "How far `sphere_in_fog` is from its closed form after 1 to 256 samples per pixel, for "
            "four seeds each.");
  page.heading("What is measured");
  page.paragraph(
      "The image is a, the reference is b, both in linear light. Means run over all pixels and "
      "channels. The spread is the "
      "standard deviation over the seeds; σ_{t} = 0.4 m^{−1}.");
  page.formulas(std::vector<Formula>{{"RMSE", "√(mean((a − b)²))", "W/(m² sr)"},
                                     {"relMSE", "mean((a − b)² / (b² + 0.01))", "no unit"},
                                     {"PSNR", "−10 log_{10}(mean((a − b)²))", "dB, peak 1"},
                                     {"MAE", "mean(|a − b|)", "W/(m² sr)"}});
  page.heading("Convergence");
  Table table{
      .caption =
          "Error at equal numbers of samples. The best of each number of samples is set in bold.",
      .columns = {{"estimator"},
                  {"spp"},
                  {"time", "s", Best::lowest, 3},
                  {"RMSE", "W/(m² sr)", Best::lowest},
                  {"relMSE", "", Best::lowest},
                  {"PSNR", "dB", Best::highest}},
      .group_by = 1};
  const char* names[] = {"rm", "mcds", "mcwvds", "rees", "reds", "rewv"};
  for (const int spp : {1, 4, 16})
    for (int i = 0; i < 6; ++i) {
      const double rmse = 0.05 / std::sqrt(double(spp)) / (1 + i % 4);
      table.rows.push_back({names[i],
                            spp,
                            {0.0031 * spp * (1 + 0.1 * i), 0.0001},
                            {rmse, rmse * 0.01},
                            {rmse * rmse, rmse * rmse * 0.02},
                            {-20 * std::log10(rmse), 0.087}});
    }
  page.table(table);
  page.figure({svg(convergence_plot()),
               "Error over samples, log-log; bars show the spread over four seeds."});
  Plot seconds = convergence_plot();
  seconds.title = "Error over time";
  seconds.x = {"seconds", Scale::log};
  for (Mark& mark : seconds.marks)
    for (double& x : std::get<Line>(mark).x) x *= 0.0031;
  page.figures(std::vector<Figure>{{svg(convergence_plot()), "Over samples"},
                                   {svg(seconds), "Over seconds"}},
               2, "The same error twice.");
  page.heading("Along one ray");
  page.figure({svg(probe_plots()), "Transmittance and pdf; yellow where the ray is lit."});
  page.figure({svg(histogram_plot()), "A histogram against its density, chi-squared p = 0.43."});
  page.heading("Pictures");
  page.figures(std::vector<Figure>(6, {orange_png(), "`rewv`, 4 spp"}), 3,
               "Every estimator at 4 spp.");
  page.heading("Against the paper");
  page.checks(rows, "Values of the paper and ours.");

  const std::string out =
      page.html("airlight 0.1.0 · `airlight compare scenes/sphere_in_fog.toml`");
  const auto path = std::filesystem::path(::testing::TempDir()) / "airlight_page.html";
  write_text(path, out);
  EXPECT_EQ(count(out, "<svg xmlns"), 5u);
  EXPECT_EQ(count(out, "<img"), 6u);
  EXPECT_THAT(out, HasSubstr("<b>Table 2.</b> Values"));
  EXPECT_THAT(out, HasSubstr("<b>Figure 5.</b>"));
  EXPECT_THAT(out, HasSubstr("10 log<sub>10</sub>"));
}

TEST(Page, fetches_nothing_and_runs_nothing) {
  Page page("<script>alert(1)</script>", "<img src=x>");
  page.heading("<h>");
  page.paragraph("<p>");
  page.formulas(std::vector<Formula>{{"<a>", "a < b", "&"}});
  page.table(convergence());
  page.checks(rows, "<c>");
  page.figures(std::vector<Figure>{{svg(Plot{}), "<f>"}}, 2, "<g>");
  const std::string out = page.html("<footer>");
  for (const char* word : {"<script", "<img", "<link", "@import", "url(", "javascript", "href"})
    EXPECT_THAT(out, Not(HasSubstr(word)));
  EXPECT_EQ(count(out, "http"), 1u);  // the name of SVG's namespace, which nobody fetches
  const std::size_t body = out.find("<body>"), end = out.find("</html>");
  EXPECT_EQ(xml_fault(std::string_view(out).substr(body, end - body)), "");
}

}  // namespace
}  // namespace airlight
