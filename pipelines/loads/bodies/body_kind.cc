/// What most kinds of bodies have in common.
#include "pipelines/scene/whole/body_kind.h"

#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/bodies/scene_body.h"

namespace pipelines {

BodyShape BodyKind::read_shape(SceneTable& table, const Scene& scene, const BodyScene& body,
                               SceneFindings& findings) const {
  return read_shaft_shape(table, contour_rules(scene, body), findings);
}

void BodyKind::check_ports(SceneTable&, const BodyScene&) const {}

std::optional<double> BodyKind::seat_speed_rad_s(const Scene&, const BodyScene&) const {
  return std::nullopt;
}

std::vector<kinetics::EffectInfo> BodyKind::own_effects() const {
  return {};
}

std::vector<kinetics::EffectInfo> BodyKind::effects(const BodyScene&) const {
  return own_effects();
}

std::vector<GivenForce> BodyKind::given_forces(const BodyScene&) const {
  return {};
}

void BodyKind::add_needs(const Scene&, std::vector<kinetics::EffectInfo>&) const {}

bool BodyKind::shares_masses() const {
  return false;
}

std::optional<std::string> BodyKind::usual_difference_port(const BodyScene&) const {
  return std::nullopt;
}

void BodyKind::read_region(SceneTable&, AddedMass&) const {}

void BodyKind::agree_masses(const Scene&, const BodyScene&, const MeshedBody&, MassAgreement&) const {}

std::vector<RegionMass> BodyKind::regions(const MeshedBody& meshed) const {
  return {{"", {}, meshed.masses}};
}

std::vector<ElementPort> BodyKind::element_ports(const BodyScene&) const {
  return {};
}

void BodyKind::require_supports(const BodyScene&, const BodyLoads&, const std::vector<RegionMass>&) const {}

std::string BodyKind::missing_support(const BodyScene&, const Closure&) const {
  return {};
}

void BodyKind::report(const Scene&, const BodyScene&, const BodyLoads&, kinetics::LoadHistory&) const {}

bool BodyKind::has_elastic_feet(const BodyScene&) const {
  return false;
}

bool BodyKind::is_clamped(const BodyScene&) const {
  return false;
}

double BodyKind::spin_Hz(const Scene&, const BodyScene&, const kinetics::LoadHistory&) const {
  return 0;
}

std::vector<double> BodyKind::spins_Hz(const Scene& scene, const BodyScene& body,
                                       const kinetics::LoadHistory& loads) const {
  return {spin_Hz(scene, body, loads)};
}

}  // namespace pipelines
