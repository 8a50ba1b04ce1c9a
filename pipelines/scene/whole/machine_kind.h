/// What is particular to one machine beside its kinetics: how its scene is read and rehearsed, when its loads
/// repeat, what a report shows of it. The rooms ask the kind and compare no machines; every kind is one file
/// in pipelines/scene/machines, listed by scene/machines/table.cc.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/train_crests.h"
#include "kinetics/values/effect_info.h"
#include "kinetics/values/load_history.h"
#include "pipelines/scene/whole/machine.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

class Doubts;

/// A scene while its machine is read.
struct SceneReading {
  SceneTable &root, &machine;
  Scene& scene;
  SceneFindings& findings;
  std::optional<std::vector<SceneTable>> bodies;  ///< the bodies' tables, if they had to be read already
};

/// The turns after which a machine's loads repeat.
struct Period {
  bool is_known = true;  ///< false: a speed could not be read
  int turns = 1;         ///< 0: never, or not within those looked at
};

class MachineKind {
public:
  virtual ~MachineKind() = default;

  // ---- The scene ----

  virtual std::string type() const = 0;  ///< `machine.type`, and kinetics::LoadHistory::machine
  /// The tables [machine...] and the list of effects; the bodies too where effects follow from them.
  virtual void read(SceneReading& reading) const = 0;
  /// Refuses bodies that do not go together.
  /// @param bodies  the tables of scene.bodies
  virtual void check_bodies(const Scene& scene, std::vector<SceneTable>& bodies) const;
  /// @param most_turns  that are looked at
  /// @param is_sound    nothing of the scene has been refused so far
  virtual Period period(const Scene& scene, int most_turns, bool is_sound) const;
  /// What is legal but hardly meant.
  virtual void doubt(const Scene& scene, Doubts& doubts) const = 0;
  /// Refuses conventions under which a body would not be in equilibrium, as far as that shows without masses.
  virtual void refuse_open_balance(const Scene& scene, SceneTable& machine) const;
  /// A few instants of the load stage; empty where masses are missing so far, or the stage is a run-up.
  /// @throws kinetics::MachineRefused
  virtual std::optional<kinetics::LoadHistory> rehearse(const Scene& scene) const;
  /// Loads that `loads` adds to those of kinetics.
  virtual std::vector<std::string> added_loads(const Scene& scene) const;

  // ---- Loads ----

  /// Instants per turn that tell the highest order of the machine's loads whole, four in its period; 0 where
  /// the scene does not state orders.
  virtual int instants_of_orders(const Machine& machine) const;
  /// The effects that the machine knows under its convention, in the order of summation.
  virtual std::vector<kinetics::EffectInfo> effects(const Machine& machine) const = 0;
  /// Loads over the scene's period, or its run-up.
  /// @param machine  the scene's, with the masses that it leaves to a mesh
  virtual kinetics::LoadHistory loads(const Scene& scene, const Machine& machine) const;
  /// Loads over one start from rest to the scene's running; empty: the machine, or the scene, has no
  /// transient there.
  /// @param machine  the scene's, with the masses that it leaves to a mesh
  /// @throws kinetics::MachineRefused
  virtual std::optional<kinetics::LoadHistory> start_up(const Scene& scene, const Machine& machine) const;
  /// Why a scene cannot say how long a start takes; empty: it can, and start_up follows Scene::run_up.
  virtual std::string why_no_run_up_of_given_duration() const;
  /// Speed of the drive in steady running [rad/s]; 0 where it is not known.
  virtual double drive_speed_rad_s(const Machine& machine) const;
  /// Whether the user brings the loads as samples: they need all their turns, none is too small to count, and
  /// quantities beside the resultants are loads too.
  virtual bool has_samples() const;
  /// What resampling has changed in the samples.
  virtual std::vector<kinetics::ResamplingError> resampling_errors(const Machine& machine,
                                                                   const kinetics::TimeGrid& grid) const;
  /// Loads between the scene's instants that these do not tell; empty: none.
  virtual std::optional<kinetics::LoadHistory> loads_passed_over(const Scene& scene,
                                                                 const Machine& machine) const;
  /// Quantities whose extremes lie between the instants, over the whole course: where a turn has fewer than
  /// 120 instants, by as many. Empty: the instants tell them, or, of samples, nothing else does.
  /// @param at_instants  loads of the grid's instants
  virtual std::vector<kinetics::CourseFigures> figures_over_the_course(
      const Scene& scene, const Machine& machine, const kinetics::TimeGrid& grid,
      const kinetics::LoadHistory& at_instants) const;
  /// Springs that a body may stand on.
  virtual std::vector<kinetics::Spring> springs(const Machine& machine) const;

  // ---- Reports ----

  /// Whether a reader of a terminal wants that quantity of the load stage first.
  virtual bool is_headline(const std::string& quantity) const = 0;
  /// Whether it has a report on torsion (judge/verdict/torsion_report.h).
  virtual bool is_torsional() const;
  /// Natural frequencies of torsion, ascending [rad/s].
  virtual std::vector<double> natural_frequencies_rad_s(const Machine& machine) const;

protected:
  /// What can be told of a machine before the mesh gives its masses.
  /// @throws kinetics::MachineRefused
  virtual void check_without_masses(const Machine& machine) const;
};

/// Kinds in the order of Machine.
const std::vector<const MachineKind*>& machine_kinds();

const MachineKind& kind_of(const Machine& machine);

/// Null if there is none of that type.
const MachineKind* find_machine_kind(const std::string& type);

/// Whether the history is of a machine with samples.
bool has_samples(const kinetics::LoadHistory& history);

}  // namespace pipelines
