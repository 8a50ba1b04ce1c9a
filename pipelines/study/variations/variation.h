/// A key of a scene that a sweep varies, and the values that it takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pipelines {

/// Values from `first` to `last`, in the variation's unit.
struct ValueRange {
  double first = 0, last = 0;
  bool is_logarithmic = false;  ///< equal ratios instead of equal steps; both ends are positive
};

struct Variation {
  /// As in --set: dotted, items of arrays counted from 1. Several that take one value stand behind one
  /// another, with commas.
  std::string key;
  /// As in --set; "kept": as the scene has it. Empty: a range without number.
  std::vector<std::string> values;
  std::vector<double> numbers;  ///< the values, in `unit`; empty: they are no numbers of one unit
  std::string unit;             ///< as written; empty: none
  std::optional<ValueRange> range;

  /// Each key by itself.
  std::vector<std::string> keys() const;
  /// For titles: "shaft.contour[1].diameter and 4 more".
  std::string short_key() const;
  bool is_numeric() const { return range || !numbers.empty(); }
  /// The text of --set for a number of the variation's unit.
  std::string text_of(double number) const;
};

/// The value that leaves a key as the scene has it.
inline constexpr const char* kept_value = "kept";

/// Reads "KEY = VALUES", or "KEY, KEY = VALUES" for keys that take one value. VALUES are
///   A..B UNIT / N      N values at equal steps, both ends included
///   A..B UNIT / N log  at equal ratios
///   A..B UNIT          a range that a Latin hypercube draws from
///   V, V, V UNIT       single values; a unit behind the last number is that of all. Brackets around them may
///                      stand: [V, V]. A value is what --set takes: a text, a number, on, off, removed; or
///                      kept
/// @throws OptionError naming what is wrong and what to write
Variation parse_variation(const std::string& text);

}  // namespace pipelines
