/// Characters that look like those of a keyboard and are others: word processors, web pages and PDF files put
/// them into what is copied from there.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pipelines {

struct OddCharacter {
  std::size_t byte = 0;  ///< where it begins
  std::string name;      ///< "a no-break space (U+00A0)"
  std::string remedy;    ///< "write an ordinary space"
};

/// The first one: spaces that are not U+0020, marks without width, typographic quotation marks, dashes and
/// the minus sign of mathematics.
/// @param text  UTF-8
std::optional<OddCharacter> odd_character_in(std::string_view text);

}  // namespace pipelines
