/// What is particular to one kind of body, a vibratory mill's shaft or a planetary mill's drum, in the scene:
/// the keys that describe it, its effects, whose masses it shares, what carries it. The rooms ask the reader
/// and compare no kinds; every kind is one file in pipelines/scene/kinds, listed by scene/kinds/table.cc.
/// What loads enter it is said by loads/stage/load_maker.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinetics/values/effect_info.h"
#include "pipelines/scene/values/body_scene.h"
#include "pipelines/scene/whole/machine.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

struct ContourRules;

class BodyReader {
public:
  virtual ~BodyReader() = default;

  // ---- The tables ----

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

  // ---- What holds it ----

  /// Whether the machine's springs hold the body with their own stiffness.
  virtual bool has_elastic_feet(const BodyScene& body) const;
  /// Ports that carry the body: bearings, or the clamp of a stub axle; none of a body that floats.
  virtual std::vector<std::string> supporting_ports(const BodyScene& body) const = 0;
  /// Whether those ports hold it in all directions; else they are pins, free to tilt.
  virtual bool is_clamped(const BodyScene& body) const;
};

/// Readers in the order of BodyOptions.
const std::vector<const BodyReader*>& body_readers();

const BodyReader& reader_of(const BodyScene& body);

}  // namespace pipelines
