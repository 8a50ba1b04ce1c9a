#include "meshes/shaft_layout/shaft_checks.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "meshes/shaft_layout/bore_checks.h"
#include "meshes/shaft_layout/shaft_layout.h"
#include "meshes/values/constants.h"
#include "meshes/values/refusal.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

// Largest fillets as shares of the length of the segment that carries them: one beside a shoulder down at the
// other end (whose fan takes up to 30 %), one of a groove or beside a free end, both of a groove together.
const double largest_fillet_share = 0.6;
const double largest_groove_share = 0.9;
const double largest_fillets_share = 0.95;
const double smallest_zone_share = 0.1;  // loaded zone of a port, of its segment
const double largest_shift_slope = 0.9;  // eccentricity over the thickness of the ring that is shifted

void check_names(const Shaft& shaft) {
  std::set<std::string> names;
  for (const ShaftSegment& segment : shaft.segments) {
    const std::string& name = segment.name;
    if (name.empty()) refuse("a segment from " + mm(segment.begin_m) + " has no name; give it one");
    if (name.find_first_of("\"\n\r") != std::string::npos || name.size() > 100)
      refuse("segment name '" + name +
             "' holds quotes or line breaks or is longer than 100 characters; rename it");
    if (name == "end_1" || name == "end_2")
      refuse("segment name '" + name + "' is kept for the end face; rename the segment");
    if (!names.insert(name).second) refuse("two segments are called '" + name + "'; names must be unique");
  }
}

void check_sizes(const ShaftSegment& segment) {
  const std::string who = "segment " + segment.name + ": ";
  if (!std::isfinite(segment.begin_m) || !std::isfinite(segment.end_m) || !(segment.end_m > segment.begin_m))
    refuse(who + "runs from " + mm(segment.begin_m) + " to " + mm(segment.end_m) +
           "; its end must lie beyond its begin");
  if (!std::isfinite(segment.diameter_m) || !(segment.diameter_m > 0))
    refuse(who + "diameter " + mm(segment.diameter_m) + " must be positive");
  if (!std::isfinite(segment.eccentricity_m))
    refuse(who + "eccentricity " + mm(segment.eccentricity_m) + " must be a number");
  if (!std::isfinite(segment.eccentricity_angle_rad))
    refuse(who + "eccentricity_angle_rad = " + std::to_string(segment.eccentricity_angle_rad) +
           " must be a number");
}

void check_chain(const Shaft& shaft) {
  if (shaft.segments.empty()) refuse("has no segments; give at least one");
  if (shaft.fillets_m.size() + 1 != shaft.segments.size())
    refuse(std::to_string(shaft.segments.size()) + " segments need " +
           std::to_string(shaft.segments.size() - 1) +
           " fillets, one per shoulder, 0 for a sharp one; there are " +
           std::to_string(shaft.fillets_m.size()));
  const double scale_m = shaft.segments.back().end_m - shaft.segments.front().begin_m;
  for (std::size_t i = 0; i + 1 < shaft.segments.size(); ++i) {
    const ShaftSegment& left = shaft.segments[i];
    const ShaftSegment& right = shaft.segments[i + 1];
    const double gap_m = right.begin_m - left.end_m;
    if (std::abs(gap_m) > tiny * std::abs(scale_m))
      refuse(std::string(gap_m > 0 ? "a gap" : "an overlap") + " of " + mm(std::abs(gap_m)) + " between " +
             left.name + " (ends at " + mm(left.end_m) + ") and " + right.name + " (begins at " +
             mm(right.begin_m) + "); segments must meet");
  }
}

/// Fillets against their steps; where a neighbour is eccentric, the step is smallest on its low side.
void check_shoulder(const ShaftSegment& left, const ShaftSegment& right, double fillet_m) {
  const std::string where = "between " + left.name + " and " + right.name;
  if (!std::isfinite(fillet_m) || fillet_m < 0)
    refuse("fillet " + where + ": radius " + mm(fillet_m) + " must be positive, or 0 for a sharp shoulder");
  const ShaftSegment& small = left.diameter_m < right.diameter_m ? left : right;
  const ShaftSegment& big = left.diameter_m < right.diameter_m ? right : left;
  if (small.eccentricity_m != 0 || (big.eccentricity_m != 0 && small.diameter_m == big.diameter_m))
    refuse("segment " + (small.eccentricity_m != 0 ? small : big).name + " is eccentric by " +
           mm(small.eccentricity_m != 0 ? small.eccentricity_m : big.eccentricity_m) +
           " and not thicker than its neighbour " + where +
           "; an eccentric segment must be thicker than both neighbours");
  const double step_m = 0.5 * (big.diameter_m - small.diameter_m);
  if (big.eccentricity_m == 0) {
    if (fillet_m > step_m + tiny * big.diameter_m)
      refuse("fillet " + where + ": radius " + mm(fillet_m) + " is larger than the step of " + mm(step_m) +
             " from diameter " + mm(small.diameter_m) + " to " + mm(big.diameter_m) + "; make it smaller");
    return;
  }
  const double low_m = step_m - std::abs(big.eccentricity_m);
  const std::string disc = "diameter " + mm(big.diameter_m) + " eccentric by " + mm(big.eccentricity_m);
  if (low_m <= tiny * big.diameter_m)
    refuse("eccentricity of " + big.name + ": the surface of " + small.name + ", diameter " +
           mm(small.diameter_m) + ", leaves the disc of " + disc +
           "; the eccentricity must be smaller than the step of " + mm(step_m));
  if (fillet_m >= low_m - tiny * big.diameter_m)
    refuse("fillet " + where + ": radius " + mm(fillet_m) + " must be smaller than " + mm(low_m) +
           ", the step on the low side of " + disc + " above diameter " + mm(small.diameter_m) +
           "; make it smaller");
}

/// Fillet that the segment carries on its own surface at junction i, where `neighbour` is the other segment.
double own_fillet(const ShaftSegment& segment, const ShaftSegment& neighbour, double fillet_m) {
  return neighbour.diameter_m > segment.diameter_m ? fillet_m : 0;
}

/// @param falls whether a neighbour is thinner: the fan of that shoulder needs room as well
void check_lengths(const ShaftSegment& segment, double fillet_begin_m, double fillet_end_m, bool falls) {
  const double length_m = segment.end_m - segment.begin_m;
  const double larger_m = std::max(fillet_begin_m, fillet_end_m), both_m = fillet_begin_m + fillet_end_m;
  const std::string who = "segment " + segment.name + ", " + mm(length_m) + " long, ";
  const double share = falls ? largest_fillet_share : largest_groove_share;
  const auto percent = [](double part) { return std::to_string(std::lround(100 * part)) + " %"; };
  if (larger_m > share * length_m * (1 + tiny) || both_m > largest_fillets_share * length_m * (1 + tiny))
    refuse(who + "carries fillets of " + mm(fillet_begin_m) + " and " + mm(fillet_end_m) +
           " at its ends; one may take " + percent(share) + " of the length" +
           (falls ? ", since a neighbour is thinner" : ", both together " + percent(largest_fillets_share)) +
           ": make them smaller or the segment longer");
  if (segment.is_port && length_m - 2 * larger_m < smallest_zone_share * length_m)
    refuse(who + "is a port, but its fillet of " + mm(larger_m) +
           " taken off both ends leaves a loaded zone of " + mm(length_m - 2 * larger_m) +
           "; make the segment longer or the fillet smaller");
}

/// The ring between the neighbours' fillets and the surface takes up the whole eccentricity.
void check_shift(const ShaftSegment& segment, double inner_radius_m) {
  const double ring_m = 0.5 * segment.diameter_m - inner_radius_m;
  const double shift_m = std::abs(segment.eccentricity_m);
  if (shift_m > largest_shift_slope * ring_m)
    refuse("eccentricity of " + segment.name + ": " + mm(segment.eccentricity_m) + " is more than " +
           std::to_string(static_cast<int>(100 * largest_shift_slope)) + " % of " + mm(ring_m) +
           ", the ring from radius " + mm(inner_radius_m) +
           " (inside it nothing is shifted) to its surface; the cells there would be flat: make the "
           "eccentricity or "
           "the neighbours' fillets smaller, or the segment thicker");
}

}  // namespace

void check_control(const ShaftMeshControl& control) {
  const auto refuse_control = [](const std::string& what) { throw GeometryRefused("mesh control: " + what); };
  if (control.cells_per_fillet_quarter < 2 || control.cells_per_fillet_quarter % 2 != 0)
    refuse_control("cells_per_fillet_quarter = " + std::to_string(control.cells_per_fillet_quarter) +
                   " must be even and at least 2");
  for (const int cells : control.fillet_cells)
    if (cells != 0 && (cells < 2 || cells % 2 != 0))
      refuse_control("fillet_cells has " + std::to_string(cells) +
                     ", which must be even and at least 2, or 0");
  if (control.n_sectors < 8 || control.n_sectors % 4 != 0)
    refuse_control("n_sectors = " + std::to_string(control.n_sectors) +
                   " must be a multiple of 4 and at least 8");
  const int n = control.subdivisions;
  const auto can_be_cut = [&](int cells) { return cells % (2 * n) == 0; };
  if (n < 1) refuse_control("subdivisions = " + std::to_string(n) + " must be at least 1");
  if (!can_be_cut(control.cells_per_fillet_quarter) || control.n_sectors % (4 * n) != 0 ||
      !std::all_of(control.fillet_cells.begin(), control.fillet_cells.end(), can_be_cut))
    refuse_control("subdivisions = " + std::to_string(n) +
                   " must divide half of the cells of every fillet and a quarter of the sectors");
  if (!(control.growth > 0 && control.growth <= ShaftMeshControl::steepest_growth))
    refuse_control("growth = " + std::to_string(control.growth) + " must be positive, and at most " +
                   std::to_string(ShaftMeshControl::steepest_growth));
  if (!std::isfinite(control.largest_cell_m) || control.largest_cell_m < 0)
    refuse_control("largest_cell_m = " + std::to_string(control.largest_cell_m) + " must be positive, or 0");
  if (!std::isfinite(control.rows_factor) || control.rows_factor < 1)
    refuse_control("rows_factor = " + std::to_string(control.rows_factor) + " must be at least 1");
  if (!(control.min_scaled_jacobian > 0 && control.min_scaled_jacobian < 1))
    refuse_control("min_scaled_jacobian = " + std::to_string(control.min_scaled_jacobian) +
                   " must lie between 0 and 1");
}

void check_shaft(const Shaft& shaft) {
  check_names(shaft);
  for (const ShaftSegment& segment : shaft.segments) check_sizes(segment);
  check_chain(shaft);
  const auto n = shaft.segments.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    check_shoulder(shaft.segments[i], shaft.segments[i + 1], shaft.fillets_m[i]);
  check_bores(shaft);
  for (std::size_t i = 0; i < n; ++i) {
    const ShaftSegment& segment = shaft.segments[i];
    double inner_radius_m = n == 1 ? lone_inner_radius(segment) : 0;
    double fillet_begin_m = 0, fillet_end_m = 0;
    bool falls = false;
    if (i > 0) {
      fillet_begin_m = own_fillet(segment, shaft.segments[i - 1], shaft.fillets_m[i - 1]);
      inner_radius_m = 0.5 * shaft.segments[i - 1].diameter_m + shaft.fillets_m[i - 1];
      falls = shaft.segments[i - 1].diameter_m < segment.diameter_m;
    }
    if (i + 1 < n) {
      fillet_end_m = own_fillet(segment, shaft.segments[i + 1], shaft.fillets_m[i]);
      inner_radius_m = std::max(inner_radius_m, 0.5 * shaft.segments[i + 1].diameter_m + shaft.fillets_m[i]);
      falls = falls || shaft.segments[i + 1].diameter_m < segment.diameter_m;
    }
    check_lengths(segment, fillet_begin_m, fillet_end_m, falls);
    if (segment.eccentricity_m != 0) check_shift(segment, inner_radius_m);
  }
}

}  // namespace meshes
