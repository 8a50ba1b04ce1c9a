#include "pipelines/scene/reader/scene_stages.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

constexpr int most_turns = 1000;

}  // namespace

kinetics::TimeGrid read_sampling(SceneTable sampling, const Scene& scene, SceneFindings& findings) {
  constexpr int most_instants = 2'000'000;
  kinetics::TimeGrid grid;
  grid.instants_per_turn =
      sampling.count_or("instants_per_turn", 8, 100'000, 120, "one instant every 3 degrees of the drive");
  const auto [speeds_are_known, period] =
      kind_of(scene.machine).period(scene, most_turns, findings.errors.empty());
  if (sampling.has("turns") || period > 0)
    grid.turns = sampling.count_or("turns", 1, most_turns, period, "the period of the motion");
  else if (sampling.know("turns"); speeds_are_known)
    sampling.refuse_missing("turns",
                            "is missing, and the motion does not repeat within 1000 turns; add the number of "
                            "turns to look at, or make the speeds' ratio one of small whole numbers");
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
                    std::to_string(grid.turns) + (grid.turns == 1 ? " turn of " : " turns of ") +
                        std::to_string(grid.instants_per_turn) +
                        " instants are more than 2 million; take fewer of either");
  sampling.finish();
  return grid;
}

}  // namespace pipelines
