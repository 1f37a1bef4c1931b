#pragma once
#include <string>
#include <string_view>

namespace airlight {

/// The parser of OBJ files reads words as zeros and does not look at indices. These read the text
/// again, strictly, to tell a user the line. `file` stands for it in the errors; positive indices
/// may point forwards, as parsers allow.

/// Makes the text what the parser understands, in place: lines of numbers and faces that go on in
/// the next after a backslash become one, followed by as many empty ones, so that lines count as
/// they did; names of materials and of their files keep their blanks, as `joint`.
void prepare_obj(std::string& text);

/// Throws Error at the first line `v`, `vn` or `vt` without its numbers. Fast: runs for every file.
void check_obj_numbers(std::string_view text, const std::string& file);

/// Throws Error at the first face with an index of nothing, or else at the first position that is
/// not finite in float.
void explain_broken_obj(std::string_view text, const std::string& file);

/// What to say of faces that have less than three vertices, which the parser drops.
std::string remark_on_thin_faces(std::string_view text, const std::string& file);

}  // namespace airlight
