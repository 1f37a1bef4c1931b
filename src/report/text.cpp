#include "report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace airlight {
namespace {

/// Bytes of the well-formed UTF-8 character that `text` starts with; 0 if it starts with none.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? (unsigned char)(text[i]) : 0u; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool overlong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xf0 && byte(1) < 0x90);
  const bool surrogate = lead == 0xed && byte(1) > 0x9f;
  const bool beyond = lead == 0xf4 && byte(1) > 0x8f;
  return overlong || surrogate || beyond ? 0 : size;
}

/// The power of ten of a number as it reads with so many significant digits: 9.996 at 3 digits is
/// 1e1.
int exponent(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, std::max(0, digits - 1));
  return std::stoi(text.substr(text.find('e') + 1));
}

bool is_plain(int exponent) { return exponent >= -3 && exponent < 5; }

std::string minus(std::string text) {  // a real minus sign
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t size = character(text);
    const char c = text[0];
    if (size == 0)
      out += "\uFFFD";
    else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else if (size > 1 || (unsigned char)c >= 0x20 || c == '\n' || c == '\t')
      out += text.substr(0, size);
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return out;
}

std::string rich(std::string_view text) {
  std::string out, plain;
  while (!text.empty()) {
    const auto marked = [&](std::string_view open, std::string_view close, const char* tag) {
      if (!text.starts_with(open)) return false;
      const std::size_t end = text.find(close, open.size());
      if (end == text.npos) return false;
      const std::string_view inside = text.substr(open.size(), end - open.size());
      out += escape(plain) + fmt::format("<{0}>{1}</{0}>", tag, escape(inside));
      plain.clear();
      text.remove_prefix(end + close.size());
      return true;
    };
    if (marked("`", "`", "code") || marked("_{", "}", "sub") || marked("^{", "}", "sup")) continue;
    plain += text[0];
    text.remove_prefix(1);
  }
  return out + escape(plain);
}

std::size_t length(std::string_view text) {
  return std::size_t(std::count_if(text.begin(), text.end(),
                                   [](char c) { return ((unsigned char)c & 0xc0) != 0x80; }));
}

std::string superscript(int number) {
  static constexpr const char* digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : std::to_string(number)) out += c == '-' ? "⁻" : digit[c - '0'];
  return out;
}

std::string number(double value, int digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  if (value == std::round(value) && std::abs(value) < 1e7)
    return minus(fmt::format("{:.0f}", value + 0.));
  const int e = exponent(value, digits);
  if (is_plain(e)) return minus(fmt::format("{:.{}f}", value, std::max(0, digits - 1 - e)));
  const std::string text = fmt::format("{:.{}e}", value, std::max(0, digits - 1));
  return minus(text.substr(0, text.find('e'))) + " × 10" + superscript(e);
}

std::string number(double value, double spread, int digits) {
  if (!std::isfinite(value) || std::isnan(spread)) return number(value, digits);
  if (std::isinf(spread)) return number(value, digits) + " ± ∞";
  if (spread == 0) return number(value, digits) + " ± 0";
  const int e = value == 0 ? exponent(spread, 2) : exponent(value, digits);
  const int places = 1 - exponent(spread, 2);  // behind the point, for two digits of the spread
  const auto both = [&](double scale, int places) {
    places = std::clamp(places, 0, 9);
    return minus(fmt::format("{:.{}f}", value * scale, places)) +
           fmt::format(" ± {:.{}f}", spread * scale, places);
  };
  if (is_plain(e)) return both(1, places);
  return fmt::format("({}) × 10{}", both(std::pow(10., -e), places + e), superscript(e));
}

}  // namespace airlight
