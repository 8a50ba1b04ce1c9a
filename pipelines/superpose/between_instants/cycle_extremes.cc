#include "pipelines/superpose/between_instants/cycle_extremes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <utility>
#include <vector>

#include "pipelines/base/common/constants.h"
#include "pipelines/superpose/kernels/deviatoric_coordinates.h"

namespace pipelines {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// Share of the largest squared norm for which intervals are not looked into.
constexpr double worth_halving = 1e-13;

/// A trigonometric polynomial  p(x) = Re sum_h c_h exp(j h x), and bounds of its derivatives.
class Polynomial {
public:
  struct Values {
    double p = 0, first = 0, second = 0;
  };

  explicit Polynomial(Eigen::ArrayXcd lines) : lines_(std::move(lines)) {
    for (Index h = 1; h < lines_.size(); ++h) {
      const double size = std::abs(lines_[h]), order = double(h);
      second_bound_ += size * order * order;
      third_bound_ += size * order * order * order;
    }
  }

  Values at(double x) const {
    Values values;
    Complex turned = 1;
    const Complex step = std::polar(1.0, x);
    for (Index h = 0; h < lines_.size(); ++h) {
      if (h % 32 == 0) turned = std::polar(1.0, double(h) * x);  // rounding does not add up
      const Complex term = lines_[h] * turned;
      const double order = double(h);
      values.p += term.real();
      values.first -= order * term.imag();
      values.second -= order * order * term.real();
      turned *= step;
    }
    return values;
  }

  double second_bound() const { return second_bound_; }
  double third_bound() const { return third_bound_; }

private:
  Eigen::ArrayXcd lines_;
  double second_bound_ = 0, third_bound_ = 0;
};

struct Crest {
  double x = 0, p = 0;
};

/// The crest between two places of which the polynomial is concave, or a place to their side: Newton's
/// iteration, kept in the bracket by halving it.
Crest climb(const Polynomial& polynomial, double left, double right) {
  double x = (left + right) / 2;
  Crest best{x, polynomial.at(x).p};
  for (int i = 0; i < 60; ++i) {
    const auto here = polynomial.at(x);
    if (here.p > best.p) best = {x, here.p};
    (here.first > 0 ? left : right) = x;
    const double newton = here.second < 0 ? x - here.first / here.second : left;
    const double next = newton > left && newton < right ? newton : (left + right) / 2;
    if (std::abs(next - x) <= 1e-15 * (1 + std::abs(x))) break;
    x = next;
  }
  return best;
}

/// Looks for a larger value than the best so far between two places.
void search_between(const Polynomial& polynomial, const Crest& a, const Crest& b, Crest& best) {
  const double width = b.x - a.x, ends = std::max(a.p, b.p);
  // Between two places a function exceeds the larger by at most width^2 / 8 max |p''|.
  if (ends + width * width / 8 * polynomial.second_bound() <= best.p + worth_halving * std::abs(best.p))
    return;
  const double middle = (a.x + b.x) / 2;
  const auto values = polynomial.at(middle);
  const Crest half{middle, values.p};
  if (half.p > best.p) best = half;
  if (std::abs(values.first) > width / 2 * polynomial.second_bound()) return;  // monotonic
  const double changes = width / 2 * polynomial.third_bound();
  if (values.second > changes) return;  // convex
  if (values.second < -changes) {
    if (const auto crest = climb(polynomial, a.x, b.x); crest.p > best.p) best = crest;
    return;
  }
  search_between(polynomial, a, half, best);
  search_between(polynomial, half, b, best);
}

/// The squared norm of rows of lines, at least 4 times per period of its highest line, and its own lines.
struct SquaredNorm {
  Eigen::ArrayXd at;  ///< values at 2 pi i / size
  Eigen::ArrayXcd lines;
};

SquaredNorm squared_norm(const Eigen::ArrayXXcd& lines) {
  const Index highest = lines.cols() - 1, degree = 2 * highest;
  Index n = 16;
  while (n < 4 * degree) n *= 2;
  Eigen::FFT<double> transform;
  SquaredNorm square{Eigen::ArrayXd::Zero(n), {}};
  Eigen::VectorXcd spectrum(n), series(n);
  for (Index row = 0; row < lines.rows(); ++row) {
    spectrum.setZero();
    spectrum.head(lines.cols()) = lines.row(row).matrix().transpose() * double(n);
    transform.inv(series, spectrum);
    square.at += series.real().array().square();
  }
  const Eigen::VectorXcd squares = square.at.matrix().cast<Complex>();
  transform.fwd(spectrum, squares);
  square.lines = spectrum.head(degree + 1).array() * (2 / double(n));
  square.lines[0] *= 0.5;
  return square;
}

constexpr Index n_piece = 8;   ///< instants of a polynomial
constexpr int n_between = 16;  ///< places looked at in an interval
/// A kink in the middle of an interval is missed by 1.57 times what eight instants at twice the distance
/// miss.
constexpr double of_missed = 2;
constexpr double rougher = 4;  ///< at the seam than elsewhere

/// A series of points by index, over a cycle or within a window.
class Course {
public:
  Course(const Eigen::ArrayXXd& values, bool closed) : values_(values), closed_(closed) {}
  Index n() const { return values_.cols(); }
  Index n_rows() const { return values_.rows(); }
  bool closed() const { return closed_; }
  auto at(Index i) const { return values_.col((i % n() + n()) % n()); }

  /// The first instant of the polynomial for the interval after instant i.
  Index first_for(Index i) const {
    const Index first = i - n_piece / 2 + 1;
    return closed_ ? first : std::clamp<Index>(first, 0, n() - n_piece);
  }

  /// What the instants at twice the distance, eight or at the ends of a window four, miss instant i by.
  double missed(Index i) const {
    static const std::vector<std::vector<double>> weights{
        {9.0 / 16, -1.0 / 16},
        {150.0 / 256, -25.0 / 256, 3.0 / 256},
        {1225.0 / 2048, -245.0 / 2048, 49.0 / 2048, -5.0 / 2048}};
    Index pairs = 4;
    if (!closed_) {
      i = std::clamp<Index>(i, 3, n() - 4);
      while (i < 2 * pairs - 1 || i + 2 * pairs - 1 >= n()) --pairs;
    }
    const auto& weight = weights[std::size_t(pairs - 2)];
    Eigen::ArrayXd difference = at(i);
    for (Index p = 0; p < pairs; ++p)
      difference -= weight[std::size_t(p)] * (at(i - 2 * p - 1) + at(i + 2 * p + 1));
    return difference.matrix().norm();
  }

private:
  const Eigen::ArrayXXd& values_;
  bool closed_;
};

/// Norm at first + place, of the polynomial through the instants from `first` on.
double norm_of_piece(const Course& course, Index first, double place) {
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(course.n_rows());
  for (Index i = 0; i < n_piece; ++i) {
    double share = 1;
    for (Index other = 0; other < n_piece; ++other)
      if (other != i) share *= (place - double(other)) / double(i - other);
    sum += share * course.at(first + i);
  }
  return sum.matrix().norm();
}

/// The largest norm between instant i and the next, of the polynomial from `first` on; where.
Crest crest_of_piece(const Course& course, Index i, Index first) {
  std::array<double, n_between + 1> squares{};
  for (int part = 0; part <= n_between; ++part) {
    const double norm = norm_of_piece(course, first, double(i - first) + double(part) / n_between);
    squares[std::size_t(part)] = norm * norm;
  }
  const auto top =
      std::clamp<long>(std::max_element(squares.begin(), squares.end()) - squares.begin(), 1, n_between - 1);
  const double before = squares[std::size_t(top - 1)], here = squares[std::size_t(top)],
               after = squares[std::size_t(top + 1)], curvature = before - 2 * here + after;
  Crest crest{double(top), here};
  if (const double away = curvature < 0 ? (before - after) / (2 * curvature) : 0; std::abs(away) < 1)
    crest = {double(top) + away, here - (before - after) * away / 4};
  for (const int end : {0, n_between})
    if (squares[std::size_t(end)] > crest.p) crest = {double(end), squares[std::size_t(end)]};
  return {double(i) + crest.x / n_between, std::sqrt(crest.p)};
}

/// How much the cubic through four instants misses the next by: four times their fourth difference.
double fourth_difference(const Course& course, Index first) {
  return (course.at(first) - 4 * course.at(first + 1) + 6 * course.at(first + 2) - 4 * course.at(first + 3) +
          course.at(first + 4))
      .matrix()
      .norm();
}

}  // namespace

Eigen::Array<double, 5, Eigen::Dynamic> deviatoric_coordinates(
    const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress) {
  Eigen::Array<double, 5, Eigen::Dynamic> coordinates(5, stress.cols());
  for (Eigen::Index i = 0; i < stress.cols(); ++i)
    find_deviatoric_coordinates(stress.col(i).data(), coordinates.col(i).data());
  return coordinates;
}

CycleExtreme extreme_of_polynomial(const FactorSpectrum& spectrum) {
  const double n_instants = double(spectrum.n_instants);
  CycleExtreme extreme{spectrum.lines.col(0).matrix().norm(), spectrum.unresolved(), 0};
  if (spectrum.lines.cols() < 2) return extreme;
  const auto square = squared_norm(spectrum.lines);
  const Index n = square.at.size();
  const double step = 2 * pi / double(n);
  const auto place = [&](Index i) { return Crest{double(i) * step, square.at[(i + n) % n]}; };
  const Polynomial polynomial(square.lines);
  Index top = 0;
  square.at.maxCoeff(&top);
  Crest best = place(top);
  search_between(polynomial, place(top - 1), place(top), best);
  search_between(polynomial, place(top), place(top + 1), best);
  for (Index i = 0; i < n; ++i) search_between(polynomial, place(i), place(i + 1), best);
  extreme.value = std::sqrt(std::max(0.0, best.p));
  extreme.instant = std::fmod(best.x / (2 * pi) + 1, 1.0) * n_instants;
  return extreme;
}

bool is_closed(const Eigen::ArrayXXd& values) {
  const Course course(values, true);
  const Index n = course.n();
  double within = 0;
  for (Index first = 0; first + 4 < n; ++first) within = std::max(within, fourth_difference(course, first));
  const double rounding = 1e-13 * std::sqrt(values.square().colwise().sum().maxCoeff());
  const double seam = std::min(fourth_difference(course, n - 4), fourth_difference(course, n - 1));
  return seam <= rougher * within + rounding;
}

CycleExtreme extreme_of_pieces(const Eigen::ArrayXXd& values) {
  const Course course(values, is_closed(values));
  const Index n = course.n();
  Eigen::ArrayXd norm = values.square().colwise().sum().sqrt().transpose(), missed(n), bend(n);
  for (Index i = 0; i < n; ++i) missed[i] = course.missed(i);
  for (Index i = 0; i < n; ++i)
    bend[i] = (course.at(i - 1) - 2 * course.at(i) + course.at(i + 1)).matrix().norm();
  const auto wrapped = [&](Index i) { return (i % n + n) % n; };
  const auto unresolved = [&](Index i) {
    double largest = 0;
    for (Index j = i - n_piece / 2 + 1; j <= i + n_piece / 2; ++j)
      largest = std::max(largest, missed[course.closed() ? wrapped(j) : std::clamp<Index>(j, 0, n - 1)]);
    return of_missed * largest;
  };

  Index top = 0;
  norm.maxCoeff(&top);
  CycleExtreme extreme{norm[top], 0, double(top)};
  double bound = extreme.value;
  const auto look = [&](Index i, Index first) {
    const auto crest = crest_of_piece(course, i, first);
    if (crest.p > extreme.value) extreme.value = crest.p, extreme.instant = crest.x;
    bound = std::max(bound, std::max(crest.p, norm[wrapped(i)]) + unresolved(i));
  };
  for (Index i = 0; i < (course.closed() ? n : n - 1); ++i) {
    const double ends = std::max(norm[i], norm[wrapped(i + 1)]);
    // A chord is left by an eighth of the second difference; four times that for its change.
    if (ends + std::max(bend[i], bend[wrapped(i + 1)]) / 2 + unresolved(i) > bound)
      look(i, course.first_for(i));
  }
  // Ends that meet with a kink between them look like a window's: each side is drawn on to the other.
  double largest_step = 0;
  for (Index i = 0; i + 1 < n; ++i)
    largest_step = std::max(largest_step, (course.at(i + 1) - course.at(i)).matrix().norm());
  if (!course.closed() && (course.at(0) - course.at(n - 1)).matrix().norm() <= 2 * largest_step) {
    look(n - 1, n - n_piece);
    look(-1, 0);
  }
  extreme.unresolved = bound - extreme.value;
  return extreme;
}

}  // namespace pipelines
