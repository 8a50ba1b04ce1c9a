// However work ends in a process of its own, the caller goes on and knows how it ended.
#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshes/imported/apart.h"
#include "meshes/imported/model_bytes.h"
#include "meshes/values/refused.h"

namespace {

using meshes::EndApart;
using meshes::run_apart;

TEST(WorkApart, HandsOverItsResultAndItsLog) {
  const std::string large(3'000'000, 'x');  // more than a pipe holds
  const auto end = run_apart(
      [&] {
        std::cout << "printed" << std::endl;
        return large + '\0' + "end";
      },
      5);
  EXPECT_EQ(end.kind, EndApart::Kind::finished);
  EXPECT_EQ(end.result, large + '\0' + "end");
  EXPECT_NE(end.log.find("printed"), std::string::npos);
}

TEST(WorkApart, SignalsAreTold) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS}) {
    const auto end = run_apart(
        [&]() -> std::string {
          std::raise(signal);
          return "";
        },
        5);
    EXPECT_EQ(end.kind, EndApart::Kind::crashed);
    EXPECT_EQ(end.signal, signal);
    EXPECT_EQ(end.result, "");
  }
}

TEST(WorkApart, WhatDoesNotEndIsEnded) {
  const auto end = run_apart(
      [] {
        volatile double sum = 0;
        for (;;) sum = sum + 1;
        return std::string();
      },
      0.1);
  EXPECT_EQ(end.kind, EndApart::Kind::too_slow);
}

TEST(WorkApart, WhatSleepsForEverIsEnded) {
  const auto end = run_apart(
      [] {
        for (;;) ::pause();
        return std::string();
      },
      0.01);
  EXPECT_EQ(end.kind, EndApart::Kind::too_slow);
}

// Where a search's time is up the clock on the wall counts, also where others take the cores.
TEST(WorkApart, AtADeadlineItIsEnded) {
  const auto sleep = [] {
    for (;;) ::pause();
    return std::string();
  };
  {
    const meshes::DeadlineApart deadline(0.2);
    EXPECT_EQ(run_apart(sleep, 1000).kind, EndApart::Kind::too_late);
    EXPECT_EQ(run_apart(sleep, 1000).kind, EndApart::Kind::too_late);  // it has passed
  }
  EXPECT_EQ(run_apart(sleep, 0.01).kind, EndApart::Kind::too_slow);
}

TEST(WorkApart, MemoryThatIsNotThereIsNotTaken) {
  const auto end = run_apart(
      [] {
        std::vector<std::string> kept;
        for (;;) kept.emplace_back(std::size_t(1) << 36, ' ');
        return std::string();
      },
      5);
  EXPECT_EQ(end.kind, EndApart::Kind::too_large);
}

TEST(WorkApart, RefusalsKeepTheirType) {
  using meshes::bytes_of;
  using meshes::model_from;
  const auto thrown = [](auto error) { return bytes_of([&]() -> meshes::ModelMesh { throw error; }); };
  try {
    model_from(thrown(meshes::TooManyCells("size_m", "too many")));
    ADD_FAILURE();
  } catch (const meshes::TooManyCells& error) {
    EXPECT_EQ(error.control(), "size_m");
    EXPECT_STREQ(error.what(), "too many");
  }
  EXPECT_THROW(model_from(thrown(meshes::MeshRefused("bad"))), meshes::MeshRefused);
  EXPECT_THROW(model_from(thrown(meshes::GeometryRefused("bad"))), meshes::GeometryRefused);
  EXPECT_THROW(model_from(thrown(std::string("gmsh's"))), meshes::GeometryRefused);
  EXPECT_THROW(model_from(thrown(std::out_of_range("at"))), meshes::GeometryRefused);
  EXPECT_THROW(model_from(thrown(7)), meshes::GeometryRefused);
}

TEST(WorkApart, AMeshThatDoesNotFitTogetherIsRefused) {
  meshes::ModelMesh model;
  model.mesh.kind = meshes::CellKind::hexahedra;
  model.mesh.points.resize(8);
  model.mesh.cells = {0, 1, 2, 3, 4, 5, 6, 7};
  model.mesh.volume_id = {0};
  model.volumes.push_back({"", 1});
  const auto bytes = meshes::bytes_of([&] { return model; });
  EXPECT_EQ(meshes::model_from(bytes).mesh.cells, model.mesh.cells);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(meshes::model_from(bytes.substr(0, n)), meshes::MeshRefused) << n;
  for (const int wrong : {-1, 8}) {
    model.mesh.cells[3] = wrong;
    EXPECT_THROW(meshes::model_from(meshes::bytes_of([&] { return model; })), meshes::MeshRefused);
  }
}

}  // namespace
