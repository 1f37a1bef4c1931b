#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/check.h"
#include "report/table.h"

namespace airlight {

/// A quantity and how it is computed.
struct Formula {
  std::string name;
  std::string formula;
  std::string meaning = "";
};

/// A drawing or picture with words below it.
struct Figure {
  std::string content;  ///< SVG text, or the bytes of a PNG file: told apart by how they begin
  std::string caption = "";
};

/// One HTML page that carries everything it shows: style, plots and pictures are inside, nothing is
/// fetched and no script runs. Light or dark as the reader's system is. Things stand in the order
/// in which they are added; figures and tables are numbered.
///
/// Texts are plain, with three marks: `code` in backticks, x_{i} and x^{2} for indices and powers.
class Page {
 public:
  /// The summary stands below the title: what the page shows, in a sentence or two.
  explicit Page(std::string title, std::string summary = "");

  void heading(std::string_view text);
  void subheading(std::string_view text);
  void paragraph(std::string_view text);
  void formulas(std::span<const Formula> formulas);
  void table(const Table& table);

  /// The numbers of a paper beside ours.
  void checks(std::span<const Row> rows, const std::string& caption = "");

  /// Throws Error if the content is neither SVG nor PNG.
  void figure(const Figure& figure);

  /// Figures side by side in `columns` columns (fewer on a narrow screen), numbered as one, with a
  /// caption for all of them and their own below each.
  void figures(std::span<const Figure> figures, int columns, std::string_view caption = "");

  /// The whole page as a UTF-8 document. `footer` says what made it.
  std::string html(std::string_view footer = "") const;

 private:
  std::string title_, summary_, body_;
  int figure_count_ = 0, table_count_ = 0;
};

}  // namespace airlight
