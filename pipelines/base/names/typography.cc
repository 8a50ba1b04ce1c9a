#include "pipelines/base/names/typography.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace pipelines {
namespace {

void replace_all(std::string& text, const std::string& plain, const std::string& sign) {
  for (auto at = text.find(plain); at != std::string::npos; at = text.find(plain, at + sign.size()))
    text.replace(at, plain.size(), sign);
}

}  // namespace

std::string typographic(std::string text) {
  replace_all(text, " +- ", " \u00b1 ");
  replace_all(text, " mm3", " mm\u00b3");
  replace_all(text, " kg m2", " kg m\u00b2");
  return text;
}

bool stdout_shows_utf8() {
  if (isatty(STDOUT_FILENO) != 1) return false;
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"})
    if (const char* value = std::getenv(name); value != nullptr && *value != 0) {
      std::string locale = value;
      std::transform(locale.begin(), locale.end(), locale.begin(),
                     [](unsigned char letter) { return char(std::toupper(letter)); });
      return locale.find("UTF-8") != std::string::npos || locale.find("UTF8") != std::string::npos;
    }
  return false;
}

}  // namespace pipelines
