#include "fem/stress/recovery/volumetric_stress.h"

#include <algorithm>

#include "fem/base/common/dense_algebra.h"
#include "fem/base/common/parallel.h"
#include "fem/mesh/grid/reference_cell.h"

namespace fem {

namespace {

/// lambda div u of a tensor made by Hooke's law: tr sigma = (3 lambda + 2 mu) div u.
template <typename Tensor>
double volumetric_part(const Tensor& stress, const Lame& elastic) {
  return elastic.lambda_Pa / (3 * elastic.lambda_Pa + 2 * elastic.mu_Pa) *
         (stress[0] + stress[1] + stress[2]);
}

/// The monomials up to a degree in all directions together: points x monomials.
Eigen::MatrixXd monomials(const Points& points, int degree) {
  Eigen::MatrixXd values(points.cols(), (degree + 1) * (degree + 2) * (degree + 3) / 6);
  Eigen::Index column = 0;
  for (int c = 0; c <= degree; ++c)
    for (int b = 0; b + c <= degree; ++b)
      for (int a = 0; a + b + c <= degree; ++a)
        values.col(column++) =
            points.row(0).array().pow(a) * points.row(1).array().pow(b) * points.row(2).array().pow(c);
  return values;
}

/// lambda div u of one cell at a time: projected, and taken at a few points.
class Projection {
public:
  Projection(const Grid& grid, const PerCell<Lame>& elastic, const ConstBlock& displacement)
      : grid_(grid),
        elastic_(elastic),
        degree_(std::max(grid.degree - 2, 0)),
        centre_(gauss_in_cell(grid.shape(), 1)),
        from_(gauss_in_cell(grid.shape(), grid.degree + 1)),
        to_(gauss_in_cell(grid.shape(), degree_ + 1)),
        stress_(grid, from_, elastic, displacement),
        of_cell_(from_.n_points, 2 * displacement.cols()),
        volumetric_(from_.n_points, displacement.cols() / 3) {}

  int n_points() const { return to_.n_points; }

  /// @param places  3 x n_points
  /// @param values  n_points x 6 K
  void operator()(std::size_t cell, Eigen::Ref<Points> places, Eigen::Ref<RowMajor> values) {
    stress_(cell, of_cell_);
    Eigen::VectorXd volume(from_.n_points);
    Points points(3, from_.n_points);
    for (int q = 0; q < from_.n_points; ++q) {
      volume[q] = jacobian(grid_, cell, from_, q).determinant() * from_.weight[q];
      points.col(q) = position(grid_, cell, from_, q);
      for (Eigen::Index k = 0; k < volumetric_.cols(); ++k)
        volumetric_(q, k) = volumetric_part(&of_cell_(q, 6 * k), elastic_[cell]);
    }
    // A mean stands for the centre of the volume: what is linear in space stays so on cells of any shape.
    const Eigen::Vector3d middle = points * volume / volume.sum();
    for (int q = 0; q < to_.n_points; ++q)
      places.col(q) = degree_ == 0 ? middle : position(grid_, cell, to_, q);
    const Eigen::Matrix3d to_unit = jacobian(grid_, cell, centre_, 0).inverse();
    const Eigen::MatrixXd basis = monomials(to_unit * (points.colwise() - middle), degree_);
    const Eigen::MatrixXd weighted = volume.asDiagonal() * basis;
    const Eigen::MatrixXd projected = product(
        monomials(to_unit * (places.colwise() - middle), degree_),
        solve_symmetric(transposed_product(weighted, basis), transposed_product(weighted, volumetric_)));
    values.setZero();
    for (Eigen::Index q = 0; q < projected.rows(); ++q)
      for (Eigen::Index k = 0; k < projected.cols(); ++k)
        values.block<1, 3>(q, 6 * k).setConstant(projected(q, k));
  }

private:
  const Grid& grid_;
  PerCell<Lame> elastic_;
  int degree_;
  Tabulation centre_, from_, to_;
  CellStress stress_;
  RowMajor of_cell_;
  Eigen::MatrixXd volumetric_;
};

}  // namespace

bool any_hardly_compresses(const Grid& grid, const PerCell<Lame>& elastic) {
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    if (hardly_compresses(elastic[c])) return true;
  return false;
}

VolumetricStress separate_volumetric(const Grid& grid, const PerCell<Lame>& elastic,
                                     const ConstBlock& displacement, const StressSamples& samples,
                                     RowMajor& stress) {
  const int n_in_cell = Projection(grid, elastic, displacement).n_points();
  const auto n_inside = grid.n_cells() * std::size_t(stress_points_in_cell(grid.shape()).n_points);
  std::vector<std::int32_t> cells;
  VolumetricStress result;
  result.samples.of_cell.resize(grid.n_cells());
  const auto add = [&](std::int32_t cell) {
    result.samples.of_cell[cell].push_back(static_cast<std::int32_t>(result.samples.cell.size()));
    result.samples.cell.push_back(cell);
  };
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    if (hardly_compresses(elastic[c])) {
      cells.push_back(static_cast<std::int32_t>(c));
      for (int q = 0; q < n_in_cell; ++q) add(cells.back());
    }
  std::vector<std::size_t> on_faces;
  for (std::size_t s = n_inside; s < samples.cell.size(); ++s)
    if (hardly_compresses(elastic[std::size_t(samples.cell[s])])) {
      on_faces.push_back(s);
      add(samples.cell[s]);
    }
  result.samples.position.resize(3, result.samples.cell.size());
  result.values.resize(result.samples.cell.size(), stress.cols());

  parallel_for(cells.size(), 32, [&](std::size_t begin, std::size_t end) {
    Projection project(grid, elastic, displacement);
    for (std::size_t c = begin; c < end; ++c) {
      const auto first = static_cast<Eigen::Index>(c) * n_in_cell;
      project(std::size_t(cells[c]), result.samples.position.middleCols(first, n_in_cell),
              result.values.middleRows(first, n_in_cell));
    }
  });
  const auto take_out = [&](std::size_t sample, double* parts) {
    const Lame own = elastic[std::size_t(samples.cell[sample])];
    for (Eigen::Index k = 0; 6 * k < stress.cols(); ++k) {
      const double part = volumetric_part(&stress(sample, 6 * k), own);
      for (int d = 0; d < 3; ++d) stress(sample, 6 * k + d) -= part;
      if (parts != nullptr) std::fill(parts + 6 * k, parts + 6 * k + 3, part);
    }
  };
  parallel_for(n_inside, 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      if (hardly_compresses(elastic[std::size_t(samples.cell[s])])) take_out(s, nullptr);
  });
  for (std::size_t i = 0; i < on_faces.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(cells.size() * std::size_t(n_in_cell) + i);
    result.samples.position.col(row) = samples.position.col(on_faces[i]);
    result.values.row(row).setZero();
    take_out(on_faces[i], &result.values(row, 0));
  }
  return result;
}

}  // namespace fem
