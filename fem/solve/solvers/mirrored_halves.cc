#include "fem/solve/solvers/mirrored_halves.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fem/equations/loads/supports.h"

namespace fem {

namespace {

/// A part of a load below this share is none: a hundredth of the residual that the solver accepts.
constexpr double no_part = 1e-2 * acceptable_residual;

std::vector<std::int32_t> cells_above(const Grid& whole, const MirrorPlane& plane) {
  std::vector<std::int32_t> cells;
  for (std::size_t c = 0; c < whole.n_cells(); ++c) {
    double height_m = 0;
    for (int i = 0; i < whole.nodes_per_cell(); ++i)
      height_m += whole.position(whole.nodes_of(c)[i])[plane.axis] - plane.place_m;
    if (height_m > 0) cells.push_back(std::int32_t(c));
  }
  return cells;
}

double sign_of(Parity parity, bool across) {
  return (parity == Parity::even) == across ? -1 : 1;
}

/// The loads that have a part of one parity, by column, and these parts on the half.
struct PartLoads {
  std::vector<Eigen::Index> columns;
  Eigen::MatrixXd force;
};

PartLoads part_loads(const MirroredHalf& half, const BalancedLoads& loads, Parity parity) {
  const Eigen::MatrixXd all = half.part(loads.force, parity);
  PartLoads result;
  for (Eigen::Index k = 0; k < all.cols(); ++k)
    if (all.col(k).norm() > no_part * loads.norm[k]) result.columns.push_back(k);
  result.force = all(Eigen::all, result.columns);
  return result;
}

/// The factors of both parities; a missing one is one that no load has.
class FactorisedHalves : public FactorisedBody {
public:
  FactorisedHalves(const MirroredHalf& half, std::array<std::shared_ptr<const FactorisedBody>, 2> factors)
      : half_(half), factors_(std::move(factors)) {}

  Eigen::MatrixXd solve(const Eigen::MatrixXd& force) const override {
    Eigen::MatrixXd displacement = Eigen::MatrixXd::Zero(force.rows(), force.cols());
    std::vector<Eigen::Index> all(std::size_t(force.cols()));
    std::iota(all.begin(), all.end(), 0);
    for (const auto parity : {Parity::even, Parity::odd})
      if (const auto& factor = factors_[std::size_t(parity)])
        half_.add_to_whole(factor->solve(half_.part(force, parity)), parity, all, displacement);
    return displacement;
  }

  bool takes_even_loads_only() const override { return !factors_[std::size_t(Parity::odd)]; }

private:
  const MirroredHalf& half_;
  std::array<std::shared_ptr<const FactorisedBody>, 2> factors_;
};

}  // namespace

MirroredHalf::MirroredHalf(const Grid& whole, MirrorPlane plane)
    : plane_(std::move(plane)),
      half_(make_subdomain(whole, cells_above(whole, plane_))),
      cells_(cells_of_nodes(half_.grid)),
      colours_(colour_cells(half_.grid, cells_)) {}

Eigen::MatrixXd MirroredHalf::part(const Eigen::MatrixXd& force, Parity parity) const {
  Eigen::MatrixXd result(3 * Eigen::Index(half_.node.size()), force.cols());
  for (Eigen::Index k = 0; k < force.cols(); ++k)
    for (std::size_t i = 0; i < half_.node.size(); ++i) {
      const auto node = Eigen::Index(half_.node[i]), image = Eigen::Index(plane_.node[std::size_t(node)]);
      // In the plane a half carries half of the force.
      const double share = image == node ? 0.25 : 0.5;
      for (int d = 0; d < 3; ++d)
        result(3 * Eigen::Index(i) + d, k) =
            share * (force(3 * node + d, k) + sign_of(parity, d == plane_.axis) * force(3 * image + d, k));
    }
  return result;
}

void MirroredHalf::make_even(Eigen::MatrixXd& force) const {
  for (Eigen::Index k = 0; k < force.cols(); ++k)
    for (const auto i : half_.node) {
      const auto node = Eigen::Index(i), image = Eigen::Index(plane_.node[std::size_t(i)]);
      for (int d = 0; d < 3; ++d) {
        const double sign = sign_of(Parity::even, d == plane_.axis);
        const double mean = (force(3 * node + d, k) + sign * force(3 * image + d, k)) / 2;
        force(3 * node + d, k) = mean;
        force(3 * image + d, k) = sign * mean;
      }
    }
}

void MirroredHalf::add_to_whole(const Eigen::MatrixXd& half, Parity parity,
                                const std::vector<Eigen::Index>& columns, Eigen::MatrixXd& whole) const {
  for (Eigen::Index k = 0; k < half.cols(); ++k)
    for (std::size_t i = 0; i < half_.node.size(); ++i) {
      const auto node = Eigen::Index(half_.node[i]), image = Eigen::Index(plane_.node[std::size_t(node)]);
      for (int d = 0; d < 3; ++d) {
        const double value = half(3 * Eigen::Index(i) + d, k);
        whole(3 * node + d, columns[std::size_t(k)]) += value;
        if (image != node)
          whole(3 * image + d, columns[std::size_t(k)]) += sign_of(parity, d == plane_.axis) * value;
      }
    }
}

std::vector<std::int64_t> MirroredHalf::held_by_plane(Parity parity) const {
  std::vector<std::int64_t> unknowns;
  for (std::size_t i = 0; i < half_.node.size(); ++i)
    if (plane_.holds(half_.node[i]))
      for (int d = 0; d < 3; ++d)
        if (sign_of(parity, d == plane_.axis) < 0) unknowns.push_back(3 * std::int64_t(i) + d);
  return unknowns;
}

std::vector<std::int64_t> MirroredHalf::supports(Parity parity) const {
  const auto& grid = half_.grid;
  auto corners = free_corners(grid);
  corners.erase(std::remove_if(corners.begin(), corners.end(),
                               [&](auto node) { return plane_.holds(half_.node[std::size_t(node)]); }),
                corners.end());
  // The three rigid motions of a parity are the same all along a line across the plane.
  const int u = (plane_.axis + 1) % 3, v = (plane_.axis + 2) % 3;
  const auto at = [&](std::int32_t node) {
    return Eigen::Vector2d(grid.position(node)[u], grid.position(node)[v]);
  };
  const auto farthest = [&](const auto& distance) {
    return *std::max_element(corners.begin(), corners.end(),
                             [&](auto i, auto j) { return distance(at(i)) < distance(at(j)); });
  };
  const Eigen::Vector2d start = at(corners.front());
  const auto a = farthest([&](const Eigen::Vector2d& x) { return (x - start).norm(); });
  const auto b = farthest([&](const Eigen::Vector2d& x) { return (x - at(a)).norm(); });
  const Eigen::Vector2d ab = at(b) - at(a);
  const auto unknown = [](std::int32_t node, int d) { return 3 * std::int64_t(node) + d; };
  std::vector<std::int64_t> unknowns;
  if (parity == Parity::even) {
    const int across = std::abs(ab[0]) > std::abs(ab[1]) ? v : u;
    unknowns = {unknown(a, u), unknown(a, v), unknown(b, across)};
  } else {
    const auto c = farthest(
        [&](const Eigen::Vector2d& x) { return std::abs(ab[0] * (x - at(a))[1] - ab[1] * (x - at(a))[0]); });
    unknowns = {unknown(a, plane_.axis), unknown(b, plane_.axis), unknown(c, plane_.axis)};
  }
  std::sort(unknowns.begin(), unknowns.end());
  return unknowns;
}

std::vector<double> MirroredHalf::signs_of_tensors() const {
  const std::array<std::array<int, 2>, 6> axes{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  std::vector<double> signs;
  for (const auto& [a, b] : axes) signs.push_back((a == plane_.axis) == (b == plane_.axis) ? 1 : -1);
  return signs;
}

Solution solve_by_halves(const MirroredHalf& half, const PerCell<Lame>& elastic, const BalancedLoads& loads,
                         const StepReport& progress, DirectSolveOptions options) {
  std::array<PartLoads, 2> parts{part_loads(half, loads, Parity::even), part_loads(half, loads, Parity::odd)};
  // What has no part at all (loads that their own balance takes away) is even, too.
  if (parts[0].columns.empty() && parts[1].columns.empty()) {
    parts[0].columns.push_back(0);
    parts[0].force = half.part(loads.force.leftCols(1), Parity::even);
  }
  const bool is_both = !parts[0].columns.empty() && !parts[1].columns.empty();
  const double n_parts = is_both ? 2 : 1;
  Solution solution;
  solution.displacement = Eigen::MatrixXd::Zero(loads.force.rows(), loads.force.cols());
  std::array<std::shared_ptr<const FactorisedBody>, 2> kept;
  for (const auto parity : {Parity::even, Parity::odd}) {
    const auto& own = parts[std::size_t(parity)].columns;
    if (own.empty()) continue;
    BalancedLoads of_half;
    of_half.force = std::move(parts[std::size_t(parity)].force);
    of_half.norm = loads.norm(own);
    of_half.largest_entry = loads.largest_entry(own);
    of_half.clamped = half.held_by_plane(parity);
    of_half.supports = half.supports(parity);
    DirectSolveOptions of_part;
    if (options.plan.valid()) of_part.plan = std::move(options.plan);
    if (options.kept != nullptr) of_part.kept = &kept[std::size_t(parity)];
    const double before = parity == Parity::odd && is_both ? 1 : 0;
    const auto told = [&](double share, const std::string& step) {
      progress((before + share) / n_parts, step);
    };
    const auto part =
        solve_directly(half.grid(), half.cells(), half.colours(), elastic, of_half, told, std::move(of_part));
    half.add_to_whole(part.displacement, parity, own, solution.displacement);
    solution.residual = std::max(solution.residual, part.residual);
    solution.rounding = std::max(solution.rounding, part.rounding);
    solution.support_reaction = std::max(solution.support_reaction, part.support_reaction);
    solution.factor_gigabytes += part.factor_gigabytes;
    solution.factor.n_dofs += part.factor.n_dofs;
    solution.factor.entries += part.factor.entries;
    solution.factor.flops += part.factor.flops;
    solution.factor.bytes += part.factor.bytes;
    solution.bytes += part.bytes;
  }
  solution.is_even = parts[1].columns.empty();
  if (options.kept != nullptr) *options.kept = std::make_shared<FactorisedHalves>(half, std::move(kept));
  return solution;
}

}  // namespace fem
