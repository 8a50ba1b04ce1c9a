/// Quantities with units, converted once: text from a scene in, SI numbers out.
///
/// The unit database is udunits2, with "deg", "rev", "Nm" and "Nmm" added. Dimensions are compared strictly:
/// udunits itself takes the radian as 1 and a unit as convertible into its reciprocal, both are refused here.
/// Angular speeds: "1450 rpm", "24.2 Hz" and "151.8 rad/s" are understood; hertz (with any prefix) counts
/// turns per second and is multiplied by 2 pi. "24.2 1/s", "1450 min-1" do not say whether they count turns
/// or radians: refused.
#pragma once

#include <stdexcept>
#include <string>

namespace pipelines {

/// A quantity that cannot be understood; what() is a sentence that says what to write instead.
class UnitError : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

/// Converts "<number> <unit>".
/// @param quantity  e.g. "8.5 kN/mm", "40 deg", "2 %", "4.5 t/m3"; decimal point, no thousands separators
/// @param si_unit   the unit wanted, e.g. "N/m", "rad", "1", "kg/m3", "rad/s"
/// @return the value in si_unit, finite
/// @throws UnitError for a missing or malformed number, nan and inf, a missing or unknown unit, another
/// dimension
/// @throws FileError if the unit database of udunits2 is not installed
double to_si(const std::string& quantity, const std::string& si_unit);

/// Whether a text is a unit, of whatever quantity.
/// @throws FileError as to_si
bool is_unit(const std::string& text);

/// A ratio of two whole numbers, e.g. "-1/20", "3 / 4" or "2"; the sign belongs to the numerator.
/// @throws UnitError if it is none, or the denominator is 0
double parse_ratio(const std::string& text);

}  // namespace pipelines
