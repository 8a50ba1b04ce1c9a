/// What most kinds of bodies have in common in their loads.
#include "pipelines/loads/stage/load_maker.h"

#include "pipelines/loads/stage/body_mesh.h"

namespace pipelines {

void LoadMaker::agree_masses(const Scene&, const BodyScene&, const MeshedBody&, MassAgreement&) const {}

std::vector<RegionMass> LoadMaker::regions(const MeshedBody& meshed) const {
  return {{"", {}, meshed.masses}};
}

std::vector<ElementPort> LoadMaker::element_ports(const BodyScene&) const {
  return {};
}

void LoadMaker::require_supports(const BodyScene&, const BodyLoads&, const std::vector<RegionMass>&) const {}

std::string LoadMaker::missing_support(const BodyScene&, const Closure&) const {
  return {};
}

std::vector<kinetics::Quantity> LoadMaker::quantities(const BodyLoads&) const {
  return {};
}

std::string LoadMaker::warning(const Scene&, const BodyScene&, const BodyLoads&) const {
  return {};
}

double LoadMaker::spin_Hz(const Scene&, const BodyScene&, const kinetics::LoadHistory&) const {
  return 0;
}

std::vector<double> LoadMaker::spins_Hz(const Scene& scene, const BodyScene& body,
                                        const kinetics::LoadHistory& loads) const {
  return {spin_Hz(scene, body, loads)};
}

int LoadMaker::turning(const Scene&, const BodyScene&) const {
  return 0;
}

}  // namespace pipelines
