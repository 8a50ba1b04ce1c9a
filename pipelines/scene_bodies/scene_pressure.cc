#include <algorithm>
#include <cmath>

#include "pipelines/common/constants.h"
#include "pipelines/scene_bodies/scene_body_parts.h"

namespace pipelines {
namespace {

/// "uniform", "parabolic", or values along the seat.
std::vector<double> read_axial_profile(SceneTable& table) {
  table.know("axial");
  if (!table.has("axial")) return {1};
  if (table.has_list("axial")) {
    auto values = table.list("axial", "1", not_negative(1e6));
    if (values.size() == 1 || std::all_of(values.begin(), values.end(), [](double v) { return v == 0; }))
      table.refuse("axial", "needs two values or more along the seat, not all zero");
    return values;
  }
  const std::string shape = table.text("axial");
  if (shape == "parabolic") {
    std::vector<double> values;
    constexpr int n = 16;  // straight lines between: the parabola is met to 1/256 of its height
    for (int i = 0; i <= n; ++i) values.push_back(1 - std::pow(2.0 * i / n - 1, 2));
    return values;
  }
  if (!shape.empty() && shape != "uniform")
    table.refuse("axial",
                 "unknown shape; write \"uniform\", \"parabolic\" or a list of values along the seat");
  return {1};
}

PressureModel read_pressure(SceneTable table, int usual_harmonics) {
  PressureModel model;
  const std::string pattern =
      table.text_or("pattern", "cosine", "of a pin in a bed; \"uniform\" is a belt over its arc of wrap");
  if (pattern == "uniform")
    model.pattern.kind = PressurePattern::Kind::uniform;
  else if (!pattern.empty() && pattern != "cosine")
    table.refuse("pattern", "unknown pattern; write \"cosine\" or \"uniform\"");
  const bool uniform = model.pattern.kind == PressurePattern::Kind::uniform;
  model.pattern.half_angle_rad = table.quantity_or(
      "half_angle", "rad", {0, pi, true}, pi / 2,
      "of contact: 90 degrees is the half-cosine, less with clearance, more with interference");
  if (uniform && model.pattern.half_angle_rad > pi * (1 - 1e-6))
    table.refuse("half_angle", "a uniform pressure all round has no resultant; write less than 180 deg");
  model.highest_harmonic = table.count_or("harmonics", 0, 64, usual_harmonics, "as pressure_harmonics");
  model.axial_profile = read_axial_profile(table);
  table.finish();
  return model;
}

}  // namespace

void read_pressures(SceneTable& table, BodyScene& body) {
  body.pressure_harmonics =
      table.count_or("pressure_harmonics", 0, 64, body.pressure_harmonics, "of the seat pressure");
  if (body.pressure_harmonics % 2 != 0)
    table.refuse("pressure_harmonics",
                 "must be even: a half-cosine has no odd harmonic above the first; write " +
                     std::to_string(body.pressure_harmonics + 1));
  table.know("pressure");
  if (!table.has("pressure")) return;
  SceneTable pressures = table.table("pressure");
  for (const auto& port : pressures.names()) {
    body.pressures[port] = read_pressure(pressures.table(port), body.pressure_harmonics);
    check_port(pressures, port, port, ports_of(body).round, "the seats and bores of this body");
  }
  pressures.finish();
}

}  // namespace pipelines
