#include "pipelines/base/files/text_encoding.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <optional>
#include <utility>

#include "meshes/values/utf8.h"

namespace pipelines {
namespace {

using namespace std::string_view_literals;

void append_utf8(std::string& text, std::uint32_t c) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (c < 0x80) return add(c);
  if (c < 0x800) {
    add(0xC0 | c >> 6);
  } else {
    if (c < 0x10000) {
      add(0xE0 | c >> 12);
    } else {
      add(0xF0 | c >> 18);
      add(0x80 | (c >> 12 & 0x3F));
    }
    add(0x80 | (c >> 6 & 0x3F));
  }
  add(0x80 | (c & 0x3F));
}

/// Text of UTF-16 bytes; none where a surrogate stands alone or the last unit is half (RFC 2781, section
/// 2.2).
std::optional<std::string> from_utf16(std::string_view bytes, bool little_endian) {
  if (bytes.size() % 2 != 0) return std::nullopt;
  const auto unit = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(bytes[i]),
               second = static_cast<unsigned char>(bytes[i + 1]);
    return std::uint32_t(little_endian ? first | second << 8 : first << 8 | second);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    std::uint32_t c = unit(i);
    if (c >= 0xDC00 && c < 0xE000) return std::nullopt;
    if (c >= 0xD800 && c < 0xDC00) {
      const std::uint32_t low = i + 3 < bytes.size() ? unit(i + 2) : 0;
      if (low < 0xDC00 || low >= 0xE000) return std::nullopt;
      c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
      i += 2;
    }
    append_utf8(text, c);
  }
  return text;
}

/// Text of Windows-1252 bytes; none where a byte has no character. Source: the table CP1252.TXT of the
/// Unicode consortium, 0x80 to 0x9F; all others are those of Latin-1.
std::optional<std::string> from_windows_1252(std::string_view bytes) {
  constexpr std::uint16_t upper[32] = {0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                       0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
                                       0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                       0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 16);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const std::uint32_t character = byte >= 0x80 && byte < 0xA0 ? upper[byte - 0x80] : byte;
    if (character == 0 && byte != 0) return std::nullopt;
    append_utf8(text, character);
  }
  return text;
}

/// A file of another kind, by its first bytes; empty: none that is known.
std::string known_format(std::string_view bytes) {
  constexpr std::pair<std::string_view, std::string_view> formats[] = {
      {"PK\x03\x04"sv, "a workbook of Excel or LibreOffice, or another ZIP file"},
      {"\xD0\xCF\x11\xE0"sv, "a workbook of an old Excel"},
      {"TDSm"sv, "a TDMS file of LabVIEW"},
      {"MDF "sv, "an MDF measurement file"},
      {"MATLAB 5.0"sv, "a MAT file of MATLAB"},
      {"\x89HDF"sv, "an HDF5 file"},
      {"\x1F\x8B"sv, "a compressed file (gzip)"},
      {"%PDF"sv, "a PDF file"},
      {"{\\rtf"sv, "a document (RTF)"}};
  const auto found = std::find_if(std::begin(formats), std::end(formats), [&](const auto& format) {
    return bytes.substr(0, format.first.size()) == format.first;
  });
  return found == std::end(formats) ? "" : std::string(found->second);
}

DecodedText refused(std::string why) {
  return {"", "", std::move(why)};
}

}  // namespace

std::string wide_encoding_of(std::string_view bytes) {
  const auto begins = [&](std::string_view mark) { return bytes.substr(0, mark.size()) == mark; };
  if (begins("\xFF\xFE\0\0"sv)) return "UTF-32 LE";
  if (begins("\0\0\xFE\xFF"sv)) return "UTF-32 BE";
  if (begins("\xFF\xFE"sv)) return "UTF-16 LE";
  if (begins("\xFE\xFF"sv)) return "UTF-16 BE";
  constexpr std::size_t looked_at = 2000;
  const std::size_t n_pairs = std::min(bytes.size(), looked_at) / 2;
  if (n_pairs < 2) return "";
  std::size_t zeros[2] = {0, 0};
  for (std::size_t i = 0; i < 2 * n_pairs; ++i) zeros[i % 2] += bytes[i] == '\0' ? 1 : 0;
  if (zeros[0] == 0 && 4 * zeros[1] >= 3 * n_pairs) return "UTF-16 LE";
  if (zeros[1] == 0 && 4 * zeros[0] >= 3 * n_pairs) return "UTF-16 BE";
  return "";
}

DecodedText decode_text(std::string bytes) {
  if (const auto format = known_format(bytes); !format.empty())
    return refused("is " + format + ", no text; export the samples as CSV");
  DecodedText decoded;
  if (const auto wide = wide_encoding_of(bytes); !wide.empty()) {
    if (wide.rfind("UTF-32", 0) == 0) return refused("is written in " + wide + "; save it as UTF-8");
    const bool has_mark = bytes[0] == '\xFF' || bytes[0] == '\xFE';
    auto text = from_utf16(std::string_view(bytes).substr(has_mark ? 2 : 0), wide == "UTF-16 LE");
    if (!text) return refused("begins like " + wide + " and goes on as something else; save it as UTF-8");
    decoded = {std::move(*text), wide, ""};
  } else if (meshes::is_utf8(bytes)) {
    if (bytes.rfind("\xEF\xBB\xBF", 0) == 0) bytes.erase(0, 3);
    decoded = {std::move(bytes), "UTF-8", ""};
  } else {
    auto text = from_windows_1252(bytes);
    if (!text)
      return refused(
          "is written neither in UTF-8 nor in UTF-16 nor in Windows-1252 (Latin-1); save it as UTF-8");
    decoded = {std::move(*text), "Windows-1252", ""};
  }
  if (decoded.text.find('\0') != std::string::npos)
    return refused("has bytes that are zero, which no text has; export the samples as CSV in UTF-8");
  return decoded;
}

}  // namespace pipelines
