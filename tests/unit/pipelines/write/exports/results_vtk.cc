#include <gtest/gtest.h>
#include <vtkBiQuadraticQuad.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTriQuadraticHexahedron.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <set>

#include "fem/base/values/vtk_order.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/parallel.h"
#include "pipelines/write/exports/vtk_files.h"
#include "tests/unit/pipelines/examples/results_bar.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;
using results_test::mapped_cube;
using results_test::Point;
using results_test::quadratic_map;

namespace {

vtkSmartPointer<vtkUnstructuredGrid> read_vtk(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(VtkOrder, IsThatOfTheParametricCoordinatesOfVtk) {
  vtkNew<vtkTriQuadraticHexahedron> hexahedron;
  for (std::size_t v = 0; v < 27; ++v) {
    const int l = fem::vtk_hexahedron_from_lexicographic[v];
    const double* at = hexahedron->GetParametricCoords() + 3 * v;
    EXPECT_EQ(at[0], 0.5 * (l % 3));
    EXPECT_EQ(at[1], 0.5 * (l / 3 % 3));
    EXPECT_EQ(at[2], 0.5 * (l / 9));
  }
  vtkNew<vtkBiQuadraticQuad> quad;
  for (std::size_t v = 0; v < 9; ++v) {
    const int l = fem::vtk_quad_from_lexicographic[v];
    EXPECT_EQ(quad->GetParametricCoords()[3 * v], 0.5 * (l % 3));
    EXPECT_EQ(quad->GetParametricCoords()[3 * v + 1], 0.5 * (l / 3));
  }
}

/// 4 x 4 x 4 points inside and on the sides of a cell.
template <class Visit>
void at_points(Visit visit) {
  for (const double x : {0., 0.21, 0.77, 1.})
    for (const double y : {0., 0.34, 0.68, 1.})
      for (const double z : {0., 0.13, 0.59, 1.}) visit(Point{x, y, z});
}

TEST(EnvelopeVtu, VtkInterpolatesTheMapTheNodesCameFrom) {
  const Directory at;
  const int nx = 2, ny = 1, nz = 2;
  const auto nodes = mapped_cube(nx, ny, nz, quadratic_map);
  write_envelope_vtu(at / "e.vtu", nodes, {});
  const auto grid = read_vtk(at / "e.vtu");
  ASSERT_EQ(grid->GetNumberOfCells(), nx * ny * nz);
  ASSERT_EQ(grid->GetNumberOfPoints(), 5 * 3 * 5);
  for (int c = 0; c < nx * ny * nz; ++c) {
    ASSERT_EQ(grid->GetCellType(c), VTK_TRIQUADRATIC_HEXAHEDRON);
    const Point corner = {double(c % nx) / nx, double(c / nx % ny) / ny, double(c / nx / ny) / nz};
    at_points([&](const Point& p) {
      int sub = 0;
      double parametric[3] = {p[0], p[1], p[2]}, x[3], weights[27];
      grid->GetCell(c)->EvaluateLocation(sub, parametric, x, weights);
      const Point expected =
          quadratic_map({corner[0] + p[0] / nx, corner[1] + p[1] / ny, corner[2] + p[2] / nz});
      // Rounding: coordinates are of the order of 2, sums of 27 products.
      for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(x[d], expected[d], 1e-14);
    });
  }
}

/// Integral of det dx/dp over all cells of a grid with VTK's derivatives; 4-point Gauss rule, exact here.
double volume(vtkUnstructuredGrid& grid) {
  const double a = 0.5 * std::sqrt(3. / 7 - 2. / 7 * std::sqrt(1.2)),
               b = 0.5 * std::sqrt(3. / 7 + 2. / 7 * std::sqrt(1.2));
  const double wa = (18 + std::sqrt(30.)) / 72, wb = (18 - std::sqrt(30.)) / 72;
  const std::array<std::pair<double, double>, 4> rule = {
      {{0.5 - b, wb}, {0.5 - a, wa}, {0.5 + a, wa}, {0.5 + b, wb}}};
  double sum = 0;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    auto* cell = static_cast<vtkTriQuadraticHexahedron*>(grid.GetCell(c));
    for (const auto& [x, wx] : rule)
      for (const auto& [y, wy] : rule)
        for (const auto& [z, wz] : rule) {
          const double parametric[3] = {x, y, z};
          double derivatives[81], jacobian[3][3] = {};
          cell->InterpolateDerivs(parametric, derivatives);
          for (int v = 0; v < 27; ++v)
            for (int i = 0; i < 3; ++i)
              for (int j = 0; j < 3; ++j)
                jacobian[i][j] += cell->GetPoints()->GetPoint(v)[i] * derivatives[27 * j + v];
          sum += wx * wy * wz * vtkMath::Determinant3x3(jacobian);
        }
  }
  return sum;
}

TEST(EnvelopeVtu, CellsHaveTheVolumeOfTheBody) {
  const Directory at;
  // A quarter of a ring: radii 1 and 2, thickness 0.5, volume pi/4 (4 - 1) 0.5, right-handed.
  const auto ring = [](Point p) -> Point {
    const double r = 1 + p[0], angle = std::acos(-1.) / 2 * p[1];
    return {r * std::cos(angle), r * std::sin(angle), 0.5 * p[2]};
  };
  write_envelope_vtu(at / "e.vtu", mapped_cube(1, 8, 1, ring), {});
  // Quadratic arcs of 11 degrees miss the circle by 1e-6 of the radius; straight ones would by 1e-2.
  EXPECT_NEAR(volume(*read_vtk(at / "e.vtu")), 3.0 / 8 * std::acos(-1.), 1e-5);
}

/// What a user may call an effect or a port. VTK writes names into attributes as they are, so that an & in
/// one left a file that nothing reads.
TEST(EnvelopeVtu, NamesWithMarkupComeBack) {
  const Directory at;
  const auto nodes = mapped_cube(1, 1, 1, quadratic_map);
  const std::vector<double> shares(nodes.n * 2, 0.5);
  const std::string field = "share of R&D <b> \"q\" 'a'", first = "R&D < 3 kN > \"x\" 'y'", second = "&amp;";
  const std::vector<std::int32_t> ids(nodes.n, 7);
  write_envelope_vtu(at / "e.vtu", nodes, {nodal_field(field, shares, 2, {first, second})}, {{first, ids}},
                     VtuCompression::none, {{{field, {first, second}}}, {{second, {1}}}});
  const auto grid = read_vtk(at / "e.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), vtkIdType(nodes.n));
  auto* const read = grid->GetPointData()->GetArray(field.c_str());
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->GetComponentName(0), first);
  EXPECT_EQ(read->GetComponentName(1), second);
  ASSERT_NE(grid->GetPointData()->GetArray(first.c_str()), nullptr);
  EXPECT_EQ(read_node_ids(at / "e.vtu", first), ids);
  auto* const names = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray(field.c_str()));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetValue(0), first);
  EXPECT_NE(grid->GetFieldData()->GetArray(second.c_str()), nullptr);
}

TEST(EnvelopeVtu, FieldsComeBackInThePrecisionAskedFor) {
  const Directory at;
  const auto nodes = mapped_cube(2, 2, 1, quadratic_map);
  std::vector<double> stress(nodes.n * 6), peak(nodes.n);
  std::vector<std::int32_t> zone(nodes.n), cell(nodes.n_cells());
  for (std::size_t i = 0; i < stress.size(); ++i) stress[i] = 1e8 * std::sin(double(i));
  for (std::size_t i = 0; i < nodes.n; ++i) peak[i] = std::cos(double(i)), zone[i] = int(i) % 3 - 1;
  for (std::size_t i = 0; i < cell.size(); ++i) cell[i] = 100 + int(i);
  auto exact = nodal_field("peak", peak);
  exact.precision = FieldPrecision::float64;
  for (const auto compression : {VtuCompression::none, VtuCompression::zlib}) {
    write_envelope_vtu(at / "e.vtu", nodes,
                       {nodal_field("stress [Pa]", stress, 6, {"xx", "yy", "zz", "xy", "yz", "xz"}), exact},
                       {{"zone", zone}, {"cell", cell, IdField::At::cells}}, compression);
    const auto grid = read_vtk(at / "e.vtu");
    auto* points = grid->GetPointData();
    ASSERT_EQ(points->GetNumberOfArrays(), 3);
    auto* read_stress = points->GetArray("stress [Pa]");
    ASSERT_EQ(read_stress->GetNumberOfComponents(), 6);
    EXPECT_EQ(read_stress->GetDataType(), VTK_FLOAT);
    EXPECT_STREQ(read_stress->GetComponentName(4), "yz");
    EXPECT_EQ(points->GetArray("peak")->GetDataType(), VTK_DOUBLE);
    EXPECT_EQ(grid->GetPoints()->GetDataType(), VTK_DOUBLE);
    for (vtkIdType i = 0; i < vtkIdType(nodes.n); ++i) {
      for (int d = 0; d < 3; ++d) ASSERT_EQ(grid->GetPoint(i)[d], nodes.xyz_m[std::size_t(3 * i + d)]);
      for (int c = 0; c < 6; ++c)
        ASSERT_EQ(read_stress->GetComponent(i, c), float(stress[std::size_t(6 * i + c)]));
      ASSERT_EQ(points->GetArray("peak")->GetComponent(i, 0), peak[std::size_t(i)]);
      ASSERT_EQ(points->GetArray("zone")->GetComponent(i, 0), zone[std::size_t(i)]);
    }
    for (vtkIdType i = 0; i < vtkIdType(cell.size()); ++i)
      EXPECT_EQ(grid->GetCellData()->GetArray("cell")->GetComponent(i, 0), cell[std::size_t(i)]);
  }
}

TEST(EnvelopeVtu, FieldsBeyondSinglePrecisionAreDoubles) {
  const Directory at;
  const auto nodes = mapped_cube(1, 1, 1, quadratic_map);
  for (const double size : {1e-150, 0.0, 1.0, 1e150}) {
    const std::vector<double> values(nodes.n, size);
    write_envelope_vtu(at / "e.vtu", nodes, {nodal_field("load", values)});
    const auto grid = read_vtk(at / "e.vtu");
    auto* array = grid->GetPointData()->GetArray("load");
    ASSERT_NE(array, nullptr);
    EXPECT_EQ(array->GetTuple1(5), size);
    EXPECT_EQ(array->GetDataType(), size == 1 || size == 0 ? VTK_FLOAT : VTK_DOUBLE);
  }
}

TEST(SurfaceSnapshotVtu, FacesFollowTheMapOverTheirOwnNodes) {
  const Directory at;
  const int nx = 3, ny = 2, nz = 2;
  const auto nodes = mapped_cube(nx, ny, nz, quadratic_map);
  std::vector<double> x(nodes.n);
  for (std::size_t i = 0; i < nodes.n; ++i) x[i] = nodes.xyz_m[3 * i];
  write_surface_snapshot_vtu(at / "s.vtu", nodes, {nodal_field("x", x)});
  const auto grid = read_vtk(at / "s.vtu");
  ASSERT_EQ(grid->GetNumberOfCells(), 2 * (nx * ny + ny * nz + nz * nx));
  EXPECT_EQ(grid->GetNumberOfPoints(), 7 * 5 * 5 - 5 * 3 * 3);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    EXPECT_EQ(grid->GetPointData()->GetArray("x")->GetComponent(i, 0), float(grid->GetPoint(i)[0]));
  // The first faces are those of x = 0: (y, z) run over ny x nz faces.
  for (int f = 0; f < ny * nz; ++f) {
    EXPECT_EQ(grid->GetCellType(f), VTK_BIQUADRATIC_QUAD);
    EXPECT_EQ(grid->GetCellData()->GetArray("boundary_id")->GetComponent(f, 0), 0);
    at_points([&](const Point& p) {
      int sub = 0;
      double parametric[3] = {p[0], p[1], 0}, at_point[3], weights[9];
      grid->GetCell(f)->EvaluateLocation(sub, parametric, at_point, weights);
      const Point expected = quadratic_map({0, (f % ny + p[0]) / ny, (f / ny + p[1]) / nz});
      for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(at_point[d], expected[d], 1e-14);
    });
  }
}

// Arrays of many of VTK's blocks of 32 KiB: VTK reads every number back, and surfaces that several threads
// write at a time are those that one writes.
TEST(VtkFiles, ArraysOfManyBlocksComeBackWhole) {
  const Directory at;
  const auto nodes = mapped_cube(16, 16, 32, quadratic_map);
  std::vector<double> field(nodes.n);
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = std::sin(double(i * i % 1013));
  std::vector<std::int32_t> id(nodes.n_cells());
  ASSERT_EQ(id.size() * sizeof(std::int32_t), 32768u);
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = std::int32_t(i * i % 911);
  auto exact = nodal_field("f", field);
  exact.precision = FieldPrecision::float64;
  write_envelope_vtu(at / "e.vtu", nodes, {exact}, {{"id", id, IdField::At::cells}});
  const SurfaceSnapshots files(nodes);
  files.write(at / "alone.vtu", {exact});
  const auto name = [](std::size_t i) { return "s" + std::to_string(i) + ".vtu"; };
  for_each_parallel(12, 4, [&](std::size_t, std::size_t i) { files.write(at / name(i), {exact}); });
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(bytes(at / name(i)), bytes(at / "alone.vtu")) << i;
  const auto grid = read_vtk(at / "e.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), vtkIdType(nodes.n));
  ASSERT_EQ(grid->GetNumberOfCells(), vtkIdType(nodes.n_cells()));
  for (vtkIdType i = 0; i < vtkIdType(nodes.n); ++i) {
    ASSERT_EQ(grid->GetPointData()->GetArray("f")->GetComponent(i, 0), field[std::size_t(i)]);
    for (int d = 0; d < 3; ++d) ASSERT_EQ(grid->GetPoint(i)[d], nodes.xyz_m[std::size_t(3 * i + d)]);
  }
  for (vtkIdType c = 0; c < vtkIdType(nodes.n_cells()); ++c) {
    ASSERT_EQ(grid->GetCellData()->GetArray("id")->GetComponent(c, 0), id[std::size_t(c)]);
    for (int v = 0; v < 27; ++v)
      ASSERT_EQ(grid->GetCell(c)->GetPointId(v), nodes.cells[std::size_t(27 * c + v)]);
  }
}

TEST(VtkFiles, TwoWritesGiveTheSameBytesWithoutADate) {
  const Directory at;
  const auto nodes = mapped_cube(2, 2, 2, quadratic_map);
  const std::vector<double> field(nodes.n, 1.5);
  for (const char* name : {"a", "b"}) {
    write_envelope_vtu(at / (name + std::string(".vtu")), nodes, {nodal_field("f", field)});
    write_surface_snapshot_vtu(at / (name + std::string("_s.vtu")), nodes, {nodal_field("f", field)});
  }
  EXPECT_EQ(bytes(at / "a.vtu"), bytes(at / "b.vtu"));
  EXPECT_EQ(bytes(at / "a_s.vtu"), bytes(at / "b_s.vtu"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(at.path), {}), 4);
}

TEST(VtkFiles, WrongSizesAreRefusedAndTheOldFileStays) {
  const Directory at;
  const auto nodes = mapped_cube(1, 1, 1, quadratic_map);
  write_envelope_vtu(at / "e.vtu", nodes, {});
  const std::string old = bytes(at / "e.vtu");
  const std::vector<double> short_field(nodes.n - 1);
  EXPECT_THROW(write_envelope_vtu(at / "e.vtu", nodes, {nodal_field("f", short_field)}),
               std::invalid_argument);
  EXPECT_THROW(write_envelope_vtu(at / "e.vtu", nodes, {}, {{"zone", {1, 2}}}), std::invalid_argument);
  EXPECT_EQ(bytes(at / "e.vtu"), old);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(at.path), {}), 1);
}

// Goes red where the product is taken in 32 bits, or in 64 where that overflows too.
TEST(VtkFiles, IndicesBeyond32BitsAreRefusedByName) {
  constexpr std::size_t most = 2147483647;
  EXPECT_NO_THROW(refuse_beyond_32_bits("e.vtu", most, most / 27, 27));
  EXPECT_NO_THROW(refuse_beyond_32_bits("e.vtu", 0, 0, 0));
  EXPECT_THROW(refuse_beyond_32_bits("e.vtu", 100, most / 27 + 1, 27), FileError);
  EXPECT_THROW(refuse_beyond_32_bits("e.vtu", most + 1, 1, 27), FileError);
  EXPECT_THROW(refuse_beyond_32_bits("e.vtu", 100, std::size_t(1) << 62, 4), FileError);
  try {
    refuse_beyond_32_bits("out/e.vtu", 100, most, 27);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("out/e.vtu: 2147483647 cells of 27 nodes", 0), 0U)
        << error.what();
  }
}

TEST(VtkFiles, ADirectoryInTheWayIsAnErrorThatNamesTheFile) {
  const Directory at;
  std::filesystem::create_directories(at / "e.vtu/inside");
  EXPECT_THROW(write_envelope_vtu(at / "e.vtu", mapped_cube(1, 1, 1, quadratic_map), {}), std::exception);
}

TEST(Pvd, ListsTimesAndFiles) {
  const Directory at;
  write_pvd(at / "cycle.pvd", {{0, "cycle_00.vtu", "shaft"}, {0.1, "cycle_01.vtu", "a & \"b\""}});
  EXPECT_EQ(bytes(at / "cycle.pvd"),
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
            "  <Collection>\n"
            "    <DataSet timestep=\"0\" group=\"\" part=\"0\" name=\"shaft\" file=\"cycle_00.vtu\"/>\n"
            "    <DataSet timestep=\"0.1\" group=\"\" part=\"0\" name=\"a &amp; &quot;b&quot;\" "
            "file=\"cycle_01.vtu\"/>\n"
            "  </Collection>\n"
            "</VTKFile>\n");
}

}  // namespace
