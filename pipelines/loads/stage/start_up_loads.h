/// A machine's start from standstill, beside its steady running: its loads on the bodies, to be superposed on
/// the unit responses of the steady run.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/base/common/stage_clock.h"
#include "pipelines/loads/stage/load_stage.h"

namespace pipelines {

struct StartUp {
  kinetics::LoadHistory loads;    ///< time_s from standstill on
  std::vector<BodyLoads> bodies;  ///< in the order of Scene::bodies, with the channels of the steady loads
};

/// Loads of a body over any history of its machine: a start, a block of duty.
/// @param history  with the roles and quantities of the load stage
/// @throws LoadsDoNotClose unless they close at every instant; NotFinite
BodyLoads loads_over(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& history,
                     const MeshedBody& meshed, const MassAgreement& masses);

/// The loads with these channels, in this order; those that it does not have are zero.
/// @param unit_loads  unit loads of the channels, in their order
void take_channels(BodyLoads& loads, const std::vector<Channel>& channels,
                   const std::vector<fem::UnitLoad>& unit_loads);

/// Gives two load histories of one body the same channels in the same order: those of the first, then what
/// only the second has. What a history does not have is zero there.
void join_channels(BodyLoads& first, BodyLoads& second);

/// A warning of a start, as it stands among those of the loads.
std::string in_start_up(const std::string& warning);

/// The start that the scene asks for; null where it asks for none.
/// @param loaded  the steady loads of the bodies; they get the channels that only the start has, as zeros, so
///                that one set of unit responses serves both
/// @throws kinetics::MachineRefused, and as loads_over
std::shared_ptr<const StartUp> load_start_up(const Scene& scene, Loaded& loaded, StageClock& clock);

}  // namespace pipelines
