/// What a viewer finds in envelope.vtu and in the snapshots beside what is reported. Read back by VTK.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
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

/// What ParaView colours by and lists.
double largest(vtkUnstructuredGrid& grid, const std::string& field) {
  auto* array = grid.GetPointData()->GetArray(field.c_str());
  if (array == nullptr) throw std::out_of_range(field);
  return array->GetRange(-1)[1];
}

/// Component d of the unit displacement at z.
double moved_m(double z, int d) {
  return 1e-6 * (1 + z + 2 * d);
}

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
  }
};

void expect_the_headlines(vtkUnstructuredGrid& grid, const Case& c) {
  constexpr double rounding = 1e-7;  // single precision
  const double peak_Pa = c.analysis.peak.value_Pa, hot_spot_Pa = c.analysis.hot_spots[0].von_mises_Pa;
  EXPECT_NEAR(largest(grid, von_mises_field), peak_Pa, rounding * peak_Pa);
  EXPECT_NEAR(largest(grid, "largest principal stress, maximum [Pa]"), peak_Pa, rounding * peak_Pa);
  EXPECT_NEAR(largest(grid, hot_spot_field), hot_spot_Pa, rounding * hot_spot_Pa);
  EXPECT_GT(largest(grid, unconverged(von_mises_field)), 3 * peak_Pa) << "kept under a name that says so";
  auto* excluded = grid.GetPointData()->GetArray(excluded_field);
  for (const char* field : {von_mises_field, "safety against yield", "stress at maximum [Pa]", "effect share",
                            "drive angle of maximum [deg]"}) {
    auto* values = grid.GetPointData()->GetArray(field);
    ASSERT_NE(values, nullptr) << field;
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
      for (int k = 0; k < values->GetNumberOfComponents(); ++k)
        EXPECT_EQ(std::isnan(values->GetComponent(i, k)), excluded->GetComponent(i, 0) != 0) << field;
  }
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
  write_whole_envelope(at / "whole.vtu", c.scene, c.loads, c.analysis);
  EXPECT_EQ(results_test::bytes(at / "whole.vtu"), results_test::bytes(at / "envelope.vtu"));
}

TEST(EnvelopeFile, InPiecesToo) {
  const Directory at;
  const Case c;
  write_envelope_files(at.path, c.scene, c.loads, c.analysis, 2);
  expect_the_headlines(*read<vtkXMLPUnstructuredGridReader>(at / "envelope.pvtu"), c);
}

TEST(EnvelopeFile, ABodyWithoutSharpEdgesHasNothingToKeepApart) {
  const Directory at;
  Case c;
  std::fill(c.analysis.places.excluded.begin(), c.analysis.places.excluded.end(), 0);
  c.analysis.hot_spots.clear();
  write_envelope_files(at.path, c.scene, c.loads, c.analysis, 1);
  const auto grid = read<vtkXMLUnstructuredGridReader>(at / "envelope.vtu");
  EXPECT_EQ(grid->GetPointData()->GetArray(unconverged(von_mises_field).c_str()), nullptr);
  EXPECT_EQ(grid->GetPointData()->GetArray(hot_spot_field), nullptr);
  EXPECT_EQ(pictured_field(c.analysis), von_mises_field);
  auto* values = grid->GetPointData()->GetArray(von_mises_field);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    EXPECT_TRUE(std::isfinite(values->GetComponent(i, 0)));
}

TEST(EnvelopeFile, SnapshotsShowNoMoreThanThePeak) {
  const Directory at;
  const Case c;
  write_cycle_files(at.path, c.scene, c.loads, c.analysis);
  const double peak_Pa = c.analysis.peak.value_Pa;
  for (const auto& [file, factor] : {std::pair{"cycle_000.vtu", 0.5}, {"cycle_001.vtu", 1.0}}) {
    const auto grid = read<vtkXMLUnstructuredGridReader>(at / file);
    EXPECT_NEAR(largest(*grid, "von Mises stress [Pa]"), factor * peak_Pa, 1e-7 * peak_Pa);
    EXPECT_GT(largest(*grid, unconverged("von Mises stress [Pa]")), 3 * factor * peak_Pa);
    auto* moved = grid->GetPointData()->GetArray("displacement [m]");
    for (vtkIdType i = 0; i < moved->GetNumberOfTuples(); ++i)
      for (int d = 0; d < 3; ++d)
        EXPECT_EQ(moved->GetComponent(i, d), float(factor * moved_m(grid->GetPoint(i)[2], d)));
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
