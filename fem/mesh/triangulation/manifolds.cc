#include "fem/mesh/triangulation/manifolds.h"

#include <deal.II/grid/manifold.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include "fem/base/values/constants.h"
#include "fem/mesh/grid/charts.h"

namespace fem {

namespace {

constexpr double two_pi = 2 * pi;

/// Means are taken in the chart's coordinates; the periods keep them from going the long way round.
template <typename Chart>
class ChartOfBody final : public dealii::ChartManifold<3, 3, 3> {
public:
  ChartOfBody(const Chart& chart, const dealii::Tensor<1, 3>& periods)
      : ChartManifold<3, 3, 3>(periods), chart_(chart) {}
  std::unique_ptr<dealii::Manifold<3, 3>> clone() const override {
    return std::make_unique<ChartOfBody>(chart_, get_periodicity());
  }
  dealii::Point<3> pull_back(const dealii::Point<3>& x) const override {
    return to_point(fem::pull_back(chart_, Coordinates{x[0], x[1], x[2]}));
  }
  dealii::Point<3> push_forward(const dealii::Point<3>& c) const override {
    return to_point(fem::push_forward(chart_, Coordinates{c[0], c[1], c[2]}));
  }

private:
  static dealii::Point<3> to_point(const Coordinates& x) { return {x[0], x[1], x[2]}; }
  Chart chart_;
};

}  // namespace

void attach_charts(dealii::Triangulation<3>& mesh, std::vector<CylinderChart> cylinders,
                   std::vector<TorusChart> tori) {
  std::sort(cylinders.begin(), cylinders.end(),
            [](const auto& a, const auto& b) { return a.volume_id < b.volume_id; });
  std::sort(tori.begin(), tori.end(),
            [](const auto& a, const auto& b) { return a.boundary_id < b.boundary_id; });

  for (const auto& cell : mesh.active_cell_iterators())
    cell->set_all_manifold_ids(dealii::numbers::flat_manifold_id);

  dealii::types::manifold_id manifold = 0;
  for (const auto& chart : cylinders) {
    refuse_impossible(chart);
    bool found = false;
    for (const auto& cell : mesh.active_cell_iterators())
      if (static_cast<int>(cell->material_id()) == chart.volume_id) {
        cell->set_all_manifold_ids(manifold);
        found = true;
      }
    if (!found)
      throw std::invalid_argument("chart of volume " + std::to_string(chart.volume_id) +
                                  ": the mesh has no cells in this physical group");
    mesh.set_manifold(manifold++, ChartOfBody(chart, dealii::Tensor<1, 3>({0., two_pi, 0.})));
  }
  for (const auto& chart : tori) {
    refuse_impossible(chart);
    bool found = false;
    for (const auto& cell : mesh.active_cell_iterators())
      for (const auto f : cell->face_indices())
        if (const auto face = cell->face(f);
            face->at_boundary() && static_cast<int>(face->boundary_id()) == chart.boundary_id) {
          face->set_all_manifold_ids(manifold);
          found = true;
        }
    if (!found)
      throw std::invalid_argument("torus of boundary group " + std::to_string(chart.boundary_id) +
                                  ": the mesh has no faces in this physical group");
    mesh.set_manifold(manifold++, ChartOfBody(chart, dealii::Tensor<1, 3>({0., two_pi, two_pi})));
  }
}

}  // namespace fem
