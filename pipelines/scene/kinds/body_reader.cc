/// What most kinds of bodies have in common in a scene.
#include "pipelines/scene/whole/body_reader.h"

#include "pipelines/scene/bodies/scene_body.h"

namespace pipelines {

BodyShape BodyReader::read_shape(SceneTable& table, const Scene& scene, const BodyScene& body,
                                 SceneFindings& findings) const {
  return read_shaft_shape(table, contour_rules(scene, body), findings);
}

void BodyReader::check_ports(SceneTable&, const BodyScene&) const {}

std::optional<double> BodyReader::seat_speed_rad_s(const Scene&, const BodyScene&) const {
  return std::nullopt;
}

std::vector<kinetics::EffectInfo> BodyReader::own_effects() const {
  return {};
}

std::vector<kinetics::EffectInfo> BodyReader::effects(const BodyScene&) const {
  return own_effects();
}

std::vector<GivenForce> BodyReader::given_forces(const BodyScene&) const {
  return {};
}

void BodyReader::add_needs(const Scene&, std::vector<kinetics::EffectInfo>&) const {}

bool BodyReader::shares_masses() const {
  return false;
}

std::optional<std::string> BodyReader::usual_difference_port(const BodyScene&) const {
  return std::nullopt;
}

void BodyReader::read_region(SceneTable&, AddedMass&) const {}

bool BodyReader::has_elastic_feet(const BodyScene&) const {
  return false;
}

bool BodyReader::is_clamped(const BodyScene&) const {
  return false;
}

}  // namespace pipelines
