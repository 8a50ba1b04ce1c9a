#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "pipelines/files/content_hash.h"
#include "pipelines/responses/iteration_memory.h"
#include "pipelines/responses/response_key.h"
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
  const results_test::Directory scratch;
  fem::Body body;
  body.mesh = scratch.path / "a.msh";
  std::ofstream(body.mesh) << "a mesh";
  body.material = {206e9, 0.3, 7850};
  const auto hash = pipelines::content_hash(body.mesh);
  const auto key = pipelines::body_key(body, hash);
  EXPECT_EQ(pipelines::response_key(body, hash, {}, {}, fem::Solver::direct, 2).rfind(key, 0), 0u);
  auto other = body;
  other.material.poisson_ratio = 0.4;
  EXPECT_NE(pipelines::body_key(other, hash), key);
  std::ofstream(body.mesh) << "another mesh";
  EXPECT_NE(pipelines::body_key(body, pipelines::content_hash(body.mesh)), key);
  EXPECT_THROW(pipelines::body_key(body, ""), std::logic_error);
}

}  // namespace
