#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/scene/bodies/scene_body_parts.h"

namespace pipelines {
namespace {

/// "uniform", "parabolic", or values along the seat.
std::vector<double> read_axial_profile(SceneTable& table) {
  if (!table.is_given("axial")) return {1};
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

/// One half angle, or the range that it lies in: then the pattern has the one nearest to the half-cosine's.
void read_half_angle(SceneTable& table, PressureModel& model) {
  constexpr Range possible{0, pi, true};
  auto& pattern = model.pattern;
  const bool uniform = pattern.kind == PressurePattern::Kind::uniform;
  if (table.has_list("half_angle")) {
    const auto range = table.quantities("half_angle", "rad", possible, 2);
    if (range[0] > range[1])
      table.refuse("half_angle",
                   "is a range from the larger to the smaller one; write the smaller one first");
    model.half_angles = {range[0], range[1]};
    pattern.half_angle_rad = std::min(std::max(pi / 2, range[0]), range[1]);
  } else {
    const bool is_given = table.has("half_angle");
    pattern.half_angle_rad = table.quantity_or(
        "half_angle", "rad", possible, pi / 2,
        model.is_charge ? "of the charge's sector" : "the half-cosine; the error looks at 40 to 90");
    if (is_given || uniform) model.half_angles = half_angles_around(pattern);
  }
  if (uniform && std::max(pattern.half_angle_rad,
                          table.has_list("half_angle") ? model.half_angles.most_rad : 0) > pi * (1 - 1e-6))
    table.refuse("half_angle", "a uniform pressure all round has no resultant; write less than 180 deg");
}

/// Why Persson's contact does not hold on that port; empty if it does.
std::string why_no_contact(const BodyScene& body, const std::string& port) {
  constexpr const char* remedy = "; write half_angle = [\"10 deg\", \"90 deg\"], or the range that is known";
  const std::string solid = "is that of a solid seat in a stiff hub";
  const auto* shaft = body.shaft();
  if (shaft == nullptr) return solid + ", which is known of segments of a contour alone" + remedy;
  for (const auto& segment : shaft->geometry.segments) {
    if (segment.bore_port == port) return solid + ", and this is a bore" + remedy;
    if (segment.is_port && segment.name == port && segment.bore_m > 0)
      return solid + ", and this one is bored" + remedy;
  }
  return "";
}

void read_clearance(SceneTable& table, const BodyScene& body, const std::string& port, PressureModel& model) {
  if (!table.is_given("clearance")) return;
  constexpr double most_m = 0.01;
  model.clearance_m = table.quantity_or("clearance", "m", not_negative(most_m), 0, "");
  if (table.has("half_angle"))
    table.refuse("clearance",
                 "gives the half angle from the force, and half_angle gives it too; remove one of them");
  if (model.pattern.kind == PressurePattern::Kind::uniform)
    table.refuse("clearance",
                 "is that of a pin in a hole, and a uniform pressure is a belt's; remove one of them");
  if (const auto why = why_no_contact(body, port); !why.empty()) table.refuse("clearance", why);
}

PressureModel read_pressure(SceneTable table, const BodyScene& body, const std::string& port) {
  PressureModel model = usual_pressure(body, port);
  const std::string pattern =
      table.text_or("pattern", "cosine", "of a pin in a bed; \"uniform\" is a belt over its arc of wrap");
  if (pattern == "uniform")
    model.pattern.kind = PressurePattern::Kind::uniform;
  else if (!pattern.empty() && pattern != "cosine")
    table.refuse("pattern", "unknown pattern; write \"cosine\" or \"uniform\"");
  read_clearance(table, body, port, model);
  if (model.clearance_m)
    table.know("half_angle");
  else
    read_half_angle(table, model);
  model.highest_harmonic =
      table.count_or("harmonics", 0, 64, body.pressure_harmonics, "as pressure_harmonics");
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
  if (!table.is_given("pressure")) return;
  SceneTable pressures = table.table("pressure");
  for (const auto& port : pressures.names()) {
    body.pressures[port] = read_pressure(pressures.table(port), body, port);
    check_port(pressures, port, port, ports_of(body).round, "the seats and bores of this body");
  }
  pressures.finish();
}

}  // namespace pipelines
