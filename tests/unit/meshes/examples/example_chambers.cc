#include "tests/unit/meshes/examples/example_chambers.h"

#include <algorithm>
#include <cmath>
#include <sstream>

using meshes::Chamber;

Chamber laboratory_chamber() {
  const double mm = 1e-3;
  Chamber chamber;
  chamber.tube = {130 * mm, 6 * mm, 280 * mm, 280 * mm, 40 * mm};
  chamber.flanges = {175 * mm, 12 * mm};
  chamber.housing = {65 * mm, 47.5 * mm, 105 * mm};
  chamber.webs = {14 * mm, 140 * mm, {-45 * mm, 45 * mm}};
  chamber.lugs = {8 * mm, 40 * mm, 100 * mm};
  chamber.pads = {50 * mm, 30 * mm, 30 * mm};
  chamber.feet = {{100 * mm, -180 * mm}, {460 * mm, -180 * mm}};
  return chamber;
}

Chamber lopsided_chamber() {
  const double mm = 1e-3;
  Chamber chamber = laboratory_chamber();
  chamber.housing.length_m = 130 * mm;
  chamber.webs = {10 * mm, 120 * mm, {-50 * mm, 5 * mm, 48 * mm}};
  chamber.feet = {{60 * mm, -120 * mm}, {460 * mm, -180 * mm}, {350 * mm, 300 * mm}};
  return chamber;
}

namespace {

double between(std::mt19937& random, double low, double high) {
  // Not std::uniform_real_distribution: its numbers differ between libraries.
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

}  // namespace

Chamber random_chamber(std::mt19937& random) {
  const double pi = std::acos(-1.0);
  Chamber chamber;
  auto& tube = chamber.tube;
  tube.inner_radius_m = between(random, 0.05, 0.4);
  tube.wall_m = tube.inner_radius_m * between(random, 0.015, 0.15);
  tube.length_m = tube.inner_radius_m * between(random, 1.5, 5);
  const double r_m = tube.inner_radius_m + tube.wall_m;
  chamber.flanges.outer_radius_m = r_m + between(random, 1, 8) * tube.wall_m;
  chamber.flanges.outer_radius_m = std::min(chamber.flanges.outer_radius_m, 2 * r_m);
  chamber.flanges.thickness_m = between(random, 0.5, 3) * tube.wall_m;
  auto& housing = chamber.housing;
  housing.outer_radius_m = r_m * between(random, 0.3, 1);
  housing.bore_radius_m = housing.outer_radius_m * between(random, 0.4, 0.9);
  housing.length_m = tube.length_m * between(random, 0.3, 0.7);
  const double away_m = r_m + housing.outer_radius_m + r_m * between(random, 0.1, 1);
  const double direction_rad = between(random, -pi, pi);
  tube.axis_x_m = away_m * std::cos(direction_rad);
  tube.axis_y_m = away_m * std::sin(direction_rad);

  auto& webs = chamber.webs;
  webs.thickness_m = between(random, 0.7, 3) * tube.wall_m;
  webs.height_m = r_m * between(random, 0.3, 1.2);
  const int n_webs = 1 + static_cast<int>(between(random, 0, 3));
  const double room_m = 0.5 * (housing.length_m - webs.thickness_m);
  for (int i = 0; i < n_webs; ++i)
    webs.z_m.push_back(n_webs == 1 ? 0 : room_m * (2.0 * i / (n_webs - 1) - 1) * between(random, 0.6, 1));
  chamber.lugs.thickness_m = between(random, 0.6, 2) * tube.wall_m;
  chamber.lugs.width_m = std::max(3 * tube.wall_m, r_m * between(random, 0.15, 0.6));
  chamber.lugs.z_m = tube.length_m * between(random, 0.25, 0.4);
  chamber.pads = {r_m * between(random, 0.15, 0.6), r_m * between(random, 0.15, 0.6),
                  chamber.lugs.thickness_m * between(random, 1.2, 4)};
  const int n_feet = 1 + static_cast<int>(between(random, 0, 4));
  const double turn_rad = between(random, -pi, pi);
  for (int i = 0; i < n_feet; ++i) {
    const double foot_rad = turn_rad + 2 * pi * (i + between(random, -0.3, 0.3)) / n_feet;
    const double foot_m = r_m * between(random, 1.4, 2.5);
    chamber.feet.push_back(
        {tube.axis_x_m + foot_m * std::cos(foot_rad), tube.axis_y_m + foot_m * std::sin(foot_rad)});
  }
  return chamber;
}

std::string text(const Chamber& chamber) {
  std::ostringstream text;
  const auto& c = chamber;
  text.precision(12);
  text << "tube " << c.tube.inner_radius_m << " " << c.tube.wall_m << " " << c.tube.length_m << " at "
       << c.tube.axis_x_m << " " << c.tube.axis_y_m << "; flanges " << c.flanges.outer_radius_m << " "
       << c.flanges.thickness_m << "; housing " << c.housing.outer_radius_m << " " << c.housing.bore_radius_m
       << " " << c.housing.length_m << "; webs " << c.webs.thickness_m << " " << c.webs.height_m << " at";
  for (const double z_m : c.webs.z_m) text << " " << z_m;
  text << "; lugs " << c.lugs.thickness_m << " " << c.lugs.width_m << " at " << c.lugs.z_m << "; pads "
       << c.pads.size_x_m << " " << c.pads.size_y_m << " " << c.pads.size_z_m << "; feet";
  for (const auto& foot : c.feet) text << " (" << foot.x_m << ", " << foot.y_m << ")";
  return text.str();
}
