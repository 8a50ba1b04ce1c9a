/// A stepped shaft with two fillets under a load table: the smallest body with everything a search for
/// accuracy needs.
#pragma once

#include <string>

namespace cases {

/// Bending by a force between two bearings that turns once per turn against the shaft, and a torque.
inline std::string stepped_shaft(const std::string& first_lines = "") {
  return "title = \"Small shaft\"\neffects = [\"drive\"]\n" + first_lines + R"(
[machine]
type = "load_table"
speed = "1000 rpm"

[[machine.harmonics]]
effect = "drive"
load = "gear.fx"
order = 1
amplitude = "2 kN"

[[machine.constants]]
effect = "drive"
load = "gear.fy"
value = "3 kN"

[sampling]
instants_per_turn = 48
turns = 1

[shaft]
contour = [
  { port = "left",  diameter = "40 mm", length = "60 mm" },
  { fillet = "3 mm" },
  { port = "gear",  diameter = "60 mm", length = "70 mm" },
  { fillet = "3 mm" },
  { port = "right", diameter = "40 mm", length = "40 mm" },
]
bearings = ["left", "right"]
axial_support = "left"
torque_support = "right"

[shaft.material]
name = "C45+N"
youngs_modulus = "206 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"

[shaft.mesh]
cells_per_fillet_quarter = 4
sectors = 12

[results]
snapshots = 0
pictures = false
)";
}

}  // namespace cases
