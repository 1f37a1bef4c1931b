#pragma once
#include <string>
#include <string_view>

namespace airlight {

/// Text as it may stand in XML and HTML, attributes included: & < > " ' replaced, control
/// characters that XML forbids dropped, bytes that are not UTF-8 replaced by U+FFFD.
std::string escape(std::string_view text);

/// As `escape`, with three marks for HTML: `code` in backticks, x_{i} and x^{2} for indices and
/// powers. A mark that is opened and not closed is plain text.
std::string rich(std::string_view text);

/// How many characters a reader sees (code points of UTF-8).
std::size_t length(std::string_view text);

/// An integer in superscript digits: −12 gives "⁻¹²".
std::string superscript(int number);

/// A number for people: `digits` significant digits, whole numbers below 1e7 as they are, very
/// small and very large ones as "1.234 × 10⁻⁵". NaN gives "–", infinity "∞".
std::string number(double value, int digits = 4);

/// A number and how far it strays, the spread to two digits and the value to as many places:
/// "0.01234 ± 0.00056", "(1.234 ± 0.056) × 10⁻⁵". A spread of NaN is left out.
std::string number(double value, double spread, int digits);

}  // namespace airlight
