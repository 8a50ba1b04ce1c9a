#include "tests/fuzz/tokens.h"

#include <algorithm>
#include <cctype>

namespace fuzz {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

std::size_t end_of_number(const std::string& text, std::size_t at) {
  for (; at < text.size(); ++at) {
    const bool sign_of_exponent =
        (text[at] == '-' || text[at] == '+') && (text[at - 1] == 'e' || text[at - 1] == 'E');
    if (!is_digit(text[at]) && text[at] != '.' && text[at] != 'e' && text[at] != 'E' && !sign_of_exponent)
      break;
  }
  return at;
}

}  // namespace

std::vector<Span> numbers_of(const std::string& text, char comment) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (comment != 0 && text[i] == comment) {
      i = std::min(text.size(), text.find('\n', i));
      continue;
    }
    if (!is_digit(text[i]) || (i > 0 && is_of_word(text[i - 1]))) continue;
    const auto end = end_of_number(text, i + 1);
    found.push_back({i, end - i});
    i = end;
  }
  return found;
}

std::vector<Span> words_of(const std::string& text) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_of_word(text[i])) continue;
    const auto begin = i;
    while (i < text.size() && is_of_word(text[i])) ++i;
    found.push_back({begin, i - begin});
  }
  return found;
}

std::vector<Span> references_of(const std::string& text) {
  std::vector<Span> found;
  for (auto at = text.find('#'); at != std::string::npos; at = text.find('#', at + 1)) {
    auto end = at + 1;
    while (end < text.size() && is_digit(text[end])) ++end;
    if (end > at + 1 && end < text.size() && (text[end] == ',' || text[end] == ')'))
      found.push_back({at, end - at});
  }
  return found;
}

std::vector<Span> lines_of(const std::string& text) {
  std::vector<Span> found;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.size() - 1, text.find('\n', begin)) + 1;
    found.push_back({begin, end - begin});
    begin = end;
  }
  return found;
}

}  // namespace fuzz
