#include "pipelines/judge/life/damage_direction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace pipelines {
namespace {

using Eigen::Index;
using Coordinates = Eigen::Matrix<double, 5, Eigen::Dynamic>;

/// Share of the largest range below which cycles do not decide: with a slope of 5 they do 3e-7 of its damage.
constexpr double small_range = 0.05;
constexpr double first_turn_rad = 0.3, last_turn_rad = 0.005;
constexpr std::size_t n_ascents = 3;

/// Direction from one end to the farthest point and on, as long as that grows: almost the widest pair.
DeviatoricDirection widest(const Coordinates& x) {
  const auto farthest = [&](Index from) {
    Index other = 0;
    (x.colwise() - x.col(from)).colwise().squaredNorm().maxCoeff(&other);
    return other;
  };
  Index a = 0, b = farthest(0);
  for (int hops = 0; hops < 20; ++hops) {
    const Index next = farthest(b);
    if (!((x.col(next) - x.col(b)).squaredNorm() > (x.col(a) - x.col(b)).squaredNorm())) break;
    a = std::exchange(b, next);
  }
  return x.col(b) - x.col(a);
}

/// Orthonormal directions by falling range.
std::vector<DeviatoricDirection> basis_of(Coordinates x, const DeviatoricDirection& largest) {
  std::vector<DeviatoricDirection> basis{largest};
  const Eigen::RowVectorXd along = largest.transpose() * x;
  const double least = small_range * (along.maxCoeff() - along.minCoeff());
  while (basis.size() < 5) {
    x -= (basis.back() * (basis.back().transpose() * x)).eval();
    const DeviatoricDirection range = widest(x);
    if (!(range.norm() > least)) break;
    DeviatoricDirection next = range.normalized();
    for (const auto& other : basis) next -= other.dot(next) * other;
    basis.push_back(next.normalized());
  }
  return basis;
}

struct Rated {
  DeviatoricDirection direction;
  double damage = 0;
};

/// Turns towards the basis, either way, as long as that makes it worse.
Rated ascend(Rated best, const std::vector<DeviatoricDirection>& basis, const DamageAlong& damage) {
  for (double turn = first_turn_rad; turn >= last_turn_rad;) {
    Rated next = best;
    for (const auto& towards : basis)
      for (const double sign : {-1.0, 1.0}) {
        const DeviatoricDirection across = towards - best.direction.dot(towards) * best.direction;
        if (across.norm() < 1e-6) continue;
        const DeviatoricDirection turned =
            std::cos(turn) * best.direction + sign * std::sin(turn) * across.normalized();
        if (const double d = damage(turned); d > next.damage) next = {turned, d};
      }
    if (next.damage > best.damage)
      best = next;
    else
      turn /= 2;
  }
  return best;
}

}  // namespace

std::vector<DeviatoricDirection> damage_directions(const Coordinates& coordinates,
                                                   const DeviatoricDirection& largest,
                                                   const DamageAlong& damage) {
  if (!(largest.norm() > 0)) return {};
  const auto basis = basis_of(coordinates, largest);
  std::vector<DeviatoricDirection> result = basis;
  if (basis.size() == 1) return result;
  std::vector<Rated> starts;
  for (const auto& direction : basis) starts.push_back({direction, damage(direction)});
  for (std::size_t i = 0; i < basis.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (const double sign : {-1.0, 1.0}) {
        const DeviatoricDirection middle = (basis[i] + sign * basis[j]).normalized();
        starts.push_back({middle, damage(middle)});
      }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const auto& a, const auto& b) { return a.damage > b.damage; });
  starts.resize(std::min(starts.size(), n_ascents));
  for (const auto& start : starts) result.push_back(ascend(start, basis, damage).direction);
  return result;
}

DeviatoricDirection stationary_direction(const DeviatoricDirection& near, const DamageAlong& damage) {
  constexpr double difference_rad = 1e-3, most_turn_rad = 0.1, last_turn_rad = 1e-3, rounding = 1e-12;
  constexpr int most_turns = 4, most_halvings = 3;
  using Turn = Eigen::Vector4d;
  DeviatoricDirection direction = near;
  double here = std::log(damage(direction));
  Eigen::LLT<Eigen::Matrix4d> crest;  // the second derivatives, but for the sign
  for (int i = 0; i < most_turns; ++i) {
    // Turns are small: the second derivatives of the first one do for all.
    const Eigen::Matrix<double, 5, 5> basis =
        Eigen::HouseholderQR<DeviatoricDirection>(direction).householderQ();
    const auto turned = [&](const Turn& turn) {
      return DeviatoricDirection((direction + basis.rightCols<4>() * turn).normalized());
    };
    const auto at = [&](const Turn& turn) { return std::log(damage(turned(turn))); };
    Turn more, less;
    for (Index a = 0; a < 4; ++a) {
      more[a] = at(difference_rad * Turn::Unit(a)) - here;
      less[a] = at(-difference_rad * Turn::Unit(a)) - here;
    }
    if (i == 0) {
      Eigen::Matrix4d bend = (more + less).asDiagonal();
      for (Index a = 0; a < 4; ++a)
        for (Index b = 0; b < a; ++b)
          bend(a, b) = bend(b, a) =
              at(difference_rad * (Turn::Unit(a) + Turn::Unit(b))) - here - more[a] - more[b];
      bend /= -difference_rad * difference_rad;
      if (!bend.allFinite()) break;
      crest.compute(bend);
      if (crest.info() != Eigen::Success) break;
    }
    Turn turn = crest.solve((more - less) / (2 * difference_rad));
    if (!turn.allFinite()) break;
    turn *= std::min(1.0, most_turn_rad / turn.norm());
    double there = at(turn);
    for (int h = 0; h < most_halvings && !(there > here); ++h) there = at(turn /= 2);
    if (!(there > here + rounding)) break;
    direction = turned(turn);
    here = there;
    if (turn.norm() < last_turn_rad) break;
  }
  return direction;
}

}  // namespace pipelines
