// Files of quadratic tetrahedra, read back by VTK and by ourselves.
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "pipelines/respond/responses/response_files.h"
#include "pipelines/superpose/envelope/zones.h"
#include "pipelines/write/exports/vtk_files.h"
#include "tests/unit/pipelines/examples/results_bar.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::Directory;
using results_test::mapped_tetrahedra;
using results_test::Point;

namespace {

/// Of degree two in all coordinates together, without any symmetry: a wrong order of nodes shows.
Point curved(Point p) {
  const auto [x, y, z] = p;
  return {2 * x + 0.2 * y * y + 0.1 * x * z, 1.5 * y + 0.15 * z * z - 0.1 * x * y,
          z + 0.1 * x * y - 0.2 * z * y};
}

vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Compares VTK's interpolation inside every cell with the map at the mean of straight corners.
void expect_map(vtkUnstructuredGrid& grid, vtkUnstructuredGrid& straight, int type, vtkIdType n_cells) {
  ASSERT_EQ(grid.GetNumberOfCells(), n_cells);
  for (vtkIdType c = 0; c < n_cells; ++c) {
    ASSERT_EQ(grid.GetCellType(c), type);
    for (const Point p : {Point{0.2, 0.3, 0.1}, Point{0.5, 0.1, 0.2}, Point{0.05, 0.4, 0.45}}) {
      int sub = 0;
      double parametric[3] = {p[0], p[1], type == VTK_QUADRATIC_TETRA ? p[2] : 0}, x[3], s[3], weights[10];
      grid.GetCell(c)->EvaluateLocation(sub, parametric, x, weights);
      straight.GetCell(c)->EvaluateLocation(sub, parametric, s, weights);
      const Point expected = curved({s[0], s[1], s[2]});
      for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(x[d], expected[d], 1e-14);  // rounding of sums of 10
    }
  }
}

TEST(TetrahedraVtu, VtkInterpolatesTheMapTheNodesCameFrom) {
  const Directory at;
  const auto identity = [](Point p) { return p; };
  write_envelope_vtu(at / "e.vtu", mapped_tetrahedra(curved), {});
  write_envelope_vtu(at / "straight.vtu", mapped_tetrahedra(identity), {});
  expect_map(*read(at / "e.vtu"), *read(at / "straight.vtu"), VTK_QUADRATIC_TETRA, 6);
  write_surface_snapshot_vtu(at / "s.vtu", mapped_tetrahedra(curved), {});
  write_surface_snapshot_vtu(at / "flat.vtu", mapped_tetrahedra(identity), {});
  expect_map(*read(at / "s.vtu"), *read(at / "flat.vtu"), VTK_QUADRATIC_TRIANGLE, 12);
  EXPECT_EQ(read(at / "s.vtu")->GetNumberOfPoints(), 26);  // all but the middle of the cube
}

TEST(TetrahedraResponses, ComeBack) {
  const Directory at;
  fem::UnitResponses written;
  written.channels = {"seat.fx"};
  written.resultants.resize(1);
  written.nodes = mapped_tetrahedra(curved);
  written.displacement_m.assign(written.nodes.n * 3, 1);
  written.stress_Pa.assign(written.nodes.n * 6, 2);
  write_unit_responses(at / "r.h5", "key", written);
  const auto read = read_unit_responses(at / "r.h5", "key");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->nodes.kind, fem::CellKind::tetrahedra);
  EXPECT_EQ(read->nodes.cells, written.nodes.cells);
  EXPECT_EQ(read->nodes.faces, written.nodes.faces);
}

// All six share the diagonal from corner 0 to (1, 1, 1), and nothing else lies on all of them.
TEST(TetrahedraZones, AreConnectedThroughCells) {
  const auto nodes = mapped_tetrahedra(curved);
  NodalMaximum envelope;
  envelope.value_Pa.assign(27, 0);
  envelope.instant.assign(27, 0);
  envelope.stress_Pa.assign(27, {});
  for (const std::size_t node : {2, 6})
    envelope.value_Pa[node] = 5;  // (1, 0, 0) and (0, 1, 0): no common cell
  const auto places = locate_nodes(nodes, {{"surface", meshes::Feature::Kind::surface, 3, 0, 1}}, {}, {});
  EXPECT_EQ(find_zones(nodes, envelope, places, 4, 10).zones.size(), 2u);
  envelope.value_Pa[13] = 5;  // the middle of the diagonal
  EXPECT_EQ(find_zones(nodes, envelope, places, 4, 10).zones.size(), 1u);
}

}  // namespace
