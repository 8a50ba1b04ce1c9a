// What a command throws becomes a message and an exit code: users' mistakes 2, meshes and solves 3, a missed
// tolerance 4. A type that means none of these is a mistake of the program and says so; it must never end as
// "the scene is wrong", whatever std type it has.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <sstream>

#include "fem/base/values/errors.h"
#include "kinetics/values/machine_refused.h"
#include "meshes/values/refused.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/failure.h"
#include "pipelines/base/common/refusal_of.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/study/accuracy/accuracy_report.h"
#include "pipelines/study/accuracy/cost_forecast.h"

namespace {

using namespace pipelines;

template <typename Exception>
Failure failure_of(const Exception& exception) {
  try {
    throw exception;
  } catch (...) {
    return failure_in_flight();
  }
}

bool is_internal(const Failure& failure) {
  return failure.message.find("internal error") != std::string::npos;
}

TEST(Failures, OfUsersNameTheirMistake) {
  const std::vector<Failure> failures{
      failure_of(SceneError({{"mill.toml", 3, 7, "machine.speed", "-1", "must be positive"}})),
      failure_of(OptionError("a cause")),
      failure_of(StageRefused("a cause")),
      failure_of(kinetics::MachineRefused("a cause")),
      failure_of(meshes::GeometryRefused("a cause")),
      failure_of(fem::TooManyModes("a cause")),
      failure_of(
          std::filesystem::filesystem_error("a cause", std::make_error_code(std::errc::permission_denied)))};
  for (const auto& failure : failures) {
    EXPECT_EQ(failure.code, scene_is_wrong) << failure.message;
    EXPECT_FALSE(is_internal(failure)) << failure.message;
  }
  EXPECT_EQ(failures.front().message, "mill.toml:3:7: machine.speed = -1: must be positive");
  EXPECT_EQ(failures[1].message, "millstress: a cause");
}

TEST(Failures, OfMeshesAndSolvesAreNoMistakeOfTheScene) {
  for (const auto& failure :
       {failure_of(meshes::MeshRefused("a cause")), failure_of(fem::MeshUnusable("a cause")),
        failure_of(fem::SolveFailed("a cause")), failure_of(fem::DoesNotFit("a cause")),
        failure_of(kinetics::LoadsFailed("a cause")), failure_of(NotFinite("a cause")),
        failure_of(FileError("a cause"))}) {
    EXPECT_EQ(failure.code, mesh_or_solve_failed);
    EXPECT_EQ(failure.message, "millstress: a cause");
  }
  EXPECT_EQ(failure_of(ToleranceNotMet("a cause")).code, tolerance_not_met);
  const auto memory = failure_of(std::bad_alloc());
  EXPECT_EQ(memory.code, mesh_or_solve_failed);
  EXPECT_NE(memory.message.find("more memory was asked for"), std::string::npos) << memory.message;
}

TEST(Failures, OfADiskAreNoMistakeOfTheScene) {
  const auto full = std::make_error_code(std::errc::no_space_on_device);
  const auto failure = failure_of(std::filesystem::filesystem_error("a cause", "out/loads.csv", full));
  EXPECT_EQ(failure.code, mesh_or_solve_failed);
  EXPECT_EQ(failure.message,
            "millstress: No space left on device: out/loads.csv: check the free space, or "
            "choose another output with -o");
}

TEST(Failures, OfTheProgramAreNotBlamedOnTheScene) {
  for (const auto& failure :
       {failure_of(std::invalid_argument("sizes differ")), failure_of(std::out_of_range("no such quantity")),
        failure_of(std::logic_error("unknown role")), failure_of(std::runtime_error("a cause")),
        failure_of(42)}) {
    EXPECT_EQ(failure.code, mesh_or_solve_failed) << failure.message;
    EXPECT_TRUE(is_internal(failure)) << failure.message;
  }
}

// A model that is left out is one that was refused by name; anything else passes through.
TEST(Failures, OnlyRefusalsAreAnswers) {
  EXPECT_EQ(refusal_of([] {}), "");
  EXPECT_EQ(refusal_of([] { throw meshes::MeshRefused("flat cells"); }), "flat cells");
  EXPECT_EQ(refusal_of([] { throw fem::DoesNotFit("too large"); }), "too large");
  EXPECT_EQ(refusal_of([] { throw fem::SolveFailed("singular"); }), "singular");
  EXPECT_THROW(refusal_of([] { throw std::runtime_error("a mistake"); }), std::runtime_error);
  EXPECT_THROW(refusal_of([] { throw std::out_of_range("a mistake"); }), std::out_of_range);
}

// The mesh that a search begins with is refused: the forecast says why instead of leaving the row out.
TEST(Failures, TheForecastSaysWhyAMeshIsLeftOut) {
  auto scene = read_scene(std::string(SOURCE_DIR) + "/pipelines/scenes/load_table.toml");
  auto& body = scene.bodies.front();
  const auto meshed = mesh_body(body, {});
  std::get<ShaftShape>(body.shape).mesh.min_scaled_jacobian = 0.95;
  const auto rows = forecast_ladder(body, meshed, {10, 100});
  ASSERT_EQ(rows.back().model, "first of a search");
  EXPECT_NE(rows.back().left_out.find("scaled Jacobian"), std::string::npos) << rows.back().left_out;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) EXPECT_EQ(rows[i].left_out, "") << rows[i].model;
}

// Harmonics and a beam have no price where a run refuses them.
TEST(Failures, TheForecastHasNoModelThatARunRefuses) {
  auto scene = read_scene(std::string(SOURCE_DIR) + "/pipelines/scenes/load_table.toml");
  auto& body = scene.bodies.front();
  const auto meshed = mesh_body(body, {});
  const auto n_cheap = [&] {
    const auto rows = forecast_ladder(body, meshed, {10, 100});
    return std::count_if(rows.begin(), rows.end(),
                         [](const auto& row) { return row.model == "beam" || row.model == "axisymmetric"; });
  };
  EXPECT_EQ(n_cheap(), 2);
  body.natural_frequencies = 1;
  EXPECT_EQ(n_cheap(), 0);
}

// So does the table of `accuracy`.
TEST(Failures, AccuracySaysWhyAModelIsLeftOut) {
  AccuracyStudy study;
  study.rows.resize(1);
  study.left_out.push_back({"even mesh, cells 1/3", "it does not fit into memory"});
  std::ostringstream table;
  print_accuracy(table, study);
  EXPECT_NE(table.str().find("left out: it does not fit into memory"), std::string::npos) << table.str();
}

}  // namespace
