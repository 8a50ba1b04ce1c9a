#include "pipelines/loads/stage/load_stage.h"

#include <algorithm>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/channels/finite_loads.h"
#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/loads/stage/load_maker.h"
#include "pipelines/loads/stage/start_up_loads.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {

Loaded::Loaded() = default;
Loaded::Loaded(const Loaded&) = default;
Loaded::Loaded(Loaded&&) noexcept = default;
Loaded& Loaded::operator=(const Loaded&) = default;
Loaded& Loaded::operator=(Loaded&&) noexcept = default;
Loaded::~Loaded() = default;

namespace {

/// A bearing at a port of a body that turns has the body's speed, which a train's ratios tell from the
/// drive's.
std::vector<BearingScene> with_speeds(const Scene& scene, const Loaded& loaded) {
  std::vector<BearingScene> bearings = scene.bearings;
  for (auto& bearing : bearings)
    for (std::size_t i = 0; i < scene.bodies.size() && !bearing.speed_rad_s; ++i) {
      const auto& channels = loaded.body_loads[i].history.channels;
      const bool carries = std::any_of(channels.begin(), channels.end(), [&](const Channel& channel) {
        return channel.name == bearing.load + ".fx" || channel.name == bearing.load + ".fy";
      });
      const auto& body = scene.bodies[i];
      const double spin_Hz = carries ? load_maker_of(body).spin_Hz(scene, body, loaded.loads) : 0;
      if (spin_Hz > 0) bearing.speed_rad_s = 2 * pi * spin_Hz;
    }
  return bearings;
}

/// Zeros for bearings at ports that support a body, but that no load of this scene reaches: under torsion
/// alone, or with an effect off. The scene's reader has refused other names.
ChannelHistory unloaded_bearings(const Scene& scene, const Loaded& loaded) {
  ChannelHistory zeros;
  for (const auto& bearing : scene.bearings) {
    const bool is_of_body = std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const auto& body) {
      return contains(reader_of(body).bearing_loads(body), bearing.load);
    });
    if (is_of_body && !force_of(bearing.load, loaded.loads, loaded.channels()))
      zeros.channels.push_back({bearing.load + ".fx", "N"});
  }
  zeros.values = Eigen::ArrayXXd::Zero(Eigen::Index(zeros.channels.size()), loaded.loads.n_instants());
  return zeros;
}

/// The channels of each body under loads that the instants pass over.
void add_passed_over(const Scene& scene, Loaded& loaded) {
  const auto history = with_place(scene.machine_origin, [&] {
    return kind_of(loaded.masses.machine).loads_passed_over(scene, loaded.masses.machine);
  });
  if (!history) return;
  require_finite(*history);
  const bool is_fatigue_asked = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                            [](const auto& body) { return bool(body.fatigue); });
  // Warnings of cycles between the instants: nothing else counts them.
  for (const auto& warning : history->warnings)
    if (is_fatigue_asked && !contains(loaded.loads.warnings, warning))
      loaded.loads.warnings.push_back(warning);
  for (std::size_t i = 0; i < loaded.meshed.size(); ++i) {
    auto& own = loaded.body_loads[i];
    auto between = distribute_body(scene, scene.bodies[i], *history,
                                   loaded_body(scene.bodies[i], loaded.meshed[i]), loaded.masses);
    take_channels(between, own.history.channels, own.unit_loads);
    own.history.passed_over = std::move(between.history.values);
    own.history.passed_over_by_effect = std::move(between.history.by_effect);
  }
}

}  // namespace

kinetics::LoadHistory load_stage(const Scene& scene, const Machine& machine) {
  return with_place(scene.machine_origin, [&] {
    auto loads = kind_of(machine).loads(scene, machine);
    require_finite(loads);
    return loads;
  });
}

std::vector<kinetics::Spring> springs_of(const Scene& scene) {
  return kind_of(scene.machine).springs(scene.machine);
}

std::vector<MeshedBody> mesh_bodies(const Scene& scene) {
  std::vector<MeshedBody> bodies;
  for (const auto& body : scene.bodies) bodies.push_back(mesh_body(body, springs_of(scene)));
  return bodies;
}

BodyChannels Loaded::channels() const {
  BodyChannels channels;
  for (const auto& body : body_loads) channels.push_back(&body.history);
  return channels;
}

Loaded load_bodies(const Scene& scene, std::vector<MeshedBody> meshed, StageClock& clock) {
  Loaded result;
  result.scene = scene;
  result.meshed = std::move(meshed);
  result.masses = agree_masses(scene, result.meshed);
  result.loads = clock.run("loads", [&] { return load_stage(scene, result.masses.machine); });
  for (std::size_t i = 0; i < result.meshed.size(); ++i)
    result.body_loads.push_back(clock.run("distribute", [&] {
      return distribute_body(scene, scene.bodies[i], result.loads,
                             loaded_body(scene.bodies[i], result.meshed[i]), result.masses);
    }));
  clock.run("distribute", [&] { add_passed_over(scene, result); });
  for (std::size_t i = 0; i < result.meshed.size(); ++i)
    load_maker_of(scene.bodies[i])
        .require_supports(scene.bodies[i], result.body_loads[i], result.meshed[i].regions);
  require_equilibrium(scene, result.meshed, result.masses, result.body_loads);
  for (std::size_t i = 0; i < result.meshed.size(); ++i) {
    const auto& body = scene.bodies[i];
    const auto& loads = result.body_loads[i];
    require_finite(loads);
    const LoadMaker& maker = load_maker_of(body);
    for (auto& quantity : maker.quantities(loads)) result.loads.quantities.push_back(std::move(quantity));
    if (auto warning = maker.warning(scene, body, loads); !warning.empty())
      result.loads.warnings.push_back(std::move(warning));
  }
  const auto unloaded = unloaded_bearings(scene, result);
  auto channels = result.channels();
  channels.push_back(&unloaded);
  result.bearings = bearing_lives(with_speeds(scene, result), result.loads, channels);
  warn_beyond_ratings(scene.bearings, result.bearings, result.loads);
  for (auto& sentence : forces_along_bearings(result.bearings, result.channels()))
    result.loads.warnings.push_back(std::move(sentence));
  return result;
}

}  // namespace pipelines
