// Cells of degree 1 and 3 in VTK files, as results_vtk.cc has those of degree 2.
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkHigherOrderQuadrilateral.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <functional>

#include "fem/base/values/vtk_order.h"
#include "pipelines/write/exports/vtk_files.h"
#include "tests/unit/pipelines/examples/results_bar.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::Directory;
using results_test::Point;

namespace {

vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& path) {
  const auto reader = vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(VtkOrder, OfLinearAndCubicCellsIsThatOfVtk) {
  for (const int degree : {1, 3}) {
    const int n = degree + 1, order[] = {degree, degree, degree, n * n * n};
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          EXPECT_EQ(
              fem::vtk_hexahedron_order(degree)[vtkHigherOrderHexahedron::PointIndexFromIJK(i, j, k, order)],
              i + n * (j + n * k));
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        EXPECT_EQ(fem::vtk_quad_order(degree)[vtkHigherOrderQuadrilateral::PointIndexFromIJK(i, j, order)],
                  i + n * j);
  }
}

/// One cell of a degree with evenly spaced nodes, seen through `map`, and its face z = 0.
fem::Nodes one_cell(int degree, const std::function<Point(Point)>& map) {
  const int n = degree + 1;
  fem::Nodes nodes;
  nodes.degree = degree;
  nodes.n = std::size_t(n) * n * n;
  nodes.volume_m3.assign(nodes.n, 1. / double(nodes.n));
  for (int l = 0; l < n * n * n; ++l)
    for (const double x :
         map({double(l % n) / degree, double(l / n % n) / degree, double(l / n / n) / degree}))
      nodes.xyz_m.push_back(x);
  nodes.cells.assign(fem::vtk_hexahedron_order(degree), fem::vtk_hexahedron_order(degree) + n * n * n);
  nodes.faces.assign(fem::vtk_quad_order(degree), fem::vtk_quad_order(degree) + n * n);
  nodes.face_boundary_id = {4};
  return nodes;
}

/// 4 x 4 x 4 points inside and on the sides of a cell.
template <class Visit>
void at_points_of_cells(Visit visit) {
  for (const double x : {0., 0.21, 0.77, 1.})
    for (const double y : {0., 0.34, 0.68, 1.})
      for (const double z : {0., 0.13, 0.59, 1.}) visit(Point{x, y, z});
}

TEST(EnvelopeVtu, LinearAndCubicCellsAreInterpolatedToo) {
  const Directory at;
  const auto trilinear = [](Point p) -> Point {
    return {2 * p[0] + 0.3 * p[1] * p[2], 1.5 * p[1] - 0.2 * p[0] * p[2], p[2] + 0.1 * p[0] * p[1] * p[2]};
  };
  const auto cubic = [](Point p) -> Point {
    return {2 * p[0] + 0.1 * p[1] * p[1] * p[1], 1.5 * p[1] + 0.2 * p[2] * p[2] * p[2] * p[0],
            p[2] - 0.1 * p[0] * p[0] * p[0] * p[1]};
  };
  for (const int degree : {1, 3}) {
    const std::function<Point(Point)> map = degree == 1 ? std::function<Point(Point)>(trilinear) : cubic;
    const auto nodes = one_cell(degree, map);
    write_envelope_vtu(at / "e.vtu", nodes, {});
    write_surface_snapshot_vtu(at / "s.vtu", nodes, {});
    const auto cell = read(at / "e.vtu"), face = read(at / "s.vtu");
    ASSERT_EQ(cell->GetCellType(0), degree == 1 ? VTK_HEXAHEDRON : VTK_LAGRANGE_HEXAHEDRON);
    ASSERT_EQ(face->GetCellType(0), degree == 1 ? VTK_QUAD : VTK_LAGRANGE_QUADRILATERAL);
    at_points_of_cells([&](const Point& p) {
      int sub = 0;
      double inside[3] = {p[0], p[1], p[2]}, below[3] = {p[0], p[1], 0}, x[3], y[3], weights[64];
      cell->GetCell(0)->EvaluateLocation(sub, inside, x, weights);
      face->GetCell(0)->EvaluateLocation(sub, below, y, weights);
      const Point expected = map(p), bottom = map({p[0], p[1], 0});
      for (std::size_t d = 0; d < 3; ++d) {  // rounding: coordinates of the order of 2, sums of 64 products
        EXPECT_NEAR(x[d], expected[d], 1e-13);
        EXPECT_NEAR(y[d], bottom[d], 1e-13);
      }
    });
  }
}

}  // namespace
