// The chamber's free body as files: what VTK reads back is what acts, at its place in that instant.
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipelines/base/common/errors.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/write/exports/vtk_arrows.h"
#include "pipelines/write/machines/free_body_report.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;

namespace {

Scene shipped_scene(const std::string& name, const std::vector<std::string>& settings = {}) {
  return read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes" / name, settings);
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

}  // namespace

TEST(FreeBodyFiles, SnapshotsHoldTheLoadsAtTheirPlaces) {
  const Directory directory;
  const auto scene = shipped_scene("vibratory_mill.toml", {"sampling.instants_per_turn=8"});
  const auto body = free_body(scene);
  ASSERT_EQ(body.time_s.size(), 8);
  write_free_body(directory.path, scene, body);
  const double ecc_m = scene.vibratory_mill().eccentricity_m;
  for (const int i : {0, 3, 7}) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((directory / ("free_body_00" + std::to_string(i) + ".vtp")).c_str());
    reader->Update();
    auto* data = reader->GetOutput();
    auto* force = data->GetPointData()->GetArray("force [N]");
    auto* number = data->GetPointData()->GetArray("number");
    auto* names = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("names"));
    ASSERT_TRUE(force != nullptr && number != nullptr && names != nullptr);
    ASSERT_EQ(std::size_t(data->GetNumberOfVerts()), body.loads.size());
    ASSERT_EQ(std::size_t(names->GetNumberOfValues()), body.loads.size());
    for (std::size_t k = 0; k < body.loads.size(); ++k) {
      const auto& load = body.loads[k];
      EXPECT_EQ(names->GetValue(vtkIdType(k)), load.name);
      EXPECT_EQ(number->GetComponent(vtkIdType(k), 0), k + 1);
      const double* at_m = data->GetPoint(vtkIdType(k));
      // From the shaft's axis: the pivot has turned clockwise by phi.
      EXPECT_NEAR(at_m[0], ecc_m * std::cos(body.phi_rad[i]) + load.at_m(0, i), 1e-14);
      EXPECT_NEAR(at_m[1], -ecc_m * std::sin(body.phi_rad[i]) + load.at_m(1, i), 1e-14);
      EXPECT_EQ(force->GetComponent(vtkIdType(k), 0), load.force_N(0, i));
      EXPECT_EQ(force->GetComponent(vtkIdType(k), 1), load.force_N(1, i));
      EXPECT_EQ(force->GetComponent(vtkIdType(k), 2), 0);
    }
    for (vtkIdType p = vtkIdType(body.loads.size()); p < data->GetNumberOfPoints(); ++p)
      EXPECT_EQ(number->GetComponent(p, 0), 0);
    // Last the wall: a closed circle about the chamber's centre.
    const auto radius_m = chamber_radius_m(scene);
    ASSERT_TRUE(radius_m.has_value());
    auto* circle = data->GetCell(data->GetNumberOfCells() - 1);
    const Eigen::Vector2d centre = body.pivot_m.col(i).matrix() + scene.vibratory_mill().chamber_centre_m;
    for (vtkIdType p = 0; p < circle->GetNumberOfPoints(); ++p) {
      double at_m[3];
      data->GetPoint(circle->GetPointId(p), at_m);
      EXPECT_NEAR(std::hypot(at_m[0] - centre.x(), at_m[1] - centre.y()), *radius_m, 1e-14);
    }
  }
  const auto series = bytes(directory / "free_body.pvd");
  EXPECT_EQ(count_of(series, "<DataSet"), 8u);
  EXPECT_EQ(count_of(bytes(directory / "free_body.csv"), "\n"), 1 + 8 * body.loads.size());
}

TEST(FreeBodyReport, TakesTheInstantNearestToTheAngle) {
  const auto scene = shipped_scene("vibratory_mill.toml", {"sampling.instants_per_turn=36"});
  const auto body = free_body(scene);
  const double degree = M_PI / 180;
  EXPECT_NEAR(body.phi_rad[instant_at(body, 44 * degree)], 40 * degree, 1e-12);
  EXPECT_NEAR(body.phi_rad[instant_at(body, 46 * degree)], 50 * degree, 1e-12);
  EXPECT_EQ(instant_at(body, -4 * degree), 0);
  EXPECT_EQ(instant_at(body, 724 * degree), 0);
  EXPECT_NEAR(body.phi_rad[instant_at(body, -46 * degree)], 310 * degree, 1e-12);
  std::ostringstream out;
  print_free_body(out, scene, body, instant_at(body, 50 * degree), true);
  const auto json = nlohmann::json::parse(out.str());
  double fx = 0, fy = 0, moment = 0;
  for (const auto& load : json["loads"]) {
    fx += load["force_N"][0].get<double>();
    fy += load["force_N"][1].get<double>();
    moment += load["moment_N_m"].get<double>();
  }
  // Forces of some kN, moments of some kN m.
  EXPECT_NEAR(fx, 0, 1e-8);
  EXPECT_NEAR(fy, 0, 1e-8);
  EXPECT_NEAR(moment, 0, 1e-8);
  EXPECT_LT(json["closure"]["force"].get<double>(), 1e-12);
  EXPECT_LT(json["closure"]["moment"].get<double>(), 1e-12);
}

TEST(FreeBodyReport, OtherMachinesAreRefused) {
  EXPECT_THROW(free_body(shipped_scene("planetary_mill.toml")), StageRefused);
  EXPECT_THROW(free_body(shipped_scene("drive_train.toml")), StageRefused);
}
