/// What is known of a body once it is analysed.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/values/unit_responses.h"
#include "kinetics/values/load_history.h"
#include "meshes/values/body_mesh.h"
#include "pipelines/base/common/stage_clock.h"
#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/judge/estimates/hot_spots.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/judge/estimates/search_record.h"
#include "pipelines/judge/figures/diagrams.h"
#include "pipelines/judge/figures/vibration.h"
#include "pipelines/judge/figures/zone_causes.h"
#include "pipelines/loads/channels/closure.h"
#include "pipelines/loads/stage/body_loads.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/loads/stage/machine_masses.h"
#include "pipelines/scene/values/method.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "pipelines/superpose/envelope/zones.h"

namespace pipelines {

/// One headline stress: where, when, how much.
struct Peak {
  std::size_t node = 0;
  std::array<double, 3> position_m{};
  double value_Pa = 0;
  std::int32_t instant = 0;
  Stress stress_Pa{};
  std::string feature;
  Place place = Place::interior;
  double safety = 0;                 ///< yield strength / von Mises
  std::vector<double> effect_share;  ///< in the order of ChannelHistory::effects
  ErrorBudget errors;
};

/// How far an effect that is off could move the governing stress of a body at most.
struct EffectBound {
  std::string effect;
  double bound_Pa = 0;
  double estimated_Pa = 0;  ///< part of it from channels that were not solved (effect_bounds.h)
};

/// Of the effects that `effects = "auto"` has switched off.
struct DroppedBounds {
  std::vector<EffectBound> effects;
  EffectBound together;  ///< its effect has no name
};

struct BodyFatigue;
struct StartUpStress;

struct BodyAnalysis {
  BodyScene scene;
  Method method = Method::solid;  ///< the model that the responses are of
  meshes::BodyMesh mesh;
  fem::MassProperties masses;
  fem::GeometryError geometry_error;
  BodyLoads loads;
  fem::UnitResponses responses;
  bool responses_reused = false;      ///< taken from an earlier run
  std::vector<std::string> warnings;  ///< of damaged files that an earlier run has left
  double solve_s = 0;                 ///< wall time; 0: taken from before
  Closure closure;
  NodePlaces places;
  Envelope envelope;
  Zones zones;
  std::vector<ZoneCauses> zone_causes;      ///< of the zones, in their order
  Peak peak;                                ///< largest von Mises stress outside the exclusion distances
  std::size_t principal_node = 0;           ///< largest principal stress, likewise
  std::vector<HotSpotStress> hot_spots;     ///< descending
  ErrorBudget hot_spot_errors;              ///< of the first
  std::optional<Diagrams> diagrams;         ///< parametric shafts and drums only
  std::vector<PlaceStress> place_stresses;  ///< what is known of every place that may govern, with its error
  Search search;                       ///< how the mesh was found, if a tolerance or time limit asked for it
  std::optional<Vibration> vibration;  ///< where the scene asks for natural frequencies
  std::shared_ptr<const BodyFatigue> fatigue;     ///< where the scene asks for it
  std::shared_ptr<const StartUpStress> start_up;  ///< where the scene asks for a start
  std::optional<DroppedBounds> dropped;           ///< where effects = "auto" has dropped any

  // In the .cc file: else every file that copies one compiles the copies of all members anew.
  BodyAnalysis();
  BodyAnalysis(const BodyAnalysis&);
  BodyAnalysis(BodyAnalysis&&) noexcept;
  BodyAnalysis& operator=(const BodyAnalysis&);
  BodyAnalysis& operator=(BodyAnalysis&&) noexcept;
  ~BodyAnalysis();
};

/// Where a run keeps its files and what it may use.
struct RunOptions {
  std::filesystem::path directory;  ///< of this body
  int n_threads = 0;                ///< 0: all cores
  bool fresh = false;               ///< do not reuse unit responses of an earlier run
  bool keep_factor = false;         ///< a search refines locally: for its goals, and instead of submodels
};

}  // namespace pipelines
