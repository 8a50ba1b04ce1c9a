/// Fatigue of a body's surface: amplitude and mean of the stress over the cycle, what the material endures
/// there, and the life that follows, place by place.
///
/// Rules and sources: pipelines/base/fatigue/README.md. Stress is the local one (notches are in the mesh), so
/// the endurance limit of the smooth specimen is met by support factor, roughness, treatment and mean stress
/// alone (FKM, local stresses).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/fatigue/technological_size.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/judge/life/life_certainty.h"
#include "pipelines/judge/life/nominal_fatigue.h"
#include "pipelines/superpose/envelope/nodal_cycles.h"

namespace pipelines {

/// What a scene's loads repeat.
struct LoadPeriod {
  double duration_s = 0;
  double turns = 0;  ///< turns of the drive
};

/// The other rules beside FKM's: safety against endurance without j_D and reliability. Each is the least of
/// FKM's worst node and of the place's nodes where one of Shigley's lines is used up most.
struct SecondOpinions {
  double goodman = 0, gerber = 0, soderberg = 0;  ///< with FKM's endurance limit at zero mean
  double findley = 0;                             ///< critical plane; infinite without stress
};

/// The place of a surface (fillet, seat, ...) that fatigue uses up most.
struct FatiguePlace {
  std::string feature;
  Place surface = Place::free_surface;
  std::size_t node = 0;
  std::array<double, 3> position_m{};
  StressCycle cycle{};        ///< no pair of instants differs more, nor of what lies between them
  double from = 0, to = 0;    ///< its instants: i + share of the step to the next
  double gradient_per_m = 0;  ///< related stress gradient of the amplitude
  double support = 1;         ///< n_sigma that it brings
  double endurance_Pa = 0;    ///< sigma_AK: amplitude endured at this mean, reliability in it, j_D not
  double safety = 0;          ///< sigma_AK / amplitude; infinite where nothing changes
  double utilisation = 0;     ///< j_D / safety: 1 is what is allowed
  /// Damage in a turn of the drive, at the design limit sigma_AK / j_D; 0: endures.
  double damage_per_turn = 0;
  std::optional<double> life_s;       ///< none: endures
  std::optional<double> life_safety;  ///< safety against the wanted life: factor on all stresses over j_D
  std::size_t n_counted = 0;          ///< rainflow cycles in a period, along the direction of most damage
  SecondOpinions others;
  /// Shares of the amplitude, in the order of ChannelHistory::effects; they sum to 1.
  std::vector<double> effect_share;
  /// Shares of the damage (damage_shares.h), in the same order; empty: nothing changes.
  std::vector<double> damage_share;
  double unresolved_share = 0;  ///< what the instants leave unresolved of the amplitude
  /// Whole error of the amplitude (whole_error_share_of_change); infinite: not known.
  double error_share = 0;
  LifeCertainty certainty;  ///< certainty of the life
};

/// A weld by its structural hot-spot or effective notch stress over the cycle.
struct WeldFatigue {
  std::string name;
  std::array<double, 3> toe_m{};
  std::string type;  ///< type of weld_classes.h, or effective_notch; empty: the class is the scene's own
  double class_Pa = 0, thickness_m = 0;                 ///< a notch has no thickness: 0
  double thickness_exponent = 0, thickness_factor = 1;  ///< n and f(t) on the class (weld_fatigue.h)
  double range_Pa = 0;                                  ///< largest of the counted cycles
  double angle_rad = 0;       ///< angle of the governing direction from the toe's normal, at most 60 degrees
  bool is_principal = false;  ///< a principal direction of the range; else the toe's normal
  /// Shares of the range, in the order of ChannelHistory::effects; they sum to 1, but for effects without a
  /// share of their own. Empty: nothing changes.
  std::vector<double> effect_share;
  std::vector<double> damage_share;  ///< shares of the damage (damage_shares.h), in the same order
  std::size_t n_counted = 0;         ///< rainflow cycles in a period
  double damage_per_turn = 0;
  std::optional<double> life_s;       ///< none: endures
  std::optional<double> life_safety;  ///< safety against the wanted life: factor on all stresses
  double unresolved_share = 0;        ///< what the instants leave unresolved of the range
  double error_share = 0;             ///< whole error of the stress, with that; infinite: not known
  LifeCertainty certainty;            ///< certainty of the life
};

/// The damage at a zone's peak.
struct ZoneDamage {
  bool is_on_surface = false;  ///< else nothing is judged: inside, or where a weld is rounded
  double damage_per_turn = 0;
  std::optional<double> life_s;  ///< none: endures
  double error_share = 0;        ///< whole error of the amplitude; infinite: not known
  LifeCertainty certainty;       ///< certainty of the life
  StressShares shares;           ///< shares of the damage (damage_shares.h); empty: nothing changes
};

/// The place that is used most, if the strength of the scene is that of the standard's reference size.
struct LifeAtSize {
  SizeOfMaterial size;  ///< with the factors for the body's effective diameter
  double safety = 0;    ///< against endurance
  std::optional<double> life_s;
};

struct BodyFatigue {
  NodalCycles cycles;                   ///< cycles of all nodes of the surface
  std::vector<double> utilisation_at;   ///< utilisation at these nodes, without support by the gradient
  std::vector<FatiguePlace> places;     ///< by falling utilisation
  std::vector<NominalFatigue> nominal;  ///< fillets of steel shafts by DIN 743, least safety first
  std::vector<WeldFatigue> welds;       ///< by rising life, then by falling range
  std::vector<ZoneDamage> zones;        ///< in the order of Judged::zones
  double effective_diameter_m = 0;      ///< d_eff of FKM; 0: with a size_factor, or not known
  std::vector<LifeAtSize> at_size;      ///< by kind of material of the group (technological_size.h)
  std::vector<std::string> warnings;    ///< where the rules do not hold
};

/// @param analysis  with envelope, places and loads; its scene asks for fatigue
/// @param period    period of the loads
BodyFatigue judge_fatigue(const Judged& analysis, const LoadPeriod& period, int n_threads);

}  // namespace pipelines
