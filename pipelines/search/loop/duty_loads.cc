#include "pipelines/search/loop/duty_loads.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "kinetics/run_up.h"
#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/judge/estimates/time_sampling.h"
#include "pipelines/loads/stage/same_body.h"
#include "pipelines/loads/stage/start_up_loads.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "pipelines/search/loop/found_body.h"
#include "pipelines/superpose/between_instants/factor_spectrum.h"

namespace pipelines {
namespace {

/// Steps of a run-up in a turn at full speed (kinetics/run_up.h), and the instants that are kept of it: as
/// many as tell peaks to 1.2 %, cos(pi / 20) = 0.988.
constexpr double steps_per_turn = 400, least_instants_per_turn = 20;
constexpr double most_instants = 20'000;

Scene scene_of_block(const DutyBlock& block, const Scene& as_read, const Scene& found) {
  Scene scene = *block.scene;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) FoundBody(as_read, found, b).enter(scene, b);
  if (!scene.effect_choice.offered.empty()) {  // effects = "auto": as the scene's own running has them
    scene.effects = found.effects;
    scene.effect_choice = found.effect_choice;
  }
  return scene;
}

/// @throws StageRefused naming the block where the work refuses
template <typename Work>
auto in_block(const DutyBlock& block, const Work& work) {
  try {
    return work();
  } catch (const SceneError& error) {
    throw StageRefused(block.origin + ": block \"" + block.name + "\": " + error.what());
  } catch (const LoadsDoNotClose& error) {
    throw StageRefused(block.origin + ": block \"" + block.name + "\": " + error.what());
  } catch (const std::invalid_argument& error) {  // StageRefused, kinetics::MachineRefused
    throw StageRefused(block.origin + ": block \"" + block.name + "\": " + error.what());
  }
}

/// From rest to the block's speed.
kinetics::RunUp run_up_of(double duration_s, double speed_rad_s) {
  auto run = kinetics::ramp(0, speed_rad_s, duration_s);
  const double turns_s = duration_s * speed_rad_s / (2 * pi);
  const double per_instant = std::max(4.0, std::ceil(steps_per_turn * turns_s / most_instants));
  if (per_instant > steps_per_turn / least_instants_per_turn)
    throw StageRefused(fmt::format(
        "its start takes as long as {:.0f} turns at full speed; at most {:.0f} are followed: give a shorter "
        "duration",
        turns_s, most_instants / least_instants_per_turn));
  run.steps_per_instant = int(per_instant);
  return run;
}

/// @param warnings  takes those of the start
std::vector<BodyLoads> loads_of_start(const DutyBlock& block, Scene scene, const MassAgreement& masses,
                                      const std::vector<MeshedBody>& meshed,
                                      std::vector<std::string>& warnings) {
  if (!block.start) return {};
  const auto& kind = kind_of(scene.machine);
  if (block.start->duration_s)
    scene.run_up = run_up_of(*block.start->duration_s, std::abs(kind.drive_speed_rad_s(masses.machine)));
  const auto history = kind.start_up(scene, masses.machine);
  if (!history) return {};
  for (const auto& warning : history->warnings) warnings.push_back(in_start_up(warning));
  std::vector<BodyLoads> result;
  for (std::size_t b = 0; b < meshed.size(); ++b) {
    result.push_back(
        distribute_body(scene, scene.bodies[b], *history, loaded_body(scene.bodies[b], meshed[b]), masses));
    require_closed_loads(result.back(), meshed[b].regions);
  }
  return result;
}

/// A crest may be missed by so much of the largest channel before a block asks for more instants.
constexpr double missed_of_channels = 0.01;
constexpr int most_more_instants_of_blocks = 8, kind_of_instants = 12;

/// Loads of the block over its period; where their spectra ask for more instants than there are, and for more
/// than those of the scene's own running, at so many; where the instants pass over some, at the most.
Loaded load_block(Scene& scene, double needed_by_scene, const std::vector<MeshedBody>& meshed,
                  StageClock& clock) {
  auto loaded = load_bodies(scene, meshed, clock);
  double needed = 0;
  bool are_told = true;
  for (const auto& body : loaded.body_loads) {
    needed = std::max(needed, instants_of_duty(body.history));
    are_told = are_told && !passes_over_much(body.history);
  }
  const double before = double(loaded.loads.time_s.size());
  if (are_told && (!(needed > before) || !(needed > needed_by_scene))) return loaded;
  const double most = most_more_instants_of_blocks, more = are_told ? std::min(most, needed / before) : most;
  auto& per_turn = scene.sampling.instants_per_turn;
  per_turn = int(kind_of_instants * std::ceil(more * per_turn / kind_of_instants));
  return load_bodies(scene, meshed, clock);
}

}  // namespace

void require_blocks(const Scene& scene) {
  for (const auto& block : scene.duty) {
    bool same = block.scene->bodies.size() == scene.bodies.size();
    for (std::size_t b = 0; same && b < scene.bodies.size(); ++b)
      same = have_one_mesh(scene.bodies[b], block.scene->bodies[b]) &&
             have_one_stiffness(scene, *block.scene, b);
    if (!same)
      throw StageRefused(block.origin + ": block \"" + block.name +
                         "\" changes the shape, mesh, material or elastic feet of a body; blocks are "
                         "operating points of one body: change keys of the machine or of effects only");
    if (block.start && block.start->duration_s)
      in_block(block, [&] {
        const auto& machine = block.scene->machine;
        return run_up_of(*block.start->duration_s, std::abs(kind_of(machine).drive_speed_rad_s(machine)));
      });
  }
}

DutyBlock with_short_start(DutyBlock block) {
  const double speed_rad_s = std::abs(kind_of(block.scene->machine).drive_speed_rad_s(block.scene->machine));
  if (block.start && block.start->duration_s && speed_rad_s > 0)
    block.start->duration_s = std::min(*block.start->duration_s, 4 * pi / speed_rad_s);
  return block;
}

double instants_of_duty(const ChannelHistory& loads) {
  if (!can_be_transformed(loads.values.cols())) return 0;
  return instants_needed(loads, missed_of_channels).n_instants;
}

BlockLoads loads_of_block(const DutyBlock& block, const Scene& as_read, const Scene& found,
                          const std::vector<MeshedBody>& meshed, StageClock& clock, double needed_by_scene) {
  return in_block(block, [&] {
    auto scene = scene_of_block(block, as_read, found);
    BlockLoads result;
    auto loaded = load_block(scene, needed_by_scene, meshed, clock);
    result.loads = std::move(loaded.loads);
    result.running = std::move(loaded.body_loads);
    result.bearings = std::move(loaded.bearings);
    result.warnings = result.loads.warnings;
    result.starting = clock.run(
        "loads", [&] { return loads_of_start(block, scene, loaded.masses, loaded.meshed, result.warnings); });
    return result;
  });
}

void add_channels_of_blocks(const Scene& as_read, const Scene& found, Loaded& loaded, StageClock& clock) {
  for (const auto& block : found.duty) {
    auto other = loads_of_block(with_short_start(block), as_read, found, loaded.meshed, clock);
    for (std::size_t b = 0; b < loaded.body_loads.size(); ++b) {
      join_channels(loaded.body_loads[b], other.running[b]);
      if (!other.starting.empty()) join_channels(loaded.body_loads[b], other.starting[b]);
    }
  }
}

}  // namespace pipelines
