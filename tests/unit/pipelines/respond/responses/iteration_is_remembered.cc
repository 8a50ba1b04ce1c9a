#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <utility>

#include "pipelines/respond/responses/iteration_memory.h"
#include "pipelines/respond/responses/response_key.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace {

TEST(IterationMemory, LastsForOneBodyUntilItIsTakenBack) {
  const results_test::Directory scratch;
  EXPECT_FALSE(pipelines::iteration_gave_up_before(scratch.path, "mesh 1\n"));
  pipelines::remember_iteration(scratch.path, "mesh 1\n", true);
  EXPECT_TRUE(pipelines::iteration_gave_up_before(scratch.path, "mesh 1\n"));
  EXPECT_FALSE(pipelines::iteration_gave_up_before(scratch.path, "mesh 2\n"));
  // One letter changed: it is told, and says no.
  auto text = results_test::bytes(scratch / "iteration_gave_up.txt");
  text[2] = 'S';
  std::ofstream(scratch / "iteration_gave_up.txt") << text;
  std::string told;
  EXPECT_FALSE(pipelines::iteration_gave_up_before(scratch.path, "mesh 1\n",
                                                   [&](const std::string& line) { told += line; }));
  EXPECT_NE(told.find("iteration_gave_up.txt: is damaged"), std::string::npos);
  pipelines::remember_iteration(scratch.path, "mesh 1\n", false);
  EXPECT_FALSE(pipelines::iteration_gave_up_before(scratch.path, "mesh 1\n"));
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path));
}

TEST(IterationMemory, KeyIsThatOfMeshAndMaterialAndBeginsTheResponsesKey) {
  fem::CoarseMesh mesh;
  mesh.points_m = {{0, 0, 0}, {1, 0, 0}};
  mesh.cells = {0, 1, 0, 1, 0, 1, 0, 1};
  mesh.volume_id = {3};
  fem::Body body;
  body.mesh = std::make_shared<const fem::CoarseMesh>(mesh);
  body.material = {206e9, 0.3, 7850};
  const auto key = pipelines::body_key(body);
  EXPECT_EQ(pipelines::response_key(body, {}, {}, fem::Solver::direct, 2).rfind(key, 0), 0u);
  auto other = body;
  other.material.poisson_ratio = 0.4;
  EXPECT_NE(pipelines::body_key(other), key);
  // Every array counts, to the last bit.
  const auto key_with = [&](const std::function<void(fem::CoarseMesh&)>& change) {
    auto changed = mesh;
    change(changed);
    other = body;
    other.mesh = std::make_shared<const fem::CoarseMesh>(std::move(changed));
    return pipelines::body_key(other);
  };
  EXPECT_EQ(key_with([](auto&) {}), key);
  EXPECT_NE(key_with([](auto& m) { m.kind = fem::CellKind::tetrahedra; }), key);
  EXPECT_NE(key_with([](auto& m) { m.points_m[1][0] = std::nextafter(1.0, 2.0); }), key);
  EXPECT_NE(key_with([](auto& m) { std::swap(m.cells[2], m.cells[3]); }), key);
  EXPECT_NE(key_with([](auto& m) { m.volume_id = {4}; }), key);
  EXPECT_NE(key_with([](auto& m) { m.faces = {0, 1, 0, 1}; }), key);
  EXPECT_NE(key_with([](auto& m) { m.face_id = {1}; }), key);
  other.mesh.reset();
  EXPECT_THROW(pipelines::body_key(other), std::logic_error);
}

}  // namespace
