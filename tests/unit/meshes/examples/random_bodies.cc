#include "tests/unit/meshes/examples/random_bodies.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

using meshes::Shaft;
using meshes::ShaftSegment;

namespace {

double drawn_between(std::mt19937& random, double low, double high) {
  // Not std::uniform_real_distribution: its numbers differ drawn_between libraries, and the seed is to fix
  // the bodies.
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

bool happens(std::mt19937& random, double probability) {
  return drawn_between(random, 0, 1) < probability;
}

double length_of(const ShaftSegment& segment) {
  return segment.end_m - segment.begin_m;
}

void stepped(Shaft& shaft, std::mt19937& random) {
  const int n = 1 + static_cast<int>(drawn_between(random, 0, 7));
  double z_m = drawn_between(random, -0.5, 0.5);
  for (int i = 0; i < n; ++i) {
    ShaftSegment segment;
    segment.name = "s" + std::to_string(i);
    segment.diameter_m = drawn_between(random, 0.02, 0.1);
    segment.begin_m = z_m;
    segment.end_m = z_m + segment.diameter_m * drawn_between(random, 0.35, 3);
    segment.is_port = happens(random, 0.5);
    z_m = segment.end_m;
    shaft.segments.push_back(segment);
  }
  for (int i = 0; i + 1 < n; ++i) {
    const auto &a = shaft.segments[i], &b = shaft.segments[i + 1];
    const auto& small = a.diameter_m < b.diameter_m ? a : b;
    const double step_m = 0.5 * std::abs(a.diameter_m - b.diameter_m);
    const double fillet_m = std::min(drawn_between(random, 0.05, 0.9) * step_m, 0.15 * length_of(small));
    shaft.fillets_m.push_back(happens(random, 0.2) ? 0 : fillet_m);
  }
}

/// The end of the smaller segment at a shoulder becomes a groove.
void cut_groove(Shaft& shaft, std::size_t junction, std::mt19937& random) {
  const bool small_is_left = shaft.segments[junction].diameter_m < shaft.segments[junction + 1].diameter_m;
  ShaftSegment& small = shaft.segments[small_is_left ? junction : junction + 1];
  const double length_m = small.diameter_m * drawn_between(random, 0.05, 0.2);
  ShaftSegment groove;
  groove.name = "groove" + std::to_string(junction) + small.name;
  groove.diameter_m = small.diameter_m * (1 - 2 * drawn_between(random, 0.03, 0.15));
  if (length_m > 0.5 * length_of(small)) return;
  const double depth_m = 0.5 * (small.diameter_m - groove.diameter_m);
  const double outer_m = std::min(drawn_between(random, 0.2, 1) * depth_m, 0.45 * length_m);
  const double inner_m = std::min(std::max(shaft.fillets_m[junction], 0.2 * depth_m), 0.45 * length_m);
  if (small_is_left) {
    groove.end_m = small.end_m;
    groove.begin_m = small.end_m = small.end_m - length_m;
    shaft.fillets_m[junction] = inner_m;
    shaft.fillets_m.insert(shaft.fillets_m.begin() + junction, outer_m);
  } else {
    groove.begin_m = small.begin_m;
    groove.end_m = small.begin_m = small.begin_m + length_m;
    shaft.fillets_m[junction] = inner_m;
    shaft.fillets_m.insert(shaft.fillets_m.begin() + junction + 1, outer_m);
  }
  shaft.segments.insert(shaft.segments.begin() + junction + 1, groove);
}

void shift_thick_segments(Shaft& shaft, std::mt19937& random) {
  const std::size_t n = shaft.segments.size();
  for (std::size_t i = 0; i < n; ++i) {
    ShaftSegment& segment = shaft.segments[i];
    double inside_m = 0;
    const auto consider = [&](const ShaftSegment& neighbour, double fillet_m) {
      inside_m = std::max(inside_m, 0.5 * neighbour.diameter_m + fillet_m);
    };
    if (i > 0) consider(shaft.segments[i - 1], shaft.fillets_m[i - 1]);
    if (i + 1 < n) consider(shaft.segments[i + 1], shaft.fillets_m[i]);
    const double ring_m = 0.5 * segment.diameter_m - inside_m;
    if (n == 1 || ring_m <= 0 || happens(random, 1.0 / 3)) continue;
    segment.eccentricity_m = ring_m * drawn_between(random, 0.1, 0.75);
    segment.eccentricity_angle_rad = drawn_between(random, -4, 4);
  }
}

/// Divides a segment in two of the same diameter.
void divide(Shaft& shaft, std::size_t index, double share) {
  ShaftSegment second = shaft.segments[index];
  second.name += "b";
  second.is_port = shaft.segments[index].is_port = false;
  second.begin_m += share * length_of(second);
  shaft.segments[index].end_m = second.begin_m;
  shaft.segments.insert(shaft.segments.begin() + index + 1, second);
  shaft.fillets_m.insert(shaft.fillets_m.begin() + index, 0);
}

void bore(Shaft& shaft, std::size_t begin, std::size_t end, double share) {
  double smallest_m = 1e9;
  for (std::size_t i = begin; i < end; ++i) smallest_m = std::min(smallest_m, shaft.segments[i].diameter_m);
  for (std::size_t i = begin; i < end; ++i) shaft.segments[i].bore_m = share * smallest_m;
}

void drill(Shaft& shaft, std::mt19937& random) {
  const double first = drawn_between(random, 0.1, 0.6), second = drawn_between(random, 0.1, 0.6);
  std::vector<std::size_t> concentric;
  for (std::size_t i = 0; i < shaft.segments.size(); ++i)
    if (shaft.segments[i].eccentricity_m == 0 &&
        length_of(shaft.segments[i]) > 0.4 * shaft.segments[i].diameter_m)
      concentric.push_back(i);
  const int kind = static_cast<int>(drawn_between(random, 0, 4));
  if (kind == 0 || concentric.empty()) return bore(shaft, 0, shaft.segments.size(), first);
  const std::size_t at =
      concentric[static_cast<std::size_t>(drawn_between(random, 0, concentric.size() - 1e-6))];
  divide(shaft, at, drawn_between(random, 0.3, 0.6));
  if (kind == 3) divide(shaft, at + 1, 0.5);  // solid drawn_between two blind bores
  bore(shaft, 0, at + 1, first);
  if (kind > 1) bore(shaft, at + (kind == 3 ? 2 : 1), shaft.segments.size(), second);
}

ShaftSegment cylinder(const std::string& name, double length_m, double diameter_m, double bore_m) {
  ShaftSegment segment;
  segment.name = name;
  segment.end_m = length_m;  // begins at 0; put in place later
  segment.diameter_m = diameter_m;
  segment.bore_m = bore_m;
  return segment;
}

/// Steps of a trunnion from the cover outwards.
std::vector<ShaftSegment> trunnion(const std::string& name, double root_m, std::mt19937& random) {
  std::vector<ShaftSegment> steps;
  const int n = 1 + static_cast<int>(drawn_between(random, 0, 4));
  for (int i = 0; i < n; ++i) {
    steps.push_back(cylinder(name + std::to_string(i), root_m * drawn_between(random, 0.2, 1.5), root_m, 0));
    steps.back().is_port = happens(random, 0.5);
    root_m *= drawn_between(random, 0.7, 0.95);
  }
  return steps;
}

}  // namespace

int n_random_bodies() {
  const char* text = std::getenv("MILLSTRESS_RANDOM_BODIES");
  return text ? std::atoi(text) : 50;
}

Shaft random_shaft(std::mt19937& random) {
  Shaft shaft;
  stepped(shaft, random);
  for (std::size_t i = shaft.fillets_m.size(); i-- > 0;)
    if (happens(random, 0.25)) cut_groove(shaft, i, random);
  shift_thick_segments(shaft, random);
  if (happens(random, 1.0 / 3)) drill(shaft, random);
  return shaft;
}

Shaft random_drum(std::mt19937& random) {
  const double radius_m = drawn_between(random, 0.05, 0.6),
               wall_m = radius_m * drawn_between(random, 0.025, 0.15);
  const double inside_m = 2 * (radius_m - wall_m);
  const auto left = trunnion("left", inside_m * drawn_between(random, 0.25, 0.8), random);
  const auto right = trunnion("right", inside_m * drawn_between(random, 0.25, 0.8), random);
  const double smallest_m = std::min(left.back().diameter_m, right.back().diameter_m);
  const double bore_m = happens(random, 1.0 / 3) ? 0 : smallest_m * drawn_between(random, 0.2, 0.6);

  Shaft drum;
  drum.segments.assign(left.rbegin(), left.rend());
  for (ShaftSegment& segment : drum.segments) segment.bore_m = bore_m;
  const auto add_cover = [&](const std::string& name) {
    const double over = happens(random, 0.25) ? 1 + drawn_between(random, 0.02, 0.15) : 1;
    drum.segments.push_back(
        cylinder(name, radius_m * drawn_between(random, 0.05, 0.4), 2 * radius_m * over, bore_m));
  };
  add_cover("cover_1");
  const int n_pieces = 1 + 2 * static_cast<int>(drawn_between(random, 0, 2));
  for (int i = 0; i < n_pieces; ++i) {
    const double thinner = i == 1 ? drawn_between(random, 0, 1 - 0.02 * radius_m / wall_m) : 0;
    drum.segments.push_back(cylinder("shell_" + std::to_string(i),
                                     radius_m * drawn_between(random, 0.5, 8) / n_pieces,
                                     2 * (radius_m - thinner * wall_m), inside_m));
    drum.segments.back().bore_port = "wall_" + std::to_string(i);
  }
  add_cover("cover_2");
  for (ShaftSegment step : right) {
    step.bore_m = bore_m;
    drum.segments.push_back(step);
  }

  double z_m = drawn_between(random, -1, 1);
  for (ShaftSegment& segment : drum.segments) {
    const double length_m = segment.end_m;
    segment.begin_m = z_m;
    segment.end_m = z_m = z_m + length_m;
  }
  for (std::size_t i = 0; i + 1 < drum.segments.size(); ++i) {
    const auto &a = drum.segments[i], &b = drum.segments[i + 1];
    const double step_m = 0.5 * std::abs(a.diameter_m - b.diameter_m);
    const double fillet_m =
        std::min({drawn_between(random, 0.1, 0.8) * step_m, 0.35 * std::min(length_of(a), length_of(b)),
                  0.5 * (std::min(a.diameter_m, b.diameter_m) - a.bore_m)});
    drum.fillets_m.push_back(a.bore_m != b.bore_m || happens(random, 0.15) ? 0 : fillet_m);
  }
  return drum;
}

std::string text(const Shaft& shaft) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const auto& s = shaft.segments[i];
    text << s.name << " d " << s.diameter_m << " b " << s.bore_m << " l " << length_of(s) << " e "
         << s.eccentricity_m << " at " << s.eccentricity_angle_rad;
    if (i < shaft.fillets_m.size()) text << " f " << shaft.fillets_m[i] << "; ";
  }
  return text.str();
}
