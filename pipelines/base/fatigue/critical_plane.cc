#include "pipelines/base/fatigue/critical_plane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/fatigue/fatigue_input.h"

namespace pipelines {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Circle {
  Vector2d centre = Vector2d::Zero();
  double square = 0;  ///< square of the radius
};

bool holds(const Circle& circle, const Vector2d& point) {
  return (point - circle.centre).squaredNorm() <= circle.square * (1 + 1e-12);
}

Circle circle_of(const Vector2d& a, const Vector2d& b) {
  return {(a + b) / 2, (a - b).squaredNorm() / 4};
}

/// Circle through three points; of three on a line, that of the outer two.
Circle circle_of(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d u = b - a, v = c - a;
  const double cross = u.x() * v.y() - u.y() * v.x();
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  if (std::abs(cross) <= 1e-14 * std::sqrt(uu * vv)) {
    Circle best = circle_of(a, b);
    for (const Circle& other : {circle_of(a, c), circle_of(b, c)})
      if (other.square > best.square) best = other;
    return best;
  }
  const Vector2d to_centre = Vector2d(v.y() * uu - u.y() * vv, u.x() * vv - v.x() * uu) / (2 * cross);
  return {a + to_centre, to_centre.squaredNorm()};
}

/// The points, at most three, that the circle rests on.
struct Support {
  std::array<Eigen::Index, 3> point{};
  int n = 0;
};

/// A point in each row: coordinates lie one after another, so that all instants are computed side by side.
using PlanePath = Eigen::Matrix<double, Eigen::Dynamic, 2>;

/// Smallest circle of the support and one more point outside its circle: that point is on the new one.
Circle with_point(const PlanePath& points, Support& support, Eigen::Index more) {
  const Vector2d p = points.row(more);
  Circle best;
  best.square = -1;
  Support found;
  const auto offer = [&](const Circle& circle, const Support& rests_on) {
    if (best.square >= 0 && circle.square >= best.square) return;
    for (int i = 0; i < support.n; ++i)
      if (!holds(circle, points.row(support.point[std::size_t(i)]).transpose())) return;
    best = circle;
    found = rests_on;
  };
  for (int i = 0; i < support.n; ++i) {
    const Eigen::Index a = support.point[std::size_t(i)];
    offer(circle_of(points.row(a).transpose(), p), {{a, more, 0}, 2});
    for (int j = 0; j < i; ++j) {
      const Eigen::Index b = support.point[std::size_t(j)];
      offer(circle_of(points.row(a).transpose(), points.row(b).transpose(), p), {{a, b, more}, 3});
    }
  }
  if (best.square >= 0) support = found;
  return best;
}

/// Adds the farthest point until none is outside: the radius grows with every step, so that no support comes
/// twice. A support of nearly the same points saves steps.
double smallest_circle(const PlanePath& points, Support& support) {
  Support from = support;
  if (from.n == 0) from = {{0, 0, 0}, 1};
  support = {{from.point[0], 0, 0}, 1};
  Circle circle{points.row(from.point[0]).transpose(), 0};
  for (int i = 1; i < from.n; ++i)
    if (!holds(circle, points.row(from.point[std::size_t(i)]).transpose()))
      circle = with_point(points, support, from.point[std::size_t(i)]);
  for (int step = 0; step < 200; ++step) {
    const auto squares = (points.col(0).array() - circle.centre.x()).square() +
                         (points.col(1).array() - circle.centre.y()).square();
    double square = squares.maxCoeff();
    if (square <= circle.square * (1 + 1e-12)) break;
    Eigen::Index farthest = 0;
    square = squares.maxCoeff(&farthest);
    const Circle grown = with_point(points, support, farthest);
    if (grown.square <= circle.square) return std::sqrt(square);  // rounding; this circle holds all points
    circle = grown;
  }
  return std::sqrt(circle.square);
}

/// Weights of the six components in u . sigma . v.
Eigen::Matrix<double, 6, 1> weights(const Vector3d& u, const Vector3d& v) {
  Eigen::Matrix<double, 6, 1> w;
  w << u.x() * v.x(), u.y() * v.y(), u.z() * v.z(), u.x() * v.y() + u.y() * v.x(),
      u.y() * v.z() + u.z() * v.y(), u.x() * v.z() + u.z() * v.x();
  return w;
}

/// Two unit vectors across a unit vector.
std::array<Vector3d, 2> across(const Vector3d& normal) {
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vector3d u = normal.cross(Vector3d::Unit(least)).normalized();
  return {u, normal.cross(u)};
}

/// Directions of a half sphere: a spiral of equal areas from the pole to the equator.
std::vector<Vector3d> spiral(int n) {
  const double golden = pi * (3 - std::sqrt(5.0));
  std::vector<Vector3d> result;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (i + 0.5) / n, r = std::sqrt(1 - z * z);
    result.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
  }
  return result;
}

/// A direction and others round it.
std::vector<Vector3d> fan(const Vector3d& normal) {
  std::vector<Vector3d> result{normal};
  const auto [u, v] = across(normal);
  for (const double tilt : {0.01, 0.04})
    for (int i = 0; i < 8; ++i) {
      const double angle = pi / 4 * i;
      result.push_back((normal + tilt * (std::cos(angle) * u + std::sin(angle) * v)).normalized());
    }
  return result;
}

/// Longer paths are searched by their outermost points.
constexpr Eigen::Index long_path = 2000;

constexpr int n_lines = 8;

/// The largest value of a series that comes in pieces, and where it is first.
struct Farthest {
  double value = -std::numeric_limits<double>::infinity();
  Eigen::Index point = 0;

  /// A value is compared at once, the place looked for only where a piece has a larger one.
  template <class Piece>
  void take(const Piece& piece, Eigen::Index first) {
    if (!(piece.maxCoeff() > value)) return;
    Eigen::Index most = 0;
    value = piece.maxCoeff(&most);
    point = first + most;
  }

  /// The same of the other sign.
  template <class Piece>
  void take_negative(const Piece& piece, Eigen::Index first) {
    if (!(-piece.minCoeff() > value)) return;
    Eigen::Index least = 0;
    value = -piece.minCoeff(&least);
    point = first + least;
  }
};

/// The points of a long path with the largest normal stress on one of the planes, or farthest in one of
/// sixteen directions of shear: they decide on planes near by. A short path stays as it is. The path is taken
/// in pieces that stay in the processor's memory.
StressPath outermost(const StressPath& history_Pa, const std::vector<Vector3d>& normals) {
  if (history_Pa.cols() <= long_path) return history_Pa;
  constexpr Eigen::Index at_once = 512;
  std::vector<std::array<Farthest, 1 + 2 * n_lines>> farthest(normals.size());
  std::array<double, n_lines> cosine{}, sine{};
  for (int i = 0; i < n_lines; ++i) {
    cosine[std::size_t(i)] = std::cos(pi / n_lines * i);
    sine[std::size_t(i)] = std::sin(pi / n_lines * i);
  }
  Eigen::Matrix<double, Eigen::Dynamic, 6> piece;
  Eigen::VectorXd a, b, along, line;
  for (Eigen::Index first = 0; first < history_Pa.cols(); first += at_once) {
    piece = history_Pa.middleCols(first, std::min(at_once, history_Pa.cols() - first)).transpose();
    for (std::size_t n = 0; n < normals.size(); ++n) {
      const auto [u, v] = across(normals[n]);
      a = piece.lazyProduct(weights(normals[n], u));
      b = piece.lazyProduct(weights(normals[n], v));
      along = piece.lazyProduct(weights(normals[n], normals[n]));
      auto& of = farthest[n];
      of[0].take(along, first);
      for (std::size_t i = 0; i < n_lines; ++i) {
        line = cosine[i] * a + sine[i] * b;
        of[1 + 2 * i].take(line, first);
        of[2 + 2 * i].take_negative(line, first);
      }
    }
  }
  std::vector<Eigen::Index> chosen;
  for (const auto& of : farthest)
    for (const auto& one : of) chosen.push_back(one.point);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  StressPath result(6, Eigen::Index(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i) result.col(Eigen::Index(i)) = history_Pa.col(chosen[i]);
  return result;
}

/// Evaluates planes of one history, without new memory for each.
class PlaneSearch {
public:
  /// @param normal_share  k of the value that is searched for
  PlaneSearch(const StressPath& history_Pa, double normal_share)
      : history_Pa_(history_Pa.transpose()),
        normal_share_(normal_share),
        path_(history_Pa.cols(), 2),
        normals_Pa_(history_Pa.cols()) {}

  struct Plane {
    Vector3d normal;
    double shear_Pa, normal_Pa, value_Pa;
  };

  Plane at(const Vector3d& normal) {
    const auto [u, v] = across(normal);
    path_.col(0).noalias() = history_Pa_.lazyProduct(weights(normal, u));
    path_.col(1).noalias() = history_Pa_.lazyProduct(weights(normal, v));
    normals_Pa_.noalias() = history_Pa_.lazyProduct(weights(normal, normal));
    const double shear_Pa = smallest_circle(path_, support_);
    const double normal_Pa = normals_Pa_.maxCoeff();
    return {normal, shear_Pa, normal_Pa, shear_Pa + normal_share_ * normal_Pa};
  }

  /// Largest value over all planes.
  Plane best() {
    if (coarse_.empty()) look_everywhere();
    for (Plane& plane : coarse_) plane.value_Pa = plane.shear_Pa + normal_share_ * plane.normal_Pa;
    std::sort(coarse_.begin(), coarse_.end(),
              [](const Plane& a, const Plane& b) { return a.value_Pa > b.value_Pa; });
    // Half a spacing (0.045 rad) off its maximum, sin 2t has lost 2 t^2 = 0.4 % of its amplitude.
    const double least =
        coarse_.front().value_Pa - 0.01 * (coarse_.front().value_Pa - coarse_.back().value_Pa);
    std::vector<Plane> starts;
    for (const Plane& plane : coarse_) {
      if (plane.value_Pa < least || starts.size() == 6) break;
      const bool is_near = std::any_of(starts.begin(), starts.end(), [&](const Plane& other) {
        return std::abs(other.normal.dot(plane.normal)) > std::cos(0.2);
      });
      if (!is_near) starts.push_back(plane);
    }
    Plane best = coarse_.front();
    for (const Plane& start : starts) {
      const Plane found = refined(start, 0.04, 1e-3);
      if (found.value_Pa > best.value_Pa) best = found;
    }
    return refined(best, 1e-3, 1e-7);
  }

  /// Near a plane that another history told: half a spacing of coarse planes away at most.
  Plane best_near(const Vector3d& normal) { return refined(at(normal), 0.04, 1e-7); }

private:
  /// Pattern search: eight neighbours on the sphere, the step halved when none is better.
  Plane refined(Plane best, double step, double least_step) {
    while (step > least_step) {
      const auto [u, v] = across(best.normal);
      const Plane from = best;
      for (int i = 0; i < 8; ++i) {
        const double angle = pi / 4 * i;
        const Vector3d beside = from.normal + step * (std::cos(angle) * u + std::sin(angle) * v);
        const Plane plane = at(beside.normalized());
        if (plane.value_Pa > best.value_Pa) best = plane;
      }
      if (best.value_Pa == from.value_Pa) step /= 2;
    }
    return best;
  }

  void look_everywhere() {
    constexpr int n_coarse = 1000;
    coarse_.reserve(n_coarse);
    for (const auto& normal : spiral(n_coarse)) coarse_.push_back(at(normal));
  }

  Eigen::Matrix<double, Eigen::Dynamic, 6> history_Pa_;
  double normal_share_;
  std::vector<Plane> coarse_;
  PlanePath path_;
  Eigen::VectorXd normals_Pa_;
  Support support_;
};

void require_search(const StressPath& history_Pa, const CriticalPlaneLimit& limit) {
  if (history_Pa.cols() == 0) throw std::invalid_argument("history_Pa: holds no instants; give at least one");
  if (!history_Pa.allFinite()) throw std::invalid_argument("history_Pa: holds a value that is not finite");
  require_non_negative_input("normal_share", limit.normal_share);
  require_positive_input("limit_Pa", limit.limit_Pa);
}

CriticalPlane described(const PlaneSearch::Plane& plane, const CriticalPlaneLimit& limit, double scale) {
  CriticalPlane result;
  result.normal = plane.normal;
  result.shear_amplitude_Pa = scale * plane.shear_Pa;
  result.max_normal_Pa = scale * plane.normal_Pa;
  result.equivalent_Pa = result.shear_amplitude_Pa + limit.normal_share * result.max_normal_Pa;
  result.utilisation = std::max(0.0, result.equivalent_Pa / limit.limit_Pa);
  return result;
}

double shear_ratio_share(double reversed_strength_Pa, double reversed_shear_strength_Pa) {
  require_positive_input("reversed_strength_Pa", reversed_strength_Pa);
  require_positive_input("reversed_shear_strength_Pa", reversed_shear_strength_Pa);
  const double ratio = reversed_shear_strength_Pa / reversed_strength_Pa;
  if (ratio < 0.5 || ratio >= 1)
    refuse_fatigue_input("reversed_shear_strength_Pa / reversed_strength_Pa", ratio,
                         "must be at least 0.5 and below 1: critical planes are for ductile metals");
  return 2 * ratio - 1;
}

}  // namespace

CriticalPlaneLimit findley_limit(double reversed_strength_Pa, double reversed_shear_strength_Pa) {
  const double s = shear_ratio_share(reversed_strength_Pa, reversed_shear_strength_Pa);
  const double k = s / std::sqrt(1 - s * s);
  return {k, reversed_shear_strength_Pa * std::hypot(1, k)};
}

CriticalPlane stress_on_plane(const StressPath& history_Pa, const Eigen::Vector3d& normal,
                              const CriticalPlaneLimit& limit) {
  require_search(history_Pa, limit);
  if (!normal.allFinite() || normal.isZero(0))
    throw std::invalid_argument("normal: must be a finite vector that is not zero");
  return described(PlaneSearch(history_Pa, limit.normal_share).at(normal.normalized()), limit, 1);
}

CriticalPlane findley(const StressPath& history_Pa, const StressPath& finer_Pa,
                      const CriticalPlaneLimit& limit) {
  require_search(history_Pa, limit);
  require_search(finer_Pa, limit);
  const double scale = finer_Pa.cwiseAbs().maxCoeff();
  if (scale == 0) return {};
  const auto found = findley(outermost(history_Pa, spiral(100)), limit);
  const auto near_by = outermost(finer_Pa, fan(found.normal));
  const auto best = PlaneSearch(near_by / scale, limit.normal_share).best_near(found.normal);
  return stress_on_plane(finer_Pa, best.normal, limit);
}

CriticalPlane findley(const StressPath& history_Pa, const CriticalPlaneLimit& limit) {
  require_search(history_Pa, limit);
  const double scale = history_Pa.cwiseAbs().maxCoeff();
  if (scale == 0) return {};
  return described(PlaneSearch(history_Pa / scale, limit.normal_share).best(), limit, scale);
}

double smallest_circle_radius(const Eigen::Matrix2Xd& points) {
  if (points.cols() == 0) throw std::invalid_argument("points: holds none; give at least one");
  Support support;
  return smallest_circle(points.transpose(), support);
}

}  // namespace pipelines
