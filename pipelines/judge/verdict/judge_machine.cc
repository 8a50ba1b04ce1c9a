/// Bearings, and torsional resonance of a drive train.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "kinetics/series/bearing_life.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/judge/life/duty_result.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/judge/verdict/findings.h"
#include "pipelines/judge/verdict/torsion_report.h"

namespace pipelines {
namespace {

/// Hours of a bearing over all operating blocks or in running, the modified life where the scene asks for it;
/// none: never loaded.
std::optional<double> life_h(const RunReport& report, std::size_t i) {
  if (report.duty != nullptr && i < report.duty->bearings.size()) {
    const auto& bearing = report.duty->bearings[i];
    return bearing.modified_life_h ? bearing.modified_life_h : bearing.life_h;
  }
  const auto& bearing = report.bearings[i];
  if (bearing.answers.modified_life_h) return bearing.answers.modified_life_h;
  return bearing.life ? std::optional(bearing.life->hours) : std::nullopt;
}

/// ISO 76: static safety of normal running without shocks.
double static_safety_wanted(kinetics::RollingElement element) {
  return element == kinetics::RollingElement::ball ? 1.0 : 1.5;
}

Finding judge_life(const RunReport& report, std::size_t i) {
  const auto& scene = report.scene.bearings[i];
  const double wanted_s = scene.required_life_s.value_or(report.scene.limits.wanted_life_s);
  Finding finding{"bearings", Judgement::ok, scene.name, "never loaded", "", std::nullopt, std::nullopt};
  const auto hours = life_h(report, i);
  if (!hours) return finding;
  finding.figure =
      fmt::format("{} of {} wanted", hours_text(*hours * seconds_per_hour), hours_text(wanted_s));
  finding.margin = std::pow(*hours * seconds_per_hour / wanted_s, 1 / kinetics::life_exponent(scene.element));
  finding.least_margin = finding.margin;  // loads of the load stage have no error of their own
  finding.judgement = weigh(*finding.margin, finding.least_margin);
  if (finding.judgement != Judgement::ok)
    finding.remedy =
        fmt::format("a dynamic rating of {:.3g} kN instead of {:.3g} kN",
                    scene.dynamic_rating_N / *finding.margin / 1e3, scene.dynamic_rating_N / 1e3);
  return finding;
}

std::optional<Finding> judge_static_load(const RunReport& report, std::size_t i) {
  const auto& scene = report.scene.bearings[i];
  const auto& safety = report.bearings[i].answers.static_safety;
  if (!safety) return std::nullopt;
  const double wanted = static_safety_wanted(scene.element);
  Finding finding{"bearings",
                  Judgement::ok,
                  scene.name,
                  fmt::format("static safety {:.3g} of {:g} wanted", *safety, wanted),
                  "",
                  *safety / wanted,
                  *safety / wanted};
  finding.judgement = weigh(*finding.margin, finding.least_margin);
  if (finding.judgement != Judgement::ok && scene.static_rating_N)
    finding.remedy =
        fmt::format("a static rating of {:.3g} kN", *scene.static_rating_N / *finding.margin / 1e3);
  return finding;
}

std::vector<std::string> bearing_seats(const Responded& analysis) {
  std::vector<std::string> seats;
  for (const auto& port : analysis.mesh.ports)
    if (port.name.find("bearing") != std::string::npos) seats.push_back(port.name);
  return seats;
}

/// "bearing_1": the first seat of a body that no entry of the scene rates; empty: none. A quantity or role
/// stands for all bearings of the machine; of bodies whose seats are named one by one each needs an entry.
std::string unrated_seat(const RunReport& report) {
  std::vector<std::string> rated;
  for (const auto& bearing : report.scene.bearings) rated.push_back(bearing.load);
  for (const auto& analysis : report.bodies) {
    const auto seats = bearing_seats(analysis), open = names_without(seats, rated);
    if (!open.empty() && (rated.empty() || open.size() < seats.size())) return open.front();
  }
  return "";
}

}  // namespace

std::vector<Finding> judge_bearings(const RunReport& report) {
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < report.bearings.size(); ++i) {
    findings.push_back(judge_life(report, i));
    if (auto finding = judge_static_load(report, i)) findings.push_back(*std::move(finding));
  }
  if (const auto seat = unrated_seat(report); !seat.empty())
    findings.push_back({"bearings", Judgement::not_judged, seat, "no rating is given",
                        "[[bearings]] / name = \"" + seat + "\", load = \"" + seat +
                            "\", element = \"ball\", dynamic_rating = \"... kN\"",
                        std::nullopt, std::nullopt});
  return findings;
}

std::optional<Finding> judge_torsion(const RunReport& report) {
  if (report.torsion == nullptr || report.torsion->margins.empty()) return std::nullopt;
  const auto& closest = report.torsion->margins.front();
  const double limit = report.scene.limits.resonance_margin;
  Finding finding{"resonance", Judgement::ok, closest.line.excitation, "", "", std::nullopt, std::nullopt};
  finding.margin = std::abs(closest.margin) / limit;
  finding.least_margin = finding.margin;
  finding.judgement = weigh(*finding.margin, finding.least_margin);
  finding.figure = fmt::format(
      "excited at {:.4g} rad/s, {:.1f} % from the natural frequency of {:.4g} rad/s; "
      "{:g} % are wanted",
      closest.line.frequency_rad_s, 100 * std::abs(closest.margin), closest.natural_frequency_rad_s,
      100 * limit);
  if (finding.judgement != Judgement::ok)
    finding.remedy = "another speed, stiffness or inertia; what damping leaves of it is in the loads";
  return finding;
}

}  // namespace pipelines
