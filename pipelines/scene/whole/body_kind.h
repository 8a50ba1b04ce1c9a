/// What is particular to one kind of body, a vibratory mill's shaft or a planetary mill's drum: how the scene
/// describes it, which loads enter where, whose masses it shares, what carries it. The rooms ask the kind and
/// compare none; every kind is one file in pipelines/loads/bodies, listed by loads/bodies/table.cc.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/values/effect_info.h"
#include "kinetics/values/load_history.h"
#include "pipelines/scene/values/body_scene.h"
#include "pipelines/scene/whole/machine.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

struct BodyLoads;
struct Closure;
struct ContourRules;
struct LoadedBody;
struct MassAgreement;
struct MeshedBody;
struct RegionMass;

/// Port where the torque of an element of the machine enters a body, and the role of that torque in load
/// histories.
struct ElementPort {
  std::string element, port, role;
};

class BodyKind {
public:
  virtual ~BodyKind() = default;

  // ---- The scene ----

  /// `machine.type` of the scenes that can have the body.
  virtual std::string machine_type() const = 0;
  /// Tables of a scene that describe such a body.
  virtual std::vector<std::string> tables() const = 0;
  /// What only this kind has in its table; refuses what of the scene's loads cannot enter it.
  /// @param scene  with its machine read
  virtual BodyOptions read_options(SceneTable& table, const Scene& scene) const = 0;
  /// Ports that the loads need and, for a contour, where it begins.
  /// @param body  with its options read
  virtual ContourRules contour_rules(const Scene& scene, const BodyScene& body) const = 0;
  /// Shape of a body that is no file; a contour unless overridden.
  virtual BodyShape read_shape(SceneTable& table, const Scene& scene, const BodyScene& body,
                               SceneFindings& findings) const;
  /// Refuses ports of the options that the shape does not have; the contour asks for those that are loaded.
  virtual void check_ports(SceneTable& table, const BodyScene& body) const;
  /// Names that a bearing of the scene may give as its load, beside those of the load stage.
  virtual std::vector<std::string> bearing_loads(const BodyScene& body) const = 0;
  /// Speed of the body's ports against what they run in; empty where that stands still beside them.
  virtual std::optional<double> seat_speed_rad_s(const Scene& scene, const BodyScene& body) const;

  // ---- Effects ----

  /// What every body of the kind adds, under fixed names: its own mass, whose size comes from its mesh.
  virtual std::vector<kinetics::EffectInfo> own_effects() const;
  /// Effects that the body adds, its own and those of its options.
  virtual std::vector<kinetics::EffectInfo> effects(const BodyScene& body) const;
  /// Forces beside the machine's loads, among the effects by their names.
  virtual std::vector<GivenForce> given_forces(const BodyScene& body) const;
  /// Tells effects of the machine which of the body's they need.
  /// @param scene  with its machine read
  /// @param table  table of the machine's effects, and of the bodies' before this one
  virtual void add_needs(const Scene& scene, std::vector<kinetics::EffectInfo>& table) const;

  // ---- Masses ----

  /// Whether the machine has a mass that is the body's: then masses can be added to the mesh, and
  /// agree_masses compares.
  virtual bool shares_masses() const;
  /// `difference_port` where the scene names none; without one the key is not read.
  virtual std::optional<std::string> usual_difference_port(const BodyScene& body) const;
  /// Reads which part of the machine an added mass counts to, if there are several.
  virtual void read_region(SceneTable& entry, AddedMass& added) const;
  /// Takes open masses from the mesh; differences to given ones become attached masses.
  /// @throws StageRefused if a difference exceeds 20 %
  virtual void agree_masses(const Scene& scene, const BodyScene& body, const MeshedBody& meshed,
                            MassAgreement& result) const;
  /// Parts of the mesh that are accelerated on their own; the whole body unless overridden.
  virtual std::vector<RegionMass> regions(const MeshedBody& meshed) const;

  // ---- Loads ----

  /// Turns the load stage's resultants into the body's channels.
  /// @param history  loads of the load stage with the machine of `masses`
  virtual BodyLoads distribute(const Scene& scene, const BodyScene& body,
                               const kinetics::LoadHistory& history, const LoadedBody& loaded,
                               const MassAgreement& masses) const = 0;
  /// The elements of a drive train that join the body to the others; none of other machines.
  virtual std::vector<ElementPort> element_ports(const BodyScene& body) const;
  /// Refuses loads that remain in directions in which the scene could name a support and does not. Most
  /// kinds get their reactions from their machine.
  /// @throws StageRefused naming the body's table, each key that is missing, the force or moment that it has
  /// to carry and what to write
  virtual void require_supports(const BodyScene& body, const BodyLoads& loads,
                                const std::vector<RegionMass>& regions) const;
  /// What to name in the body's table so that loads that do not close are carried; empty: nothing would do.
  virtual std::string missing_support(const BodyScene& body, const Closure& closure) const;
  /// Adds to the load stage's history what only the loaded body can tell: quantities with the body's own
  /// mass, and what a user of its loads should know.
  virtual void report(const Scene& scene, const BodyScene& body, const BodyLoads& loads,
                      kinetics::LoadHistory& history) const;

  // ---- What holds it ----

  /// Whether the machine's springs hold the body with their own stiffness.
  virtual bool has_elastic_feet(const BodyScene& body) const;
  /// Ports that carry the body: bearings, or the clamp of a stub axle; none of a body that floats.
  virtual std::vector<std::string> supporting_ports(const BodyScene& body) const = 0;
  /// Whether those ports hold it in all directions; else they are pins, free to tilt.
  virtual bool is_clamped(const BodyScene& body) const;
  /// Revolutions per second of the body's axes against what holds it; 0: they do not turn.
  virtual double spin_Hz(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& loads) const;
  /// The same where the scene leaves it open: all that it may be, ascending; else that one.
  virtual std::vector<double> spins_Hz(const Scene& scene, const BodyScene& body,
                                       const kinetics::LoadHistory& loads) const;
};

/// Kinds in the order of BodyOptions.
const std::vector<const BodyKind*>& body_kinds();

const BodyKind& kind_of(const BodyScene& body);

}  // namespace pipelines
