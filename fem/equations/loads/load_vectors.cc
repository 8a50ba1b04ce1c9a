#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "fem/equations/loads/surface_loads.h"

namespace fem {

Eigen::VectorXd body_force(const NodeIntegrals& integrals, double density_kg_m3, BodyForce::Field field) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * integrals.rows());
  for (Eigen::Index i = 0; i < integrals.rows(); ++i) {
    const double v = integrals(i, 0), vx = integrals(i, 1), vy = integrals(i, 2);
    auto f = force.segment<3>(3 * i);
    switch (field) {
      case BodyForce::Field::translation_x:
        f << v, 0, 0;
        break;
      case BodyForce::Field::translation_y:
        f << 0, v, 0;
        break;
      case BodyForce::Field::translation_z:
        f << 0, 0, v;
        break;
      case BodyForce::Field::rotation:
        f << -vy, vx, 0;
        break;
      case BodyForce::Field::spin:
        f << vx, vy, 0;
        break;
    }
  }
  return density_kg_m3 * force;
}

namespace {

/// Fills one column; remembers the surfaces it has met.
class Columns {
public:
  Columns(const Grid& grid, const NodeIntegrals& integrals, double density_kg_m3)
      : grid_(grid), integrals_(integrals), density_kg_m3_(density_kg_m3) {}

  void fill(const SurfaceResultant& load, Eigen::Ref<Eigen::VectorXd> column) {
    const auto& surface = find(load.surface);
    column = surface.on_body(surface.resultant(load.component));
  }
  void fill(const SeatPressure& load, Eigen::Ref<Eigen::VectorXd> column) {
    const auto& surface = find(load.surface);
    column = surface.on_body(surface.pressure(load));
  }
  void fill(const BodyForce& load, Eigen::Ref<Eigen::VectorXd> column) {
    column = body_force(integrals_over(load.volume_ids), density_kg_m3_, load.field);
  }

private:
  const LoadedSurface& find(const LoadSurface& wanted) {
    for (const auto& known : surfaces_)
      if (same_surface(known->surface(), wanted)) return *known;
    surfaces_.push_back(std::make_unique<LoadedSurface>(grid_, wanted));
    return *surfaces_.back();
  }
  const NodeIntegrals& integrals_over(const std::vector<int>& volume_ids) {
    if (volume_ids.empty()) return integrals_;
    auto [known, is_new] = regions_.try_emplace(volume_ids);
    if (is_new) known->second = integrate_nodes(grid_, volume_ids);
    return known->second;
  }

  const Grid& grid_;
  const NodeIntegrals& integrals_;
  double density_kg_m3_;
  std::vector<std::unique_ptr<LoadedSurface>> surfaces_;
  std::map<std::vector<int>, NodeIntegrals> regions_;
};

}  // namespace

void check_channels(const std::vector<UnitLoad>& loads) {
  if (loads.empty()) throw std::invalid_argument("no unit loads: nothing to solve");
  std::set<std::string> channels;
  for (const auto& load : loads) {
    if (load.channel.empty()) throw std::invalid_argument("a unit load without a channel name");
    if (!channels.insert(load.channel).second)
      throw std::invalid_argument("channel " + load.channel + " appears twice among the unit loads");
  }
}

Eigen::MatrixXd load_vectors(const Grid& grid, const NodeIntegrals& integrals, double density_kg_m3,
                             const std::vector<UnitLoad>& loads) {
  check_channels(loads);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * grid.n_nodes, loads.size());
  Columns columns(grid, integrals, density_kg_m3);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    try {
      std::visit([&](const auto& shape) { columns.fill(shape, force.col(k)); }, loads[k].shape);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("channel " + loads[k].channel + ": " + error.what());
    }
  }
  return force;
}

std::vector<int> loaded_groups(const std::vector<UnitLoad>& loads, const Body& body) {
  std::vector<int> groups;
  for (const auto& spring : body.elastic_supports) groups.push_back(spring.surface.boundary_id);
  for (const auto& clamp : body.clamps) groups.push_back(clamp.boundary_id);
  for (const auto& load : loads)
    if (const auto* surface = surface_of(load)) groups.push_back(surface->boundary_id);
  return groups;
}

Eigen::MatrixXd unit_resultants(const Grid& grid, const LoadSurface& surface) {
  const LoadedSurface loaded(grid, surface);
  Eigen::MatrixXd force(3 * grid.n_nodes, 6);
  for (int c = 0; c < 6; ++c) force.col(c) = loaded.on_body(loaded.resultant(SurfaceResultant::Component(c)));
  return force;
}

const LoadSurface* surface_of(const UnitLoad& load) {
  if (const auto* resultant = std::get_if<SurfaceResultant>(&load.shape)) return &resultant->surface;
  if (const auto* pressure = std::get_if<SeatPressure>(&load.shape)) return &pressure->surface;
  return nullptr;
}

}  // namespace fem
