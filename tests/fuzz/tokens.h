/// Where numbers and words stand in a text of no grammar in particular.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fuzz {

struct Span {
  std::size_t begin = 0, length = 0;
};

/// Without the sign. Digits inside words are none: the 1 of "bearing_1".
/// @param comment  the character that begins a comment to the end of the line, whose numbers are left out; 0:
/// none
std::vector<Span> numbers_of(const std::string& text, char comment = 0);

/// Letters, digits, underlines and points in a row.
std::vector<Span> words_of(const std::string& text);

/// "#12" where a comma or parenthesis follows: references in STEP files.
std::vector<Span> references_of(const std::string& text);

/// Each with the line feed at its end, if there is one.
std::vector<Span> lines_of(const std::string& text);

}  // namespace fuzz
