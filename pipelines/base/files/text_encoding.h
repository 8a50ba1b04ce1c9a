/// Texts that other programs wrote: as UTF-8, whatever they are written in, or named as what they are.
#pragma once

#include <string>
#include <string_view>

namespace pipelines {

struct DecodedText {
  std::string text;      ///< UTF-8, without byte order mark
  std::string encoding;  ///< "UTF-8", "UTF-16 LE", "UTF-16 BE" or "Windows-1252"; empty where it is no text
  std::string refusal;   ///< why it is no text, with the remedy; empty otherwise
};

/// Bytes that are no UTF-8 are taken for Windows-1252, of which Latin-1 is a part: no logger says which of
/// the encodings with one byte it uses, and titles and units look right in this one or plainly wrong.
DecodedText decode_text(std::string bytes);

/// "UTF-16 LE", "UTF-16 BE", "UTF-32 LE" or "UTF-32 BE" by the byte order mark or, without one, where every
/// second byte is zero; empty: none of them.
std::string wide_encoding_of(std::string_view bytes);

}  // namespace pipelines
