/// What a viewer finds in envelope.vtu and in the snapshots beside what is reported. Read back by VTK.
#include <gtest/gtest.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/write/files/envelope_files.h"
#include "tests/unit/pipelines/examples/results_bar.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::Directory;

namespace {

template <typename Reader>
vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return vtkUnstructuredGrid::SafeDownCast(reader->GetOutput());
}

vtkDataArray& array_of(vtkUnstructuredGrid& grid, const std::string& field) {
  auto* array = grid.GetPointData()->GetArray(field.c_str());
  if (array == nullptr) throw std::out_of_range(field);
  return *array;
}

/// What ParaView lists of all nodes.
double largest(vtkUnstructuredGrid& grid, const std::string& field) {
  return array_of(grid, field).GetRange(-1)[1];
}

/// The largest of nodes that are not left out.
double largest_that_counts(vtkUnstructuredGrid& grid, const std::string& field) {
  auto& values = array_of(grid, field);
  auto& left_out = array_of(grid, "left_out");
  double most = 0;
  for (vtkIdType i = 0; i < values.GetNumberOfTuples(); ++i)
    if (left_out.GetComponent(i, 0) == 0) most = std::max(most, values.GetComponent(i, 0));
  return most;
}

std::vector<std::string> names_in(vtkUnstructuredGrid& grid, const char* list) {
  auto* array = vtkStringArray::SafeDownCast(grid.GetFieldData()->GetAbstractArray(list));
  std::vector<std::string> names;
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfValues(); ++i)
    names.push_back(array->GetValue(i));
  return names;
}

/// Component d of the unit displacement at z.
double moved_m(double z, int d) {
  return 1e-6 * (1 + z + 2 * d);
}

/// Tensors and displacements are rounded to 2^-12 of the largest value or less.
constexpr double steps = 1.0 / 4096;

/// A bar of four cells along z with a stress that grows towards z = 0, where it is not converged, at two
/// instants; a weld toe at the middle has more than the peak.
struct Case {
  Scene scene;
  kinetics::LoadHistory loads;
  Judged analysis;

  Case() {
    auto& a = analysis;
    auto& nodes = a.responses.nodes;
    nodes = results_test::mapped_cube(1, 1, 4, [](results_test::Point p) { return p; });
    scene.sampling = {1, 2};
    scene.snapshots = 2;
    loads.time_s = Eigen::ArrayXd::LinSpaced(2, 0, 1);
    loads.phi_rad = Eigen::ArrayXd::LinSpaced(2, 0, M_PI);
    a.scene.name = "part";
    a.scene.yield_strength_Pa = 200e6;
    a.responses.channels = {"pull"};
    a.loads.history.effects = {"pull"};
    a.loads.history.values = Eigen::ArrayXXd(1, 2);
    a.loads.history.values << 0.5, 1;
    a.places.excluded.assign(nodes.n, 0);
    a.zones.zone_of_node.assign(nodes.n, 0);
    for (std::size_t i = 0; i < nodes.n; ++i) {
      const double z = nodes.xyz_m[3 * i + 2], stress_Pa = 20e6 / (z + 0.05);
      const Stress tensor{0, 0, stress_Pa, 0, 0, 0};
      for (int d = 0; d < 3; ++d) a.responses.displacement_m.push_back(moved_m(z, d));
      a.responses.stress_Pa.insert(a.responses.stress_Pa.end(), tensor.begin(), tensor.end());
      a.places.excluded[i] = z < 0.3;
      for (auto* maximum : {&a.envelope.von_mises, &a.envelope.principal}) {
        maximum->value_Pa.push_back(stress_Pa);
        maximum->instant.push_back(1);
        maximum->stress_Pa.push_back(tensor);
      }
      a.envelope.effect_share.push_back(1);
    }
    a.peak.node = peak_node(a.envelope.von_mises.value_Pa, a.places);
    a.peak.value_Pa = a.envelope.von_mises.value_Pa[a.peak.node];
    a.peak.instant = 1;
    HotSpotStress spot;
    spot.name = "web, edge";
    spot.toe_m = {0.5, 0, 0.25};
    spot.von_mises_Pa = 70e6;
    spot.instant = 1;
    a.hot_spots = {spot};
    for (std::size_t f = 0; f < nodes.n_faces(); ++f) {
      double z = 0;
      for (const auto node : nodes.face(f)) z += nodes.xyz_m[3 * std::size_t(node) + 2];
      nodes.face_boundary_id[f] = z == double(nodes.nodes_per_face()) ? 7 : 1;  // 7: the end z = 1
    }
    meshes::Feature side, end;
    side.name = "side", side.boundary_id = 1;
    end.name = "end", end.boundary_id = 7;
    a.mesh.features = {side, end};
    meshes::Port port;
    port.name = "seat", port.boundary_id = 7;
    a.mesh.ports = {port};
    Zone zone;
    zone.feature = "side";
    a.zones.zones = {zone};
  }
};

void expect_the_headlines(vtkUnstructuredGrid& grid, const Case& c) {
  constexpr double rounding = 1e-7;  // single precision
  const double peak_Pa = c.analysis.peak.value_Pa, hot_spot_Pa = c.analysis.hot_spots[0].von_mises_Pa;
  EXPECT_NEAR(largest_that_counts(grid, von_mises_field), peak_Pa, rounding * peak_Pa);
  EXPECT_NEAR(largest_that_counts(grid, "largest principal stress, maximum [Pa]"), peak_Pa,
              rounding * peak_Pa);
  EXPECT_NEAR(largest(grid, hot_spot_field), hot_spot_Pa, rounding * hot_spot_Pa);
  EXPECT_NEAR(largest(grid, "hot-spot stress at weld toes [MPa]"), 70, 70 * rounding);
  EXPECT_NEAR(largest(grid, von_mises_field), 400e6, 40) << "what is left out keeps its value";
  for (const char* field : {von_mises_field, "safety against yield", "stress at maximum [Pa]", "effect share",
                            "drive angle of maximum [deg]", "displacement at governing stress [m]"}) {
    auto& values = array_of(grid, field);
    for (vtkIdType i = 0; i < values.GetNumberOfTuples(); ++i)
      for (int k = 0; k < values.GetNumberOfComponents(); ++k)
        EXPECT_TRUE(std::isfinite(values.GetComponent(i, k))) << field << ": viewers draw holes";
  }
  auto &in_Pa = array_of(grid, von_mises_field),
       &for_people = array_of(grid, "von Mises stress, maximum [MPa]"),
       &left_out = array_of(grid, "left_out"), &port = array_of(grid, "port"),
       &moved = array_of(grid, "displacement at governing stress [m]");
  for (vtkIdType i = 0; i < in_Pa.GetNumberOfTuples(); ++i) {
    const double z = grid.GetPoint(i)[2];
    EXPECT_EQ(left_out.GetComponent(i, 0), z < 0.3);
    EXPECT_EQ(port.GetComponent(i, 0), z == 1) << "the end is the first port";
    EXPECT_NEAR(for_people.GetComponent(i, 0) * 1e6, in_Pa.GetComponent(i, 0),
                2 * rounding * in_Pa.GetComponent(i, 0));
    EXPECT_NEAR(moved.GetComponent(i, 1), moved_m(z, 1), steps * moved_m(1, 2))
        << "at instant 1, of factor 1";
  }
  const auto* shown_first = grid.GetPointData()->GetScalars();
  ASSERT_NE(shown_first, nullptr);
  EXPECT_EQ(const_cast<vtkDataArray*>(shown_first)->GetName(),
            std::string("von Mises stress, maximum [MPa]"));
}

}  // namespace

TEST(EnvelopeFile, HasTheReportedStressesAsItsLargest) {
  const Directory at;
  const Case c;
  write_envelope_files(at.path, c.scene, c.loads, c.analysis, 1);
  const auto grid = read<vtkXMLUnstructuredGridReader>(at / "envelope.vtu");
  expect_the_headlines(*grid, c);
  auto* data = grid->GetFieldData();
  EXPECT_EQ(data->GetArray("governing stress [Pa]")->GetComponent(0, 0), 70e6);
  EXPECT_EQ(data->GetArray("governing stress, position [m]")->GetComponent(2, 0), 0.25);
  auto* place = vtkStringArray::SafeDownCast(data->GetAbstractArray("governing stress, place"));
  ASSERT_NE(place, nullptr);
  EXPECT_EQ(place->GetValue(0), "hot-spot stress at web, edge");
  EXPECT_EQ(names_in(*grid, "zone name"), std::vector<std::string>{"side"});
  EXPECT_EQ(names_in(*grid, "port name"), std::vector<std::string>{"seat"});
  EXPECT_EQ(names_in(*grid, "feature name"), (std::vector<std::string>{"side", "end"}));
  write_whole_envelope(at / "whole.vtu", c.scene, c.loads, c.analysis);
  EXPECT_EQ(results_test::bytes(at / "whole.vtu"), results_test::bytes(at / "envelope.vtu"));
}

TEST(EnvelopeFile, InPiecesToo) {
  const Directory at;
  const Case c;
  write_envelope_files(at.path, c.scene, c.loads, c.analysis, 2);
  expect_the_headlines(*read<vtkXMLPUnstructuredGridReader>(at / "envelope.pvtu"), c);
}

TEST(EnvelopeFile, ABodyWithoutSharpEdgesHasNothingLeftOut) {
  const Directory at;
  Case c;
  std::fill(c.analysis.places.excluded.begin(), c.analysis.places.excluded.end(), 0);
  c.analysis.hot_spots.clear();
  write_envelope_files(at.path, c.scene, c.loads, c.analysis, 1);
  const auto grid = read<vtkXMLUnstructuredGridReader>(at / "envelope.vtu");
  EXPECT_EQ(grid->GetPointData()->GetArray(hot_spot_field), nullptr);
  EXPECT_EQ(largest(*grid, "left_out"), 0);
}

TEST(EnvelopeFile, SnapshotsHaveTheTensorAndTheDisplacement) {
  const Directory at;
  const Case c;
  write_cycle_files(at.path, c.scene, c.loads, c.analysis);
  const double peak_Pa = c.analysis.peak.value_Pa;
  for (const auto& [file, factor] : {std::pair{"cycle_000.vtu", 0.5}, {"cycle_001.vtu", 1.0}}) {
    const auto grid = read<vtkXMLUnstructuredGridReader>(at / file);
    EXPECT_NEAR(largest_that_counts(*grid, "von Mises stress [Pa]"), factor * peak_Pa, 1e-7 * peak_Pa);
    EXPECT_NEAR(largest(*grid, "von Mises stress [MPa]"), factor * 400, 4e-5);
    auto& tensor = array_of(*grid, "stress [Pa]");
    for (vtkIdType i = 0; i < tensor.GetNumberOfTuples(); ++i)
      for (int k = 0; k < 6; ++k) {
        const double wanted_Pa = k == 2 ? factor * 20e6 / (grid->GetPoint(i)[2] + 0.05) : 0;
        EXPECT_NEAR(tensor.GetComponent(i, k), wanted_Pa, factor * steps * 400e6)
            << tensor.GetComponentName(k);
      }
    EXPECT_EQ(names_in(*grid, "port name"), std::vector<std::string>{"seat"});
    auto* moved = grid->GetPointData()->GetArray("displacement [m]");
    for (vtkIdType i = 0; i < moved->GetNumberOfTuples(); ++i)
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(moved->GetComponent(i, d), factor * moved_m(grid->GetPoint(i)[2], d),
                    factor * steps * moved_m(1, 2));
  }
}

TEST(EnvelopeFile, SnapshotsAreTheSameByAnyNumberOfThreads) {
  const Directory one, three;
  const Case c;
  write_cycle_files(one.path, c.scene, c.loads, c.analysis, 1);
  write_cycle_files(three.path, c.scene, c.loads, c.analysis, 3);
  for (const char* file : {"cycle.pvd", "cycle_000.vtu", "cycle_001.vtu"})
    EXPECT_EQ(results_test::bytes(three / file), results_test::bytes(one / file)) << file;
}

// One file opens every body, of one file or of pieces, and the script beside it is the one of ParaView.
TEST(EnvelopeFile, AllBodiesOpenAsOne) {
  const Directory at;
  const Case c;
  for (const int n_pieces : {1, 2}) {
    for (const char* body : {"shaft", "drum & co"}) {
      std::filesystem::create_directories(at / body);
      write_envelope_files(at / body, c.scene, c.loads, c.analysis, n_pieces);
    }
    write_bodies_together(at.path, {"shaft", "drum & co"}, n_pieces);
    vtkNew<vtkXMLMultiBlockDataReader> reader;
    reader->SetFileName((at / "bodies.vtm").c_str());
    reader->Update();
    auto* all = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
    ASSERT_EQ(all->GetNumberOfBlocks(), 2u);
    EXPECT_EQ(all->GetMetaData(1)->Get(vtkCompositeDataSet::NAME()), std::string("drum & co"));
    for (unsigned b = 0; b < 2; ++b) {
      auto* body = vtkMultiBlockDataSet::SafeDownCast(all->GetBlock(b));
      ASSERT_EQ(int(body->GetNumberOfBlocks()), n_pieces);
      EXPECT_EQ(body->GetNumberOfCells(), 4);
    }
  }
  EXPECT_NE(results_test::bytes(at / "paraview_view.py").find("import paraview.simple"), std::string::npos);
}
