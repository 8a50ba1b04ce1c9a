/// Figures and keys in words, for charts.
#pragma once

#include <string>

namespace pipelines {

/// A figure in words: "R_A, largest", "shaft: governing stress"; of an unknown form as it is.
std::string figure_in_words(const std::string& figure);
/// A key of the scene in words: "carrier initial angle".
std::string key_in_words(const std::string& key);

}  // namespace pipelines
