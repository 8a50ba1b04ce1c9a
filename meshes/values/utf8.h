/// Whether bytes are text.
#pragma once

#include <cstddef>
#include <string_view>

namespace meshes {

/// RFC 3629: no bytes astray, nothing longer than needed, no surrogates, nothing beyond U+10FFFF. What names
/// something must be such text: results are written as UTF-8.
inline bool is_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  for (std::size_t i = 0; i < text.size();) {
    const unsigned first = byte(i), second = byte(i + 1);
    const std::size_t n = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    if (n == 0 || first > 0xF4) return false;
    for (std::size_t k = 1; k < n; ++k)
      if ((byte(i + k) & 0xC0) != 0x80) return false;
    const bool out_of_range = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                              (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
    if (out_of_range) return false;
    i += n;
  }
  return true;
}

}  // namespace meshes
