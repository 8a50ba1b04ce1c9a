/// What the stage `judge` knows of a body: where it is stressed most, by how much, and what of that is
/// certain.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/judge/estimates/error_budget.h"
#include "pipelines/judge/estimates/hot_spots.h"
#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/judge/estimates/search_record.h"
#include "pipelines/judge/figures/critical_speeds.h"
#include "pipelines/judge/figures/diagrams.h"
#include "pipelines/judge/figures/vibration.h"
#include "pipelines/judge/figures/zone_causes.h"
#include "pipelines/superpose/envelope/superposed.h"

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

/// Bounds of the effects that `effects = "auto"` has switched off.
struct DroppedBounds {
  std::vector<EffectBound> effects;
  EffectBound together;  ///< its effect has no name
};

struct BodyFatigue;
struct StartUpStress;

struct Judged : Superposed {
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
  std::optional<CriticalSpeeds> critical_speeds;  ///< where the scene asks for them
  std::shared_ptr<const BodyFatigue> fatigue;     ///< where the scene asks for it
  std::shared_ptr<const StartUpStress> start_up;  ///< where the scene asks for a start
  std::optional<DroppedBounds> dropped;           ///< where effects = "auto" has dropped any

  // In the .cc file: else every file that copies one compiles the copies of all members anew.
  Judged();
  explicit Judged(Superposed superposed);
  Judged(const Judged&);
  Judged(Judged&&) noexcept;
  Judged& operator=(const Judged&);
  Judged& operator=(Judged&&) noexcept;
  ~Judged();
};

}  // namespace pipelines
