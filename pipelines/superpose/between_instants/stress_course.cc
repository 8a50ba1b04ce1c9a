#include "pipelines/superpose/between_instants/stress_course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kinetics/series/load_spectrum.h"
#include "pipelines/superpose/between_instants/cycle_extremes.h"
#include "pipelines/superpose/kernels/deviatoric_coordinates.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

/// Places of a polynomial that stands for the course between two of them.
constexpr Index n_local = PlacesAround::n;
/// Share of the largest range up to which ranges are equal to rainflow.
constexpr double equal_ranges = 1e-9;

Index wrapped(Index i, Index n) {
  return (i % n + n) % n;
}

/// Lagrange's weights of the places first .. first + n_local - 1 for one in their middle.
std::array<double, n_local> local_weights(double from_first) {
  // 1 / product of (i - other): (-1)^(7 - i) / (i! (7 - i)!)
  static_assert(n_local == 8);
  constexpr std::array<double, n_local> scale{-1. / 5040, 1. / 720, -1. / 240, 1. / 144,
                                              -1. / 144,  1. / 240, -1. / 720, 1. / 5040};
  std::array<double, n_local> weights{};
  double before = 1, behind = 1;  // products of the distances to the others
  for (Index i = 0; i < n_local; ++i) {
    weights[std::size_t(i)] = scale[std::size_t(i)] * before;
    before *= from_first - double(i);
  }
  for (Index i = n_local - 1; i >= 0; --i) {
    weights[std::size_t(i)] *= behind;
    behind *= from_first - double(i);
  }
  return weights;
}

/// Value at a place, of the polynomial through the places around it.
template <typename Get>
auto between(double place, const Get& get) {
  const double below = std::floor(place);
  const Index first = Index(below) - (n_local / 2 - 1);
  const auto weights = local_weights(place - double(first));
  auto sum = get(first, weights[0]);
  for (Index i = 1; i < n_local; ++i) sum += get(first + i, weights[std::size_t(i)]);
  return sum;
}

/// The crest of a smooth function near a place where it is not below its neighbours a step away: of
/// parabolas with smaller and smaller steps.
template <typename Function>
double crest_near(double place, const Function& value) {
  for (const double step : {1.0, 0.25, 0.05, 0.05}) {
    const double before = value(place - step), here = value(place), after = value(place + step);
    const double curvature = before - 2 * here + after;
    if (!(curvature < 0)) break;
    place += step * std::clamp((before - after) / (2 * curvature), -1.0, 1.0);
  }
  return place;
}

Stress stress_of(const Eigen::Matrix<double, 6, 1>& components) {
  Stress stress{};
  std::copy_n(components.data(), 6, stress.begin());
  return stress;
}

double squared_distance(const Stress& a, const Stress& b) {
  Stress difference{};
  for (std::size_t c = 0; c < 6; ++c) difference[c] = a[c] - b[c];
  const double size = von_mises_Pa(difference);
  return size * size;
}

}  // namespace

PlacesAround::PlacesAround(double place) : first(Index(std::floor(place)) - (n / 2 - 1)) {
  constexpr double step = 0.01;  // step of places: off by (2 pi step / 48)^2 / 6 of a harmonic's slope
  const auto at = [&](double x) { return Weights(Weights::Map(local_weights(x - double(first)).data())); };
  const Weights before = at(place - step), after = at(place + step);
  value = at(place);
  slope = (after - before) / (2 * step);
  curvature = (after - 2 * value + before) / (step * step);
}

StressCourse::StressCourse(const UnitStresses& unit_Pa, const FactorCourse& factors)
    : StressCourse(at_places((unit_Pa * factors.fine().matrix()).array(), factors)) {}

StressCourse StressCourse::at_places(ArrayXXd stress_Pa, const FactorCourse& factors) {
  StressCourse course(std::move(stress_Pa));
  course.is_smooth_ = factors.is_polynomial() && course.stress_Pa_.cols() >= n_local;
  course.per_step_ = factors.per_step();
  return course;
}

StressCourse::StressCourse(ArrayXXd stress_Pa) : stress_Pa_(std::move(stress_Pa)) {}

ArrayXXd StressCourse::denser_Pa(Index n) const {
  if (!is_smooth_ || n < 2) return stress_Pa_;
  const Index n_places = stress_Pa_.cols();
  ArrayXXd result = ArrayXXd::Zero(6, n * n_places);
  for (Index j = 0; j < n; ++j) {
    const PlacesAround around(double(j) / double(n));
    for (Index p = 0; p < n_places; ++p)
      for (Index i = 0; i < n_local; ++i)
        result.col(p * n + j) += around.value[i] * stress_Pa_.col(around.wrapped(p + i, n_places));
  }
  return result;
}

Eigen::Matrix<double, 5, Eigen::Dynamic> StressCourse::coordinates() const {
  return deviatoric_coordinates(stress_Pa_.matrix()).matrix();
}

double StressCourse::instant_of(double place) const {
  const double n = double(stress_Pa_.cols());
  return std::fmod(place + n, n) / double(per_step_);
}

Stress StressCourse::at(double place) const {
  const Index n = stress_Pa_.cols();
  if (place == std::floor(place)) return stress_of(stress_Pa_.col(wrapped(Index(place), n)).matrix());
  return stress_of(between(place, [&](Index i, double weight) -> Eigen::Matrix<double, 6, 1> {
    return weight * stress_Pa_.col(wrapped(i, n)).matrix();
  }));
}

double StressCourse::farthest_near(double place, const Stress& from) const {
  return crest_near(place, [&](double x) { return squared_distance(at(x), from); });
}

CycleBetween StressCourse::largest(double slack) const {
  CycleBetween result;
  result.cycle = largest_cycle(stress_Pa_, slack);
  double from = double(result.cycle.from), to = double(result.cycle.to);
  constexpr int most_turns = 50;
  constexpr double no_gain = 1e-14;
  double squared = squared_distance(at(from), at(to));
  for (int i = 0; is_smooth_ && squared > 0 && i < most_turns; ++i) {
    const double new_to = farthest_near(to, at(from)), new_from = farthest_near(from, at(new_to));
    const double farther = squared_distance(at(new_from), at(new_to));
    if (!(farther > squared * (1 + no_gain))) break;
    from = new_from, to = new_to, squared = farther;
  }
  if (instant_of(from) > instant_of(to)) std::swap(from, to);
  result.from = instant_of(from), result.to = instant_of(to);
  const Index n_instants = stress_Pa_.cols() / per_step_;
  const auto nearest = [&](double instant) { return Index(std::llround(instant)) % n_instants; };
  result.cycle = cycle_between(at(from), at(to), 0, 1);
  result.cycle.from = std::min(nearest(result.from), nearest(result.to));
  result.cycle.to = std::max(nearest(result.from), nearest(result.to));
  return result;
}

double StressCourse::crest_of(const ArrayXd& values, Index place) const {
  const Index n = values.size();
  const double sign = values[place] >= values[wrapped(place + 1, n)] ? 1 : -1;
  return crest_near(double(place), [&](double x) {
    return sign * between(x, [&](Index i, double weight) { return weight * values[wrapped(i, n)]; });
  });
}

std::vector<EndsOfCycle> StressCourse::cycles_of(const Eigen::Matrix<double, 6, 1>& form,
                                                 bool refined) const {
  const ArrayXd values = (form.transpose() * stress_Pa_.matrix()).transpose().array();
  const Index n = values.size();
  const double alike = equal_ranges * (values.maxCoeff() - values.minCoeff());
  std::vector<double> places;
  double before = values[0] - values[n - 1];
  for (Index i = 0; i < n; ++i) {
    const double after = values[i + 1 < n ? i + 1 : 0] - values[i];
    if (before * after <= 0 && !(before == 0 && after == 0)) places.push_back(double(i));
    before = after;
  }
  if (refined && is_smooth_)
    for (auto& place : places) place = crest_of(values, Index(place));
  if (places.empty()) return {};
  ArrayXd turning(Index(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double place = places[i];
    turning[Index(i)] =
        place == std::floor(place)
            ? values[wrapped(Index(place), n)]
            : between(place, [&](Index k, double weight) { return weight * values[wrapped(k, n)]; });
  }
  std::vector<EndsOfCycle> cycles;
  for (const auto& ends : kinetics::rainflow_repeating_ends(turning, alike)) {
    const double from = places[std::size_t(ends.from)], to = places[std::size_t(ends.to)];
    cycles.push_back({std::abs(turning[ends.to] - turning[ends.from]), at(from), at(to), instant_of(from),
                      instant_of(to)});
  }
  return cycles;
}

std::vector<EndsOfCycle> StressCourse::cycles_along(const DeviatoricDirection& direction,
                                                    bool refined) const {
  return cycles_of(form_along(direction), refined);
}

Eigen::Matrix<double, 6, 1> form_along(const DeviatoricDirection& direction) {
  Eigen::Matrix<double, 6, 1> form;
  for (Index c = 0; c < 6; ++c) {
    Stress unit{};
    unit[std::size_t(c)] = 1;
    DeviatoricDirection coordinates;
    find_deviatoric_coordinates(unit.data(), coordinates.data());
    form[c] = direction.dot(coordinates);
  }
  return form;
}

DeviatoricDirection direction_of(const Stress& stress) {
  DeviatoricDirection coordinates;
  find_deviatoric_coordinates(stress.data(), coordinates.data());
  const double size = coordinates.norm();
  return size > 0 ? DeviatoricDirection(coordinates / size) : DeviatoricDirection::Zero();
}

}  // namespace pipelines
