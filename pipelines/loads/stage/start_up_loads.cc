#include "pipelines/loads/stage/start_up_loads.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "pipelines/base/common/refusal_of.h"
#include "pipelines/loads/channels/finite_loads.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

/// The column of each channel of `wanted` in `given`, if it is there.
std::vector<std::optional<std::size_t>> places_in(const std::vector<Channel>& given,
                                                  const std::vector<Channel>& wanted) {
  std::vector<std::optional<std::size_t>> places;
  for (const auto& channel : wanted) {
    const auto found = std::find_if(given.begin(), given.end(),
                                    [&](const auto& other) { return other.name == channel.name; });
    places.push_back(found == given.end() ? std::nullopt : std::optional(std::size_t(found - given.begin())));
  }
  return places;
}

/// Rows in another order; zero where there is none.
ArrayXXd rows_of(const ArrayXXd& values, const std::vector<std::optional<std::size_t>>& places) {
  ArrayXXd rows = ArrayXXd::Zero(Index(places.size()), values.cols());
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k]) rows.row(Index(k)) = values.row(Index(*places[k]));
  return rows;
}

}  // namespace

BodyLoads loads_over(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                     const MeshedBody& meshed, const MassAgreement& masses) {
  auto loads = distribute_body(scene, body, history, loaded_body(body, meshed), masses);
  require_finite(loads);
  require_closed_loads(loads, meshed.regions);
  return loads;
}

void take_channels(BodyLoads& loads, const std::vector<Channel>& channels,
                   const std::vector<fem::UnitLoad>& unit_loads) {
  const auto places = places_in(loads.history.channels, channels);
  loads.history.values = rows_of(loads.history.values, places);
  for (auto& part : loads.history.by_effect) part = rows_of(part, places);
  if (loads.history.passed_over.cols() > 0)
    loads.history.passed_over = rows_of(loads.history.passed_over, places);
  for (auto& part : loads.history.passed_over_by_effect) part = rows_of(part, places);
  loads.history.channels = channels;
  loads.unit_loads = unit_loads;
}

void join_channels(BodyLoads& first, BodyLoads& second) {
  auto channels = first.history.channels;
  auto unit_loads = first.unit_loads;
  const auto places = places_in(channels, second.history.channels);
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (places[k]) continue;
    channels.push_back(second.history.channels[k]);
    unit_loads.push_back(second.unit_loads[k]);
  }
  if (channels.size() > first.history.channels.size()) take_channels(first, channels, unit_loads);
  take_channels(second, channels, unit_loads);
}

std::string in_start_up(const std::string& warning) {
  return "start-up: " + warning;
}

std::shared_ptr<const StartUp> load_start_up(const Scene& scene, Loaded& loaded, StageClock& clock) {
  const auto& machine = loaded.masses.machine;
  auto history = clock.run("loads", [&] {
    return with_place(scene.machine_origin, [&] {
      auto loads = kind_of(machine).start_up(scene, machine);
      if (loads) require_finite(*loads);
      return loads;
    });
  });
  if (!history || loaded.meshed.empty()) return nullptr;
  StartUp start{std::move(*history), {}};
  for (const auto& warning : start.loads.warnings) loaded.loads.warnings.push_back(in_start_up(warning));
  for (std::size_t i = 0; i < loaded.meshed.size(); ++i) {
    start.bodies.push_back(clock.run("distribute", [&] {
      return loads_over(scene, scene.bodies[i], start.loads, loaded.meshed[i], loaded.masses);
    }));
    join_channels(loaded.body_loads[i], start.bodies.back());
  }
  return std::make_shared<const StartUp>(std::move(start));
}

}  // namespace pipelines
