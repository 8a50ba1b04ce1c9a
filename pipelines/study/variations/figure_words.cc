#include "pipelines/study/variations/figure_words.h"

#include <map>

namespace pipelines {
namespace {

/// With blanks for underscores, and points replaced.
std::string spaced(const std::string& name, const std::string& point) {
  std::string words;
  for (const char c : name) c == '.' ? words += point : words += c == '_' ? ' ' : c;
  return words;
}

}  // namespace

std::string figure_in_words(const std::string& figure) {
  static const std::map<std::string, std::string> of_loads{{"max", "largest"},
                                                           {"min", "least"},
                                                           {"mean", "mean"},
                                                           {"rms", "rms"},
                                                           {"first", "at the first instant"}};
  const auto end = figure.rfind('.');
  if (const auto known = of_loads.find(figure.substr(end + 1));
      figure.rfind("loads.", 0) == 0 && known != of_loads.end() && end > 5)
    return figure.substr(6, end - 6) + ", " + known->second;
  if (const auto body = figure.find('.', 7); figure.rfind("bodies.", 0) == 0 && body != std::string::npos) {
    auto rest = figure.substr(body + 1);
    if (rest.rfind("governing", 0) == 0) rest.insert(9, " stress");
    return figure.substr(7, body - 7) + ": " + spaced(rest, ", ");
  }
  return figure;
}

std::string key_in_words(const std::string& key) {
  return spaced(key.rfind("machine.", 0) == 0 ? key.substr(8) : key, " ");
}

}  // namespace pipelines
