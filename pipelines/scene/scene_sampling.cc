#include <cmath>
#include <variant>

#include "pipelines/scene/scene_stages.h"

namespace pipelines {
namespace {

constexpr int most_turns = 1000;

/// The turns after which a machine's loads repeat.
struct Period {
  bool is_known = true;  ///< false: a speed could not be read
  int turns = 1;         ///< 0: never, or not within most_turns
};

struct PeriodOf {
  bool drum_axes;  ///< the loads in the drum's axes have to repeat too
  Period operator()(const kinetics::VibratoryMill& mill) const {
    if (!std::isfinite(mill.speed_rad_s) || !std::isfinite(mill.charge_relative_speed_rad_s))
      return {false, 0};
    return {true, kinetics::period_in_turns(mill, most_turns).value_or(0)};
  }
  /// In the carrier's frame every turn; seen from the drum after a few.
  Period operator()(const kinetics::PlanetaryMill& mill) const {
    return {true, drum_axes ? kinetics::period_in_turns(mill, most_turns).value_or(0) : 1};
  }
  /// Of the reference shaft; excitations that do not fit are warned of by the load stage.
  Period operator()(const kinetics::DriveTrain&) const { return {}; }
  /// Samples repeat after as many turns as the user says.
  Period operator()(const kinetics::LoadTable&) const { return {}; }
};

}  // namespace

kinetics::TimeGrid read_sampling(SceneTable sampling, const Scene& scene, SceneFindings& findings) {
  constexpr int most_instants = 2'000'000;
  kinetics::TimeGrid grid;
  grid.instants_per_turn =
      sampling.count_or("instants_per_turn", 8, 100'000, 120, "one instant every 3 degrees of the drive");
  const auto [speeds_are_known, period] =
      std::visit(PeriodOf{scene.drum_axes && findings.errors.empty()}, scene.machine);
  if (sampling.has("turns") || period > 0)
    grid.turns = sampling.count_or("turns", 1, most_turns, period, "the period of the motion");
  else if (sampling.know("turns"); speeds_are_known)
    sampling.refuse_missing("turns",
                            "is missing, and the motion does not repeat within 1000 turns; add the number of "
                            "turns to look at, or a machine.charge.turn_ratio with a small denominator");
  if (sampling.has("turns") && period > 0 && grid.turns % period != 0)
    findings.warnings.push_back("sampling.turns = " + std::to_string(grid.turns) +
                                ": the motion repeats after " + std::to_string(period) +
                                " turns; extremes and means are those of the turns given");
  if (sampling.has("turns") && period == 0 && speeds_are_known)
    findings.warnings.push_back("sampling.turns = " + std::to_string(grid.turns) +
                                ": the motion does not repeat within " + std::to_string(most_turns) +
                                " turns; extremes and means are those of the turns given");
  if (static_cast<double>(grid.turns) * grid.instants_per_turn > most_instants)
    sampling.refuse(sampling.has("instants_per_turn") ? "instants_per_turn" : "turns",
                    std::to_string(grid.turns) + " turns of " + std::to_string(grid.instants_per_turn) +
                        " instants are more than 2 million; take fewer of either");
  sampling.finish();
  return grid;
}

}  // namespace pipelines
