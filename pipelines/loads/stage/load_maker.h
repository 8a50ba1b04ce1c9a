/// What is particular to one kind of body in its loads: which enter where, what of its mesh is the machine's,
/// how fast it turns. The rooms ask the maker and compare no kinds; every kind is one file in
/// pipelines/loads/bodies, listed by loads/bodies/table.cc. How the scene describes it is said by
/// scene/whole/body_reader.h.
#pragma once

#include <string>
#include <vector>

#include "kinetics/values/load_history.h"
#include "pipelines/scene/values/body_scene.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

struct BodyLoads;
struct Closure;
struct LoadedBody;
struct MassAgreement;
struct MeshedBody;
struct RegionMass;

/// Port where the torque of an element of the machine enters a body, and the role of that torque in load
/// histories.
struct ElementPort {
  std::string element, port, role;
};

class LoadMaker {
public:
  virtual ~LoadMaker() = default;

  // ---- Masses ----

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
  /// Quantities of the loaded body, with its own mass, that stand beside those of the load stage.
  virtual std::vector<kinetics::Quantity> quantities(const BodyLoads& loads) const;
  /// What a user of the body's loads should know; empty: nothing.
  virtual std::string warning(const Scene& scene, const BodyScene& body, const BodyLoads& loads) const;

  // ---- Speed ----

  /// Revolutions per second of the body's axes against what holds it; 0: they do not turn.
  virtual double spin_Hz(const Scene& scene, const BodyScene& body, const kinetics::LoadHistory& loads) const;
  /// The same where the scene leaves it open: all that it may be, ascending; else that one.
  virtual std::vector<double> spins_Hz(const Scene& scene, const BodyScene& body,
                                       const kinetics::LoadHistory& loads) const;
  /// Which way the body's axes turn about z: 1 counter-clockwise, -1 clockwise, 0 where the scene leaves it
  /// open.
  virtual int turning(const Scene& scene, const BodyScene& body) const;
};

const LoadMaker& load_maker_of(const BodyScene& body);

}  // namespace pipelines
