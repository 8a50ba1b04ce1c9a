#include "fem/stress/cells/energy_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/base/common/parallel.h"
#include "fem/mesh/grid/reference_cell.h"
#include "fem/mesh/ranks/ranks.h"

namespace fem {

namespace {

/// Irons' fourteen points in a hexahedron (Int. J. Numer. Meth. Engng 3, 1971), exact to degree 5 in all
/// directions together: the squared error of quadratic cells has degree 4. Half as many as Gauss points.
Tabulation fourteen_points() {
  constexpr double near_faces = 320. / 361, near_corners = 121. / 361;  // of a cube of volume 8
  const double b = std::sqrt(19. / 30), c = std::sqrt(19. / 33);
  ReferencePoints points;
  std::vector<double> weights;
  const auto add = [&](double x, double y, double z, double weight) {
    points.push_back({(1 + x) / 2, (1 + y) / 2, (1 + z) / 2});
    weights.push_back(weight / 8);
  };
  for (const double s : {-1., 1.}) {
    add(s * b, 0, 0, near_faces);
    add(0, s * b, 0, near_faces);
    add(0, 0, s * b, near_faces);
    for (const double y : {-c, c})
      for (const double z : {-c, c}) add(s * c, y, z, near_corners);
  }
  return tabulate_in_cell({CellKind::hexahedra, 2}, points, weights);
}

Tabulation energy_points(CellShape shape) {
  if (!shape.is_tetrahedron() && shape.degree == 2) return fourteen_points();
  return gauss_in_cell(shape, shape.degree + 1);
}

/// Sums of products over some cells.
struct Products {
  Eigen::MatrixXd energy, error;  // K x K, lower triangles
};

/// Takes cell after cell; keeps its work space.
class CellEnergies {
public:
  CellEnergies(const Grid& grid, const Tabulation& at, const PerCell<Lame>& elastic,
               const ConstBlock& displacement, const ConstBlock& stress, const Eigen::VectorXd& scale)
      : grid_(grid),
        at_(at),
        elastic_(elastic),
        recovered_(stress),
        scale_(scale),
        of_cell_(grid, at, elastic, displacement),
        values_(at.value.data(), at.n_points, at.n_shapes),
        own_(at.n_points, stress.cols()),
        nodal_(at.n_shapes, stress.cols()),
        better_(at.n_points, stress.cols()),
        weight_(at.n_points) {}

  /// @param parts  K sums over the cell of the squared error
  void add(std::size_t cell, Products& products, double* parts) {
    of_cell_(cell, own_);
    const auto* nodes = grid_.nodes_of(cell);
    for (int i = 0; i < at_.n_shapes; ++i) nodal_.row(i) = recovered_.row(nodes[i]);
    better_.noalias() = values_ * nodal_;
    better_ -= own_;
    for (int q = 0; q < at_.n_points; ++q)
      weight_[q] =
          std::sqrt(jacobian(grid_, cell, at_, q).determinant() * at_.weight[q] / (2 * elastic_[cell].mu_Pa));
    to_energy(cell, own_);
    products.energy.selfadjointView<Eigen::Lower>().rankUpdate(columns_.transpose());
    to_energy(cell, better_);
    products.error.selfadjointView<Eigen::Lower>().rankUpdate(columns_.transpose());
    Eigen::Map<Eigen::RowVectorXd>(parts, columns_.cols()) = columns_.colwise().squaredNorm();
  }

private:
  /// Columns whose products are the integrals of s : C^-1 t. With c = lambda / (3 lambda + 2 mu) that is
  /// (s : t - c tr s tr t) / 2 mu, and s + g tr s I has just this product with itself for 3 g^2 + 2 g + c =
  /// 0.
  void to_energy(std::size_t cell, const RowMajor& stress) {
    const Lame elastic = elastic_[cell];
    const double g = (std::sqrt(2 * elastic.mu_Pa / (3 * elastic.lambda_Pa + 2 * elastic.mu_Pa)) - 1) / 3;
    const Eigen::Index n_loads = stress.cols() / 6;
    columns_.resize(6 * at_.n_points, n_loads);
    for (int q = 0; q < at_.n_points; ++q) {
      for (Eigen::Index k = 0; k < n_loads; ++k) {
        const double* s = &stress(q, 6 * k);
        const double factor = weight_[q] * scale_[k], shift = g * (s[0] + s[1] + s[2]);
        double* column = &columns_(6 * q, k);
        for (int d = 0; d < 3; ++d) column[d] = factor * (s[d] + shift);
        for (int d = 3; d < 6; ++d) column[d] = factor * std::sqrt(2.0) * s[d];
      }
    }
  }

  const Grid& grid_;
  const Tabulation& at_;
  PerCell<Lame> elastic_;
  ConstBlock recovered_;
  const Eigen::VectorXd& scale_;
  CellStress of_cell_;
  Eigen::Map<const RowMajor> values_;
  RowMajor own_, nodal_, better_;
  Eigen::MatrixXd columns_;
  Eigen::VectorXd weight_;
};

/// Largest stress of each load case.
Eigen::VectorXd largest_of(const ConstBlock& stress) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(stress.cols() / 6);
  if (stress.rows() > 0)
    for (Eigen::Index k = 0; k < largest.size(); ++k)
      largest[k] = stress.middleCols(6 * k, 6).cwiseAbs().maxCoeff();
  return largest;
}

/// Squares of neither small nor large stresses may leave the range of numbers.
Eigen::VectorXd to_unit_size(Eigen::VectorXd largest) {
  for (double& scale : largest)
    scale = scale > 0 && std::isfinite(scale) ? std::ldexp(1.0, -std::ilogb(scale)) : 1.0;
  return largest;
}

/// Sums over some cells.
/// @param of_cells  their rows are written
Products sum_over_cells(const Grid& grid, const PerCell<Lame>& elastic, const ConstBlock& displacement,
                        const ConstBlock& stress, const Eigen::VectorXd& scale,
                        const std::vector<std::size_t>& counted, std::vector<double>& of_cells) {
  const Tabulation at = energy_points(grid.shape());
  const Eigen::Index n_loads = scale.size();
  // Sums over blocks of fixed size, then over blocks: the same for every number of threads.
  constexpr std::size_t block = 256;
  const std::size_t n_blocks = (counted.size() + block - 1) / block;
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(n_loads, n_loads);
  std::vector<Products> sums(n_blocks, Products{zero, zero});
  parallel_for(n_blocks, 1, [&](std::size_t begin, std::size_t end) {
    CellEnergies cells(grid, at, elastic, displacement, stress, scale);
    for (std::size_t b = begin; b < end; ++b)
      for (std::size_t i = b * block; i < std::min((b + 1) * block, counted.size()); ++i)
        cells.add(counted[i], sums[b], &of_cells[counted[i] * std::size_t(n_loads)]);
  });
  Products total{zero, zero};
  for (const auto& part : sums) {
    total.energy += part.energy;
    total.error += part.error;
  }
  return total;
}

/// In units of the loads' own norms.
EnergyError in_own_norms(const Products& total, const Eigen::VectorXd& scale, std::vector<double> of_cells) {
  const Eigen::Index n_loads = scale.size();
  EnergyError result;
  result.of_cells = std::move(of_cells);
  const Eigen::VectorXd norm = total.energy.diagonal().cwiseSqrt();
  const auto unit = [](double n) { return n > 0 ? 1 / n : 0.0; };
  result.norm_sqrtJ.resize(std::size_t(n_loads));
  result.energy.resize(std::size_t(n_loads * n_loads));
  result.error.resize(std::size_t(n_loads * n_loads));
  for (Eigen::Index k = 0; k < n_loads; ++k) {
    result.norm_sqrtJ[std::size_t(k)] = norm[k] / scale[k];
    for (Eigen::Index l = 0; l < n_loads; ++l) {
      const auto low = std::max(k, l), high = std::min(k, l);
      const double units = unit(norm[k]) * unit(norm[l]);
      result.energy[std::size_t(k * n_loads + l)] = units * total.energy(low, high);
      result.error[std::size_t(k * n_loads + l)] = units * total.error(low, high);
    }
    for (std::size_t i = std::size_t(k); i < result.of_cells.size(); i += std::size_t(n_loads))
      result.of_cells[i] *= unit(norm[k]) * unit(norm[k]);
  }
  return result;
}

}  // namespace

EnergyError energy_error(const Grid& grid, const PerCell<Lame>& elastic, const ConstBlock& displacement,
                         const ConstBlock& stress, const MirrorPlane* plane) {
  const Eigen::VectorXd scale = to_unit_size(largest_of(stress));
  const auto n_loads = std::size_t(scale.size());
  std::vector<double> of_cells(grid.n_cells() * n_loads);
  std::vector<std::size_t> counted;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    if (plane == nullptr || std::size_t(plane->cell[c]) > c) counted.push_back(c);
  auto total = sum_over_cells(grid, elastic, displacement, stress, scale, counted, of_cells);
  if (plane != nullptr) {
    for (const auto c : counted)
      std::copy_n(&of_cells[c * n_loads], n_loads, &of_cells[std::size_t(plane->cell[c]) * n_loads]);
    total.energy *= 2;
    total.error *= 2;
  }
  return in_own_norms(total, scale, std::move(of_cells));
}

EnergyError energy_error_on_ranks(MPI_Comm communicator, const StiffnessShare& part, std::size_t n_cells,
                                  const ConstBlock& displacement, const ConstBlock& stress) {
  Eigen::VectorXd largest = largest_of(stress);
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), int(largest.size()), MPI_DOUBLE, MPI_MAX, communicator);
  const Eigen::VectorXd scale = to_unit_size(largest);
  const auto n_loads = std::size_t(scale.size());
  std::vector<std::size_t> counted;
  for (std::size_t c = 0; c < part.elastic.size(); ++c)
    if (has_stiffness(part.elastic[c])) counted.push_back(c);
  std::vector<double> of_part(part.elastic.size() * n_loads);
  auto total = sum_over_cells(part.part.grid, cell_after_cell(part.elastic), displacement, stress, scale,
                              counted, of_part);
  for (auto* products : {&total.energy, &total.error})
    sum_over_ranks(communicator, products->data(), std::size_t(products->size()));
  std::vector<double> of_cells(n_cells * n_loads, 0.0);
  for (const auto c : counted)
    std::copy_n(&of_part[c * n_loads], n_loads, &of_cells[std::size_t(part.part.cell[c]) * n_loads]);
  complete(communicator, of_cells);
  return in_own_norms(total, scale, std::move(of_cells));
}

EnergyNorms energy_norms(const EnergyError& channels, const std::vector<double>& factors) {
  const std::size_t n = channels.norm_sqrtJ.size();
  double largest = 0;
  std::vector<double> share(n);
  for (std::size_t k = 0; k < n; ++k) {
    share[k] = factors.at(k) * channels.norm_sqrtJ[k];
    largest = std::max(largest, std::abs(share[k]));
  }
  if (!(largest > 0)) return {};
  double energy = 0, error = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t l = 0; l < n; ++l) {
      const double product = share[k] / largest * (share[l] / largest);
      energy += product * channels.energy[k * n + l];
      error += product * channels.error[k * n + l];
    }
  return {largest * std::sqrt(std::max(energy, 0.0)), largest * std::sqrt(std::max(error, 0.0))};
}

double EnergyNorms::relative() const {
  const double exact = std::hypot(solution_sqrtJ, error_sqrtJ);
  return exact > 0 ? error_sqrtJ / exact : 0;
}

}  // namespace fem
