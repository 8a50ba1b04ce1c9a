/// Loads of a scene's operating blocks on the bodies that the scene itself is solved for.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/common/stage_clock.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// One block on all bodies.
struct BlockLoads {
  kinetics::LoadHistory loads;          ///< of a period in steady running
  std::vector<BodyLoads> running;       ///< in the order of Scene::bodies
  std::vector<BodyLoads> starting;      ///< over one start; none: the block has none, or no transient in it
  std::vector<BearingResult> bearings;  ///< in the order of Scene::bearings
  std::vector<std::string> warnings;    ///< of the loads in steady running and over a start
};

/// Refuses blocks that change a body, whose mesh and unit responses serve all of them, and starts too long to
/// be followed.
/// @throws StageRefused naming the block
void require_blocks(const Scene& scene);

/// @param as_read  the scene before a search chose meshes, harmonics and instants
/// @param found    after it
/// @param meshed   its bodies
/// @param needed_by_scene  instants_of_duty of the scene's own running; a block whose own spectra ask for
/// more
///                         than that, and than there are, gets up to eight times as many instants
/// @throws as load_bodies, with the block's name; StageRefused if a start has too many turns
BlockLoads loads_of_block(const DutyBlock& block, const Scene& as_read, const Scene& found,
                          const std::vector<MeshedBody>& meshed, StageClock& clock,
                          double needed_by_scene = std::numeric_limits<double>::infinity());

/// Instants over the period by which no crest is missed by more than a hundredth of the largest channel.
double instants_of_duty(const ChannelHistory& loads);

/// The block with a start of at most two turns at full speed, which has all channels of the whole.
DutyBlock with_short_start(DutyBlock block);

/// Gives the scene's own loads the channels that only blocks have, with zero factors, so that their unit
/// responses are solved too.
void add_channels_of_blocks(const Scene& as_read, const Scene& found, Loaded& loaded, StageClock& clock);

}  // namespace pipelines
