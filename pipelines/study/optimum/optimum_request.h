/// What an optimisation is asked for: a figure to be least or largest, keys with their ranges, bounds.
#pragma once

#include <string>
#include <vector>

#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/variation.h"

namespace pipelines {

/// A bound that is kept, "bodies.shaft.governing.safety >= 3.5".
struct KeptBound {
  std::string text;  ///< as given
  std::string figure;
  bool is_least = true;  ///< >=; else <=
  std::string quantity;  ///< the value with its unit, as given
};

struct OptimumRequest {
  std::string goal;  ///< figure
  bool maximises = false;
  std::vector<Variation> variations;  ///< ranges
  std::vector<KeptBound> bounds;
  int most_evaluations = 0;

  /// The goal and the figures of the bounds, each once.
  std::vector<std::string> figures() const;
};

/// Reads "FIGURE >= VALUE UNIT" or "FIGURE <= VALUE UNIT".
/// @throws OptionError naming what is wrong and what to write
KeptBound parse_bound(const std::string& text);

/// Reads "KEY = A..B UNIT", with several keys "KEY, KEY = A..B UNIT".
/// @throws OptionError likewise
Variation parse_range(const std::string& text);

/// The bound in the unit of its figure.
/// @param row  a row that has the figures
/// @throws OptionError if the row has no such figure, or its unit is of another quantity
double bound_in_si(const KeptBound& bound, const SweepRow& row);

/// @throws OptionError with the nearest name if the row has no such figure
/// @param option  that names it, for the message
void require_figure(const std::string& option, const std::string& figure, const SweepRow& row);

/// SI unit of a figure; empty if it has none.
std::string unit_of_figure(const SweepRow& row, const std::string& figure);

/// The error of a figure that a row states, with what no mesh lowers; 0 of figures without.
double stated_error(const SweepRow& row, const std::string& figure);

/// The figure with its error taken towards the bound: what surely holds. NaN if the row has no such figure.
double assured(const SweepRow& row, const KeptBound& bound);

/// How much is lacking to a bound: above 0 it is not kept. The logarithm of the ratio of bound and assured
/// value where both are positive, else their difference by the bound's size; cut at 3 to both sides.
double shortfall(const SweepRow& row, const KeptBound& bound, double bound_si);

}  // namespace pipelines
