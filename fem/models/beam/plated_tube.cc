#include "fem/models/beam/plated_tube.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "fem/base/common/dense_algebra.h"
#include "fem/base/values/constants.h"

namespace fem {
namespace {

constexpr double thickest_wall = 0.3;
constexpr int most_pieces = 24;
/// Waves of the series per wall thickness, around and along: half a wave of the shortest is one wall.
constexpr double waves_per_wall = 1;

/// Piece of a plate's arc with constant traction.
struct Piece {
  std::size_t plate = 0;
  double middle_rad = 0, half_angle_rad = 0;
};

/// sin(x) / x.
double sinc(double x) {
  return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x;
}

class Shell {
public:
  explicit Shell(const PlatedTube& tube)
      : tube_(tube), radius_m_(tube.outer_radius_m - tube.wall_m / 2), length_m_(tube.end_m - tube.begin_m) {
    const double e = tube.material.youngs_modulus_Pa, nu = tube.material.poisson_ratio;
    bending_Nm_ = e * std::pow(tube.wall_m, 3) / (12 * (1 - nu * nu));
    n_around_ = int(std::ceil(pi * radius_m_ / tube.wall_m * waves_per_wall));
    n_along_ = int(std::ceil(length_m_ / tube.wall_m * waves_per_wall));
    for (std::size_t p = 0; p < tube.plates.size(); ++p) add_pieces(p);
    along_.resize(Eigen::Index(tube.plates.size()), n_along_);
    for (std::size_t p = 0; p < tube.plates.size(); ++p)
      for (int m = 1; m <= n_along_; ++m) along_(Eigen::Index(p), m - 1) = sine_of_band(tube.plates[p], m);
    spread_tractions();
  }

  /// @return plates x loads, the last index fastest: hoop and axial stress on the outside [Pa]
  Eigen::Matrix2Xd stress_Pa(const TubePoint& point) const {
    const double nu = tube_.material.poisson_ratio, t = tube_.wall_m, r = radius_m_;
    const double stretch = tube_.material.youngs_modulus_Pa / r;
    const auto n_plates = Eigen::Index(tube_.plates.size());
    Eigen::Matrix2Xd result = Eigen::Matrix2Xd::Zero(2, n_plate_loads * n_plates);
    for (int n = 0; n <= n_around_; ++n) {
      // Stress per traction of each band, around at its largest.
      Eigen::Matrix2Xd of_band = Eigen::Matrix2Xd::Zero(2, n_plates);
      for (int m = 1; m <= n_along_; ++m) {
        const double lambda = m * pi * r / length_m_, l2 = lambda * lambda, n2 = double(n) * n;
        const double at_point = std::sin(m * pi * (point.z_m - tube_.begin_m) / length_m_),
                     a2 = (l2 + n2) * (l2 + n2);
        const double bend = 6 * bending_Nm_ / (r * r * t * t);
        const Eigen::Vector2d per_w(bend * (n2 - 1 + nu * l2) + stretch * l2 * l2 / a2,
                                    bend * (l2 + nu * (n2 - 1)) + stretch * l2 * n2 / a2);
        of_band +=
            per_w * at_point * flexibility_m3_N(n, m) * along_.col(m - 1).transpose() * (2 / length_m_);
      }
      result += product(of_band, around(n, point.angle_rad));
    }
    return result;
  }

private:
  /// Pieces by the cosine rule, ends no shorter than one wall.
  void add_pieces(std::size_t p) {
    const auto& plate = tube_.plates[p];
    const double half_m = plate.half_angle_rad * radius_m_;
    int n = 2;
    while (n < most_pieces && half_m * (1 - std::cos(pi / (n + 1))) >= tube_.wall_m) ++n;
    for (int i = 0; i < n; ++i) {
      const double begin = -std::cos(pi * i / n), end = -std::cos(pi * (i + 1) / n);
      pieces_.push_back({p, plate.middle_rad + plate.half_angle_rad * (begin + end) / 2,
                         plate.half_angle_rad * (end - begin) / 2});
    }
  }

  /// Integral of the sine over a band of unit line load.
  double sine_of_band(const TubePlate& plate, int m) const {
    const double k = m * pi / length_m_;
    return std::sin(k * (plate.z_m - tube_.begin_m)) * sinc(k * plate.thickness_m / 2);
  }

  /// w over q for q cos(n angle) sin(m pi z / L): Morley's equation, D in bending against E t in stretching.
  double flexibility_m3_N(int n, int m) const {
    const double nu = tube_.material.poisson_ratio, ratio = radius_m_ / tube_.wall_m;
    const double lambda = m * pi * radius_m_ / length_m_, l2 = lambda * lambda, a = l2 + double(n) * n;
    return std::pow(radius_m_, 4) / bending_Nm_ * a * a /
           (a * a * (a - 1) * (a - 1) + 12 * (1 - nu * nu) * ratio * ratio * l2 * l2);
  }

  /// Fourier coefficient of a piece of unit traction, times the cosine of what angle lies between.
  static double wave(int n, double half_angle_rad) {
    return (n == 0 ? 1 : 2) * half_angle_rad / pi * sinc(n * half_angle_rad);
  }

  /// n-th wave of the tractions at an angle: a row of plates (their bands), a column per load.
  Eigen::MatrixXd around(int n, double angle_rad) const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(Eigen::Index(tube_.plates.size()), traction_N_m_.cols());
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      sum.row(Eigen::Index(pieces_[i].plate)) += wave(n, pieces_[i].half_angle_rad) *
                                                 std::cos(n * (angle_rad - pieces_[i].middle_rad)) *
                                                 traction_N_m_.row(Eigen::Index(i));
    for (std::size_t p = 0; p < tube_.plates.size(); ++p)
      sum(Eigen::Index(p), Eigen::Index(n_plate_loads * p + 2)) += tangential_wave(n, p, angle_rad);
    return sum;
  }

  /// The even tangential traction that carries 1 N m, as radial load of equal work: w sin(n a), v = w/n
  /// cos(n a).
  double tangential_wave(int n, std::size_t p, double angle_rad) const {
    if (n == 0) return 0;  // torsion alone
    const auto& plate = tube_.plates[p];
    return even_traction_N_m(plate) * wave(n, plate.half_angle_rad) / n *
           std::sin(n * (angle_rad - plate.middle_rad));
  }
  double even_traction_N_m(const TubePlate& plate) const {
    return 1 / (2 * plate.half_angle_rad * radius_m_ * radius_m_);
  }

  /// Radial tractions for each load: the middles of a plate's pieces move like a rigid arc, resultants are
  /// given.
  void spread_tractions() {
    const auto n_pieces = Eigen::Index(pieces_.size()), n_plates = Eigen::Index(tube_.plates.size());
    const auto n = n_pieces + 2 * n_plates;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n),
                    right = Eigen::MatrixXd::Zero(n, n_plate_loads * n_plates);
    const auto flexibility = band_flexibility();
    for (Eigen::Index i = 0; i < n_pieces; ++i) {
      const auto& here = pieces_[std::size_t(i)];
      const auto to = Eigen::Index(here.plate);
      for (int k = 0; k <= n_around_; ++k) {
        for (Eigen::Index j = 0; j < n_pieces; ++j) {
          const auto& there = pieces_[std::size_t(j)];
          matrix(i, j) += flexibility[std::size_t(k)](to, Eigen::Index(there.plate)) *
                          wave(k, there.half_angle_rad) * std::cos(k * (here.middle_rad - there.middle_rad));
        }
        for (Eigen::Index p = 0; p < n_plates; ++p)
          right(i, n_plate_loads * p + 2) -=
              flexibility[std::size_t(k)](to, p) * tangential_wave(k, std::size_t(p), here.middle_rad);
      }
      const Eigen::Vector2d out(std::cos(here.middle_rad), std::sin(here.middle_rad));
      const double length_m = 2 * radius_m_ * std::sin(here.half_angle_rad);
      matrix.block<1, 2>(i, n_pieces + 2 * to) = -out.transpose() / youngs_scale();
      matrix.block<2, 1>(n_pieces + 2 * to, i) = length_m * out;
    }
    for (Eigen::Index p = 0; p < n_plates; ++p) {
      const auto& plate = tube_.plates[std::size_t(p)];
      const double pull = even_traction_N_m(plate) * 2 * radius_m_ * std::sin(plate.half_angle_rad);
      const auto row = n_pieces + 2 * p, column = n_plate_loads * p;
      right(row, column) = right(row + 1, column + 1) = 1;
      right(row, column + 2) =
          pull * std::sin(plate.middle_rad);  // minus what the tangential traction brings
      right(row + 1, column + 2) = -pull * std::cos(plate.middle_rad);
    }
    traction_N_m_ = solve_with_full_pivoting(matrix, right).topRows(n_pieces);
  }

  /// Makes rigid motions unknowns of the size of tractions.
  double youngs_scale() const { return tube_.material.youngs_modulus_Pa * tube_.wall_m / radius_m_; }

  /// For every wave around: mean displacement of a plate's band for the unit line load of another one's.
  std::vector<Eigen::MatrixXd> band_flexibility() const {
    std::vector<Eigen::MatrixXd> result;
    for (int n = 0; n <= n_around_; ++n) {
      Eigen::VectorXd weight(n_along_);
      for (int m = 1; m <= n_along_; ++m) weight[m - 1] = 2 / length_m_ * flexibility_m3_N(n, m);
      result.push_back(product(along_ * weight.asDiagonal(), along_.transpose()));
    }
    return result;
  }

  const PlatedTube& tube_;
  double radius_m_, length_m_, bending_Nm_ = 0;
  int n_around_ = 0, n_along_ = 0;
  std::vector<Piece> pieces_;
  Eigen::MatrixXd along_;         // plates x waves along
  Eigen::MatrixXd traction_N_m_;  // pieces x loads: force per length of arc
};

void refuse_impossible(const PlatedTube& tube) {
  const double length_m = tube.end_m - tube.begin_m;
  if (!(tube.outer_radius_m > 0) || !(tube.wall_m > 0) ||
      !(tube.wall_m <= thickest_wall * tube.outer_radius_m) || !(length_m > 0) ||
      !(tube.material.youngs_modulus_Pa > 0))
    throw std::invalid_argument("a tube of radius " + std::to_string(tube.outer_radius_m) + " m, wall " +
                                std::to_string(tube.wall_m) + " m, length " + std::to_string(length_m) +
                                " m: sizes and modulus must be positive, the wall at most 0.3 of the radius");
  for (const auto& plate : tube.plates)
    if (!(plate.half_angle_rad > 0) || !(plate.half_angle_rad < pi) || !(plate.thickness_m > 0) ||
        !(plate.z_m > tube.begin_m) || !(plate.z_m < tube.end_m))
      throw std::invalid_argument("a plate at z = " + std::to_string(plate.z_m) + " m over " +
                                  std::to_string(2 * plate.half_angle_rad) +
                                  " rad: must lie between the tube's ends and have a size");
}

}  // namespace

std::vector<std::array<double, 6>> plated_tube_stress_Pa(const PlatedTube& tube,
                                                         const std::vector<TubePoint>& points) {
  refuse_impossible(tube);
  const Shell shell(tube);
  std::vector<std::array<double, 6>> result;
  for (const auto& point : points) {
    const double c = std::cos(point.angle_rad), s = std::sin(point.angle_rad);
    const auto stress = shell.stress_Pa(point);
    for (Eigen::Index k = 0; k < stress.cols(); ++k) {
      const double hoop = stress(0, k);
      result.push_back({hoop * s * s, hoop * c * c, stress(1, k), -hoop * s * c, 0, 0});
    }
  }
  return result;
}

}  // namespace fem
