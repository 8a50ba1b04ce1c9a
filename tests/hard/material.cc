// Materials that hardly change their volume, and materials 1e8 times stiffer than their neighbours.
// References: Lame's cylinders, Saint-Venant's beams.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/hard/hard_case.h"
#include "tests/verification/fem/bodies/distorted_beam.h"
#include "tests/verification/fem/bodies/figures.h"
#include "tests/verification/fem/bodies/plane_strain_cylinder.h"
#include "tests/verification/fem/bodies/two_layers.h"

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

// A soft tube in a hard one and a hard one in a soft one: hoop stress beside the interface, on each side.
// Six cells of ratio 1.06 in radius: 1 %.
TEST(HardMaterial, ModulusJumpsBy1e8) {
  using namespace verification::two_layers;
  for (const bool is_inside_hard : {false, true}) {
    const auto inner = is_inside_hard ? hard(1e8, 0) : soft(0),
               outer = is_inside_hard ? soft(0) : hard(1e8, 0);
    const auto s =
        verification::solve(tube(true, inner, outer), inside(), fem::Recovery::patch, fem::Solver::direct);
    const Lame exact(inner, outer);
    const auto is_outer = outer_nodes(s);
    double ours = 0, naive = 0, scale[2] = {0, 0};
    for (const bool side : {false, true})
      for (const double r : {a, b, c}) scale[side] = std::max(scale[side], std::abs(exact.hoop_Pa(side, r)));
    double hoop[2] = {0, 0};  // at (b, 0) on both sides
    for (Eigen::Index i = 0; i < s.place_m.cols(); ++i) {
      const Point x = s.place_m.col(i);
      const double r = x.head<2>().norm(), cos = x[0] / r, sin = x[1] / r;
      const auto t = s.stress_Pa.col(i);
      const double own = sin * sin * t[0] + cos * cos * t[1] - 2 * sin * cos * t[3];
      const bool side = is_outer[std::size_t(i)];
      // Of a side that carries 1e-8 of the other's stress, what the pressure through it is.
      const double size =
          std::max({scale[side], std::abs(exact.radial_Pa(side, b)), std::abs(exact.radial_Pa(side, c))});
      ours = std::max(ours, std::abs(own - exact.hoop_Pa(side, r)) / size);
      if ((x - Point(b, 0, 0)).norm() < 1e-9) hoop[side] = own;
    }
    for (const bool side : {false, true})
      naive = std::max(naive, std::abs((hoop[0] + hoop[1]) / 2 - exact.hoop_Pa(side, b)) / scale[side]);
    hard_cases::check(
        {"material",
         is_inside_hard ? "hard tube in one 1e8 times softer" : "soft tube in one 1e8 times harder",
         "hoop stress jumps by 1e8 at the interface", "mean of both sides at the interface", naive, ours,
         0.01});
  }
}
