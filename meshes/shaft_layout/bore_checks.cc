#include "meshes/shaft_layout/bore_checks.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "meshes/values/constants.h"
#include "meshes/values/refusal.h"

namespace meshes {

namespace {

const double smallest_bore_share = 0.01;   // least bore, as a share of the diameter
const double smallest_wall_share = 0.01;   // least wall, as a share of the diameter
const double smallest_wall_fillets = 0.5;  // least wall under a fillet, in fillets

std::string bored(const ShaftSegment& segment) {
  return segment.name + (segment.bore_m > 0 ? " (bore " + mm(segment.bore_m) + ")" : " (solid)");
}

void check_port_names(const Shaft& shaft) {
  std::set<std::string> names = {"end_1", "end_2"};
  for (const ShaftSegment& segment : shaft.segments) names.insert(segment.name);
  for (const ShaftSegment& segment : shaft.segments)
    if (segment.bore_m > 0 && !names.insert("bore " + segment.name).second)
      refuse("a segment is called 'bore " + segment.name + "', the name of the bore of segment " +
             segment.name + "; rename one of them");
  for (const ShaftSegment& segment : shaft.segments) {
    const std::string& port = segment.bore_port;
    if (port.empty()) continue;
    if (port.find_first_of("\"\n\r") != std::string::npos || port.size() > 100)
      refuse("bore_port '" + port + "' of segment " + segment.name +
             " holds quotes or line breaks or is longer than 100 characters; rename it");
    if (segment.bore_m == 0)
      refuse("segment " + segment.name + " has the bore_port '" + port +
             "', but its bore is 0 mm; give it a bore, or no bore_port");
    if (!names.insert(port).second)
      refuse("bore_port '" + port + "' of segment " + segment.name +
             ": something else has this name; rename the port");
  }
}

void check_size(const ShaftSegment& segment) {
  const std::string who = "segment " + segment.name + ": bore " + mm(segment.bore_m);
  if (!std::isfinite(segment.bore_m) || segment.bore_m < 0)
    refuse(who + " must be positive, or 0 for a solid segment");
  if (segment.bore_m == 0) return;
  if (segment.bore_m > (1 - 2 * smallest_wall_share) * segment.diameter_m)
    refuse(who + " leaves a wall of " + mm(0.5 * (segment.diameter_m - segment.bore_m)) + " in diameter " +
           mm(segment.diameter_m) + "; at least 1 % of the diameter must be left: make the bore smaller");
  if (segment.bore_m < smallest_bore_share * segment.diameter_m)
    refuse(who + " is less than 1 % of diameter " + mm(segment.diameter_m) +
           "; leave so small a bore out (0), or make it larger");
}

/// Wall between a fillet's foot and the widest bore that it has to hold against.
void check_wall(const std::string& where, double fillet_m, const ShaftSegment& small, double bore_m) {
  const double wall_m = 0.5 * (small.diameter_m - bore_m);
  if (fillet_m > 0 && wall_m < smallest_wall_fillets * fillet_m)
    refuse("fillet " + where + ": radius " + mm(fillet_m) + " on a wall of " + mm(wall_m) + " between bore " +
           mm(bore_m) + " and diameter " + mm(small.diameter_m) +
           "; the wall must be at least half the fillet: make the fillet or the bore smaller");
}

void check_step(const Shaft& shaft, std::size_t left) {
  const ShaftSegment &a = shaft.segments[left], &b = shaft.segments[left + 1];
  const ShaftSegment& wide = a.bore_m > b.bore_m ? a : b;
  const std::string bores = bored(a) + " and " + bored(b);
  for (const ShaftSegment* segment : {&a, &b})
    if (segment->eccentricity_m != 0)
      refuse("bore step between " + bores + ": segment " + segment->name + " is eccentric by " +
             mm(segment->eccentricity_m) +
             "; an eccentric segment and its neighbours must have the same bore: put the step one segment "
             "further");
  const double smaller_m = std::min(a.diameter_m, b.diameter_m);
  if (0.5 * (smaller_m - wide.bore_m) < smallest_wall_share * smaller_m)
    refuse("bore step between " + bores + ": the bore of " + wide.name + " leaves " +
           mm(0.5 * (smaller_m - wide.bore_m)) + " of diameter " + mm(smaller_m) +
           " to hold the two together; at least 1 % of the diameter must be left");
  if (shaft.fillets_m[left] > 0)
    refuse("bore step between " + bores + " in the plane of a shoulder with fillet " +
           mm(shaft.fillets_m[left]) +
           "; divide a segment so that the step lies beside the fillet, or make the shoulder sharp");
}

/// Bore of the segment beyond, if it is wider than the segment's own; else the segment's own.
double widest_bore(const Shaft& shaft, std::size_t segment) {
  double bore_m = shaft.segments[segment].bore_m;
  if (segment > 0) bore_m = std::max(bore_m, shaft.segments[segment - 1].bore_m);
  if (segment + 1 < shaft.segments.size()) bore_m = std::max(bore_m, shaft.segments[segment + 1].bore_m);
  return bore_m;
}

}  // namespace

void check_bores(const Shaft& shaft) {
  check_port_names(shaft);
  for (const ShaftSegment& segment : shaft.segments) check_size(segment);
  for (std::size_t i = 0; i + 1 < shaft.segments.size(); ++i) {
    const ShaftSegment &left = shaft.segments[i], &right = shaft.segments[i + 1];
    const std::string where = "between " + left.name + " and " + right.name;
    if (std::abs(left.bore_m - right.bore_m) > tiny * left.diameter_m) {
      check_step(shaft, i);
    } else if (left.bore_m != right.bore_m) {
      refuse("the bores of " + left.name + " and " + right.name + " differ by " +
             mm(std::abs(left.bore_m - right.bore_m)) + "; give both the same number");
    } else {
      const std::size_t small = left.diameter_m < right.diameter_m ? i : i + 1;
      check_wall(where, shaft.fillets_m[i], shaft.segments[small], widest_bore(shaft, small));
    }
  }
}

}  // namespace meshes
