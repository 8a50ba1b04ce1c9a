/// A case in which naive code fails: why, by how much, and what ours must do.
#pragma once

#include <optional>
#include <string>

namespace hard_cases {

/// Errors are relative to the reference; NaN or infinite: no number at all came out.
struct HardCase {
  std::string family;                 ///< the file it stands in: "kinetics", "drive trains" ...
  std::string name;                   ///< of the case
  std::string what_is_hard;           ///< why the usual way fails there
  std::string naive;                  ///< the textbook formula or naive code that was run
  std::optional<double> naive_error;  ///< none: nothing simpler is known
  double our_error = 0;
  double bound = 0;  ///< of our error; its reason stands beside the case
};

/// Expects our error within the bound and the naive one, if any, beyond it. Adds a row to the file that the
/// environment variable MILLSTRESS_HARD_ROWS names.
void check(const HardCase& tried);

/// |ours / reference - 1|, or |ours| where the reference is zero.
double relative(long double ours, long double reference);

}  // namespace hard_cases
