#include "pipelines/base/names/odd_characters.h"

#include <algorithm>
#include <iterator>

namespace pipelines {
namespace {

struct OddKind {
  std::string_view bytes, name;
  enum { space, nothing, quote, apostrophe, minus } stands_for;
};

/// Unicode 15, blocks Latin-1 Supplement, General Punctuation and Mathematical Operators.
constexpr OddKind odd_kinds[] = {
    {"\xC2\xA0", "a no-break space (U+00A0)", OddKind::space},
    {"\xE2\x80\x87", "a figure space (U+2007)", OddKind::space},
    {"\xE2\x80\x89", "a thin space (U+2009)", OddKind::space},
    {"\xE2\x80\xAF", "a narrow no-break space (U+202F)", OddKind::space},
    {"\xE2\x80\x8B", "a space without width (U+200B)", OddKind::nothing},
    {"\xE2\x81\xA0", "a word joiner (U+2060)", OddKind::nothing},
    {"\xEF\xBB\xBF", "a byte order mark (U+FEFF)", OddKind::nothing},
    {"\xC2\xAD", "a soft hyphen (U+00AD)", OddKind::nothing},
    {"\xE2\x80\x9C", "a typographic quotation mark (U+201C)", OddKind::quote},
    {"\xE2\x80\x9D", "a typographic quotation mark (U+201D)", OddKind::quote},
    {"\xE2\x80\x9E", "a typographic quotation mark (U+201E)", OddKind::quote},
    {"\xE2\x80\x9F", "a typographic quotation mark (U+201F)", OddKind::quote},
    {"\xC2\xAB", "a typographic quotation mark (U+00AB)", OddKind::quote},
    {"\xC2\xBB", "a typographic quotation mark (U+00BB)", OddKind::quote},
    {"\xE2\x80\xB3", "a double prime (U+2033)", OddKind::quote},
    {"\xE2\x80\x98", "a typographic quotation mark (U+2018)", OddKind::apostrophe},
    {"\xE2\x80\x99", "a typographic quotation mark (U+2019)", OddKind::apostrophe},
    {"\xE2\x80\x9A", "a typographic quotation mark (U+201A)", OddKind::apostrophe},
    {"\xC2\xB4", "an acute accent (U+00B4)", OddKind::apostrophe},
    {"\xE2\x80\x90", "a typographic hyphen (U+2010)", OddKind::minus},
    {"\xE2\x80\x91", "a no-break hyphen (U+2011)", OddKind::minus},
    {"\xE2\x80\x93", "a dash (U+2013)", OddKind::minus},
    {"\xE2\x80\x94", "a dash (U+2014)", OddKind::minus},
    {"\xE2\x88\x92", "a minus sign of mathematics (U+2212)", OddKind::minus}};

std::string remedy_of(const OddKind& kind) {
  switch (kind.stands_for) {
    case OddKind::space:
      return "write an ordinary space";
    case OddKind::nothing:
      return "leave it out";
    case OddKind::quote:
      return "write the straight mark \"";
    case OddKind::apostrophe:
      return "write the straight mark '";
    case OddKind::minus:
      return "write the sign - of the keyboard";
  }
  return "";
}

}  // namespace

std::optional<OddCharacter> odd_character_in(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (static_cast<unsigned char>(text[i]) < 0x80) continue;
    const auto stands_here = [&](const OddKind& kind) {
      return text.substr(i, kind.bytes.size()) == kind.bytes;
    };
    const auto found = std::find_if(std::begin(odd_kinds), std::end(odd_kinds), stands_here);
    if (found != std::end(odd_kinds)) return OddCharacter{i, std::string(found->name), remedy_of(*found)};
  }
  return std::nullopt;
}

}  // namespace pipelines
