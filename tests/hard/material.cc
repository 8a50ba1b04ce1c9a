// Materials that hardly change their volume.
// References: Lame's cylinders, Saint-Venant's beams.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/hard/hard_case.h"
#include "tests/verification/fem/bodies/distorted_beam.h"
#include "tests/verification/fem/bodies/figures.h"
#include "tests/verification/fem/bodies/plane_strain_cylinder.h"

namespace {

using Component = fem::SurfaceResultant::Component;
using verification::PlaneStrainCylinder;
using verification::Point;

/// Largest error of any component of stress, of the largest exact one.
double stress_off(const PlaneStrainCylinder& cylinder, int n_cells, fem::Recovery recovery) {
  const auto s = verification::solve(cylinder.body(n_cells), cylinder.loads(), recovery);
  const auto exact = cylinder.exact();
  double worst = 0, size = 0;
  for (Eigen::Index i = 0; i < s.place_m.cols(); ++i) {
    const Eigen::Matrix<double, 6, 1> wanted = exact.stress_Pa(Point(s.place_m.col(i)));
    worst = std::max(worst, (s.stress_Pa.col(i) - wanted).cwiseAbs().maxCoeff());
    size = std::max(size, wanted.cwiseAbs().maxCoeff());
  }
  return worst / size;
}

}  // namespace

// Discretisation of cells that lock, measured with a third to spare.
TEST(HardMaterial, Incompressible4999) {
  const PlaneStrainCylinder pressed{false, fem::CellKind::hexahedra, 2, 0.1, 0.4999};
  hard_cases::check({"material", "cylinder under pressure, Poisson's ratio 0.4999, degree 2",
                     "lambda div u: 5000 times a strain that is nearly nothing", "mean of the cells' stress",
                     stress_off(pressed, 8, fem::Recovery::average),
                     stress_off(pressed, 8, fem::Recovery::patch), 0.035});
  const PlaneStrainCylinder spun{true, fem::CellKind::hexahedra, 3, 0.1, 0.4999};
  hard_cases::check({"material", "spinning cylinder, Poisson's ratio 0.4999, degree 3",
                     "lambda div u is not constant", "mean of the cells' stress",
                     stress_off(spun, 4, fem::Recovery::average), stress_off(spun, 4, fem::Recovery::patch),
                     3e-3});
}

// Bending on distorted cells is in the space: what is left is rounding times lambda / mu = 5e6.
TEST(HardMaterial, Incompressible4999999) {
  const Point size(0.03, 0.04, 0.12);
  const auto body = verification::distorted_beam(size, {2, 2, 3}, 0.06, {200e9, 0.4999999, 7850}, 2);
  const double second = size[0] * std::pow(size[1], 3) / 12;
  const auto off = [&](fem::Recovery recovery) {
    const auto s =
        verification::solve(body,
                            {{verification::on_face(verification::begin_3, {0, 0, 0}, Component::mx), -1},
                             {verification::on_face(verification::end_3, {0, 0, size[2]}, Component::mx), 1}},
                            recovery, fem::Solver::direct);
    double worst = 0;
    for (Eigen::Index i = 0; i < s.place_m.cols(); ++i) {
      Eigen::Matrix<double, 6, 1> wanted = Eigen::Matrix<double, 6, 1>::Zero();
      wanted[2] = s.place_m(1, i) / second;
      worst = std::max(worst, (s.stress_Pa.col(i) - wanted).cwiseAbs().maxCoeff());
    }
    return worst / (size[1] / 2 / second);
  };
  hard_cases::check({"material", "bending, Poisson's ratio 0.4999999",
                     "rounding of div u is multiplied by 5e6", "mean of the cells' stress",
                     off(fem::Recovery::average), off(fem::Recovery::patch), 1e-6});
}
