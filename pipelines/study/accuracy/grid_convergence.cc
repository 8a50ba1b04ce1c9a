#include "pipelines/study/accuracy/grid_convergence.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace pipelines {
namespace {

constexpr double safety_of_three = 1.25, safety_of_two = 3;
constexpr double smallest_ratio = 1.05;
constexpr double lowest_order = 0.5;
constexpr double highest_of_formal = 2;
constexpr double rounding = 1e-10;
constexpr double asymptotic_range = 0.1;

/// p = (ln(e32 / e21) + q(p)) / ln r21 with q = ln((r21^p - 1) / (r32^p - 1)), iterated from q = 0 (Celik et
/// al., eq. 3).
/// @return nothing if the iteration does not settle
std::optional<double> observed_order(double change_ratio, double ratio_21, double ratio_32) {
  constexpr int most_iterations = 200;
  double order = std::log(change_ratio) / std::log(ratio_21);
  for (int i = 0; i < most_iterations; ++i) {
    // Both differences vanish with the order; so does their quotient's dependence on it.
    const double q =
        std::abs(order) < 1e-9
            ? std::log(std::log(ratio_21) / std::log(ratio_32))
            : std::log(std::expm1(order * std::log(ratio_21)) / std::expm1(order * std::log(ratio_32)));
    const double next = (std::log(change_ratio) + q) / std::log(ratio_21);
    if (std::abs(next - order) <= 1e-12 * std::max(1.0, std::abs(next))) return next;
    order = next;
  }
  return std::nullopt;
}

double missing(double change, double ratio, double order) {
  return std::abs(change) / (std::pow(ratio, order) - 1);
}

void three_meshes(GridConvergence& result, const std::vector<MeshValue>& meshes, double formal_order) {
  const double f1 = meshes[2].value, f2 = meshes[1].value, f3 = meshes[0].value;
  const double change_21 = f2 - f1, change_32 = f3 - f2, highest = highest_of_formal * formal_order;
  result.safety = safety_of_three;
  if (!(change_21 * change_32 > 0)) {
    result.refusal = "the value does not change in one direction from mesh to mesh";
    return;
  }
  const auto order = observed_order(change_32 / change_21, result.ratio_21, result.ratio_32);
  if (!order) {
    result.refusal = "the iteration for the observed order does not settle";
    return;
  }
  result.observed_order = *order;
  if (*order < lowest_order) {
    result.refusal = fmt::format(
        "the observed order {:.2f} is below {:g}: changes do not die out, the place may be singular", *order,
        lowest_order);
    return;
  }
  result.order = std::min(*order, formal_order);
  result.extrapolated = f1 - change_21 / (std::pow(result.ratio_21, *order) - 1);
  result.index_21 = result.safety * missing(change_21, result.ratio_21, result.order);
  result.index_32 = result.safety * missing(change_32, result.ratio_32, result.order);
  result.asymptotic_ratio =
      missing(change_32, result.ratio_32, *order) / std::abs(f2) /
      (std::pow(result.ratio_21, *order) * missing(change_21, result.ratio_21, *order) / std::abs(f1));
  if (*order > highest)
    result.refusal = fmt::format(
        "the observed order {:.2f} is above {:g}: the last change is small by chance, or the "
        "coarsest mesh is too coarse",
        *order, highest);
  else if (!(std::abs(result.asymptotic_ratio - 1) <= asymptotic_range))
    result.refusal = fmt::format("GCI_32 / (r^p GCI_21) = {:.3f} is not about 1: the meshes are too coarse",
                                 result.asymptotic_ratio);
}

}  // namespace

GridConvergence grid_convergence(const std::vector<MeshValue>& meshes, double formal_order) {
  if (meshes.size() < 2 || meshes.size() > 3)
    throw std::invalid_argument(
        fmt::format("{} meshes: a grid convergence index needs two or three", meshes.size()));
  if (!(formal_order > 0))
    throw std::invalid_argument(fmt::format("formal order {:g}: must be positive", formal_order));
  for (std::size_t i = 1; i < meshes.size(); ++i)
    if (!(meshes[i].size > 0 && meshes[i - 1].size >= smallest_ratio * meshes[i].size))
      throw std::invalid_argument(
          fmt::format("cells of {:g} after cells of {:g}: list meshes from coarse to fine, each at "
                      "least {:g} times finer",
                      meshes[i].size, meshes[i - 1].size, smallest_ratio));
  GridConvergence result;
  result.n_meshes = int(meshes.size());
  const auto& fine = meshes.back();
  const auto& next = meshes[meshes.size() - 2];
  result.ratio_21 = next.size / fine.size;
  if (meshes.size() == 3) result.ratio_32 = meshes[0].size / next.size;

  double largest_change = 0;
  for (const auto& mesh : meshes)
    largest_change = std::max(largest_change, std::abs(mesh.value - fine.value));
  if (largest_change <= rounding * std::abs(fine.value)) {
    result.order = formal_order;
    result.extrapolated = fine.value;
    result.safety = meshes.size() == 3 ? safety_of_three : safety_of_two;
    result.asymptotic_ratio = 1;
  } else if (meshes.size() == 3) {
    three_meshes(result, meshes, formal_order);
  } else {
    result.safety = safety_of_two;
    result.order = formal_order;
    const double change = next.value - fine.value;
    result.extrapolated = fine.value - change / (std::pow(result.ratio_21, formal_order) - 1);
    result.index_21 = result.safety * missing(change, result.ratio_21, formal_order);
  }
  return result;
}

}  // namespace pipelines
