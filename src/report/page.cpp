#include "report/page.h"

#include <fmt/format.h>

#include <cstdint>

#include "error.h"
#include "report/text.h"

namespace airlight {
namespace {

constexpr auto style = R"(
:root{color-scheme:light dark;--paper:#fff;--ink:#1c1c1c;--muted:#5c5c5c;--line:#d9d9d9;
  --soft:#f5f5f3;--good:#00714f;--bad:#b3261e}
@media (prefers-color-scheme:dark){:root{
  --paper:#15171a;--ink:#e6e6e3;--muted:#a3a3a0;--line:#3a3d42;--soft:#1e2125;--good:#4cc79b;
  --bad:#ff8a80;--plot-paper:#15171a;--plot-ink:#e6e6e3;--plot-muted:#b0b0ad;--plot-grid:#2b2e33;
  --plot-axis:#85858a;--plot-0:#4ba3db;--plot-1:#f2803c;--plot-2:#2fc79a;--plot-3:#e39ac4;
  --plot-4:#f2b740;--plot-5:#8fcdf2;--plot-6:#b8b8b8}}
*{box-sizing:border-box}
body{margin:0 auto;padding:3.5rem 1.5rem 2.5rem;max-width:66rem;background:var(--paper);
  color:var(--ink);
  font:17px/1.55 Charter,"Bitstream Charter","Source Serif 4",Georgia,"Times New Roman",serif}
h1{font-size:2rem;line-height:1.2;font-weight:600;margin:0 0 .6rem;text-wrap:balance}
h2{font-size:1.35rem;font-weight:600;line-height:1.3;margin:2.8rem 0 .6rem}
h3{font-size:1.08rem;font-weight:600;margin:1.9rem 0 .4rem}
p,dl{margin:.7rem 0;max-width:44rem}
.summary{font-size:1.1rem;color:var(--muted);margin-bottom:1.6rem}
code{font:.86em ui-monospace,SFMono-Regular,Menlo,Consolas,"DejaVu Sans Mono",monospace;
  background:var(--soft);padding:.08em .3em;border-radius:3px}
sub,sup{font-size:.72em;line-height:0}
table{border-collapse:collapse;border-top:1.5px solid var(--ink);
  border-bottom:1.5px solid var(--ink);
  font:14.5px/1.4 "Helvetica Neue",Helvetica,Arial,sans-serif;
  font-variant-numeric:tabular-nums lining-nums}
th,td{padding:.28rem .8rem;text-align:left;vertical-align:baseline}
th{font-weight:600;border-bottom:1px solid var(--ink);vertical-align:top}
.number{text-align:right;white-space:nowrap}
tbody+tbody tr:first-child td{border-top:1px solid var(--line)}
.unit{display:block;font-weight:400;font-size:.88em;color:var(--muted)}
.formulas{border:0}
.formulas td{padding:.22rem 1.4rem .22rem 0}
.formulas td:nth-child(1){font-weight:600;white-space:nowrap}
.formulas td:nth-child(2){
  font-family:"STIX Two Math","Cambria Math","Latin Modern Math",Georgia,serif;font-size:1.06em}
.formulas td:nth-child(3){color:var(--muted)}
.verdict{white-space:nowrap;color:var(--muted)}
.holds .verdict{color:var(--good)}
.fails td{font-weight:600}
.fails .verdict{color:var(--bad)}
figure{margin:1.6rem 0}
figure.table{overflow-x:auto}
figcaption{font-size:.92rem;line-height:1.45;color:var(--muted);margin-top:.55rem;max-width:50rem}
figure.table figcaption{margin:0 0 .55rem}
figcaption b{color:var(--ink);font-weight:600}
.beside{display:grid;gap:1.1rem;grid-template-columns:repeat(var(--columns),minmax(0,1fr))}
.beside figure{margin:0}
.beside figcaption{font-size:.86rem;margin-top:.3rem}
svg.airlight-plot{display:block;max-width:100%;height:auto}
img{display:block;max-width:100%;height:auto;background:#000}
.beside img,.beside svg.airlight-plot{width:100%}
img.small{image-rendering:pixelated}
footer{margin-top:3.5rem;padding-top:.8rem;border-top:1px solid var(--line);font-size:.86rem;
  color:var(--muted)}
@media (max-width:40rem){body{padding-top:1.5rem}
  .beside{grid-template-columns:repeat(min(2,var(--columns)),minmax(0,1fr))}
  .beside:has(svg){grid-template-columns:1fr}}
@media print{body{max-width:none;padding:0}figure,tr{break-inside:avoid}}
)";

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  static constexpr auto digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? std::uint32_t((unsigned char)bytes[i + k]) : 0u;
    };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int k = 0; k < 4; ++k)
      out += i + std::size_t(k) > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return out;
}

/// A big-endian 32 bit number of a PNG header.
std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < 4; ++i) v = v << 8 | (unsigned char)bytes[at + i];
  return v;
}

std::string picture(const Figure& figure) {
  const std::string_view content = figure.content;
  if (content.starts_with("<svg")) return figure.content;
  if (!content.starts_with(png_signature) || content.size() < 33)
    throw Error(
        fmt::format("figure \"{}\": neither SVG nor PNG; a figure is one of them", figure.caption));
  const std::uint32_t width = word(content, 16), height = word(content, 20);
  return fmt::format(
      "<img{} width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">\n",
      width <= 256 ? " class=\"small\"" : "", width, height, escape(figure.caption),
      base64(content));
}

std::string caption(std::string_view label, int number, std::string_view text) {
  return fmt::format("<figcaption><b>{} {}.</b> {}</figcaption>\n", label, number, rich(text));
}

}  // namespace

Page::Page(std::string title, std::string summary)
    : title_(std::move(title)), summary_(std::move(summary)) {}

void Page::heading(std::string_view text) { body_ += "<h2>" + rich(text) + "</h2>\n"; }
void Page::subheading(std::string_view text) { body_ += "<h3>" + rich(text) + "</h3>\n"; }
void Page::paragraph(std::string_view text) { body_ += "<p>" + rich(text) + "</p>\n"; }

void Page::formulas(std::span<const Formula> formulas) {
  body_ += "<table class=\"formulas\">\n";
  for (const Formula& f : formulas)
    body_ += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", rich(f.name),
                         rich(f.formula), rich(f.meaning));
  body_ += "</table>\n";
}

void Page::table(const Table& table) {
  const std::string content = airlight::html(table);
  body_ += "<figure class=\"table\">\n" + caption("Table", ++table_count_, table.caption) +
           content + "</figure>\n";
}

void Page::checks(std::span<const Row> rows, const std::string& text) {
  body_ += "<figure class=\"table\">\n" + caption("Table", ++table_count_, text) +
           airlight::html(rows) + "</figure>\n";
}

void Page::figure(const Figure& figure) {
  const std::string content = picture(figure);
  body_ +=
      "<figure>\n" + content + caption("Figure", ++figure_count_, figure.caption) + "</figure>\n";
}

void Page::figures(std::span<const Figure> figures, int columns, std::string_view text) {
  std::string out =
      fmt::format("<figure>\n<div class=\"beside\" style=\"--columns:{}\">\n", columns);
  for (const Figure& f : figures) {
    out += "<figure>" + picture(f);
    if (!f.caption.empty()) out += "<figcaption>" + rich(f.caption) + "</figcaption>";
    out += "</figure>\n";
  }
  body_ += out + "</div>\n" + caption("Figure", ++figure_count_, text) + "</figure>\n";
}

std::string Page::html(std::string_view footer) const {
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  out += fmt::format("<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n",
                     escape(title_), style, rich(title_));
  if (!summary_.empty()) out += "<p class=\"summary\">" + rich(summary_) + "</p>\n";
  out += body_;
  if (!footer.empty()) out += "<footer>" + rich(footer) + "</footer>\n";
  return out + "</body>\n</html>\n";
}

}  // namespace airlight
