#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "pipelines/respond/responses/response_files.h"
#include "tests/unit/pipelines/examples/example_responses.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;
using results_test::example_responses;

namespace {

template <class Element>
bool same_bits(const std::vector<Element>& a, const std::vector<Element>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Element)) == 0;
}

TEST(ResponseFiles, ComeBackBitForBit) {
  const Directory at;
  const auto written = example_responses();
  write_unit_responses(at / "unit_responses.h5", "key 1", written);
  const auto read = read_unit_responses(at / "unit_responses.h5", "key 1");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->channels, written.channels);
  EXPECT_EQ(read->nodes.n, written.nodes.n);
  EXPECT_TRUE(same_bits(read->nodes.xyz_m, written.nodes.xyz_m));
  EXPECT_TRUE(same_bits(read->nodes.volume_m3, written.nodes.volume_m3));
  EXPECT_EQ(read->nodes.cells, written.nodes.cells);
  EXPECT_EQ(read->nodes.faces, written.nodes.faces);
  EXPECT_EQ(read->nodes.face_boundary_id, written.nodes.face_boundary_id);
  EXPECT_TRUE(same_bits(read->displacement_m, written.displacement_m));
  EXPECT_TRUE(same_bits(read->stress_Pa, written.stress_Pa));
  EXPECT_TRUE(same_bits(read->resultants, written.resultants));
  EXPECT_TRUE(same_bits(read->planes, written.planes));
  EXPECT_TRUE(same_bits(read->plane_area_m2, written.plane_area_m2));
  EXPECT_TRUE(same_bits(read->sections, written.sections));
  ASSERT_EQ(read->rings.size(), written.rings.size());
  for (std::size_t i = 0; i < read->rings.size(); ++i) {
    EXPECT_EQ(read->rings[i].z_m, written.rings[i].z_m);
    EXPECT_EQ(read->rings[i].radius_m, written.rings[i].radius_m);
    EXPECT_EQ(read->rings[i].boundary_id, written.rings[i].boundary_id);
  }
  EXPECT_TRUE(same_bits(read->ring_shear_Pa, written.ring_shear_Pa));
  EXPECT_EQ(read->nodes.cell_volume_id, written.nodes.cell_volume_id);
  EXPECT_TRUE(same_bits(read->energy_error.norm_sqrtJ, written.energy_error.norm_sqrtJ));
  EXPECT_TRUE(same_bits(read->energy_error.energy, written.energy_error.energy));
  EXPECT_TRUE(same_bits(read->energy_error.error, written.energy_error.error));
  EXPECT_TRUE(same_bits(read->energy_error.of_cells, written.energy_error.of_cells));
  ASSERT_FALSE(written.images.node.empty());
  EXPECT_EQ(read->images.node, written.images.node);
  EXPECT_EQ(read->images.cell, written.images.cell);
  EXPECT_EQ(read->support_reaction, written.support_reaction);
  EXPECT_EQ(read->residual, written.residual);
  EXPECT_EQ(read->n_dofs, written.n_dofs);
  EXPECT_EQ(read->factor_gigabytes, written.factor_gigabytes);
  EXPECT_EQ(read->solver.reason, written.solver.reason);
  EXPECT_EQ(read->solver.used_bytes, written.solver.used_bytes);
  EXPECT_EQ(read->solver.predicted().bytes, written.solver.predicted().bytes);
}

TEST(ResponseFiles, TwoWritesGiveTheSameBytes) {
  const Directory at;
  write_unit_responses(at / "a.h5", "key", example_responses());
  write_unit_responses(at / "b.h5", "key", example_responses());
  EXPECT_EQ(bytes(at / "a.h5"), bytes(at / "b.h5"));
}

TEST(ResponseFiles, EveryDegreeComesBack) {
  const Directory at;
  for (const int degree : {1, 2, 3}) {
    fem::UnitResponses written;
    written.channels = {"seat.fx"};
    written.resultants.resize(1);
    written.nodes.degree = degree;
    const auto n = std::int32_t(written.nodes.nodes_per_cell());
    for (std::int32_t i = 0; i < n; ++i) written.nodes.cells.push_back(n - 1 - i);
    for (std::int32_t i = 0; i < std::int32_t(written.nodes.nodes_per_face()); ++i)
      written.nodes.faces.push_back(i);
    written.nodes.face_boundary_id = {7};
    write_unit_responses(at / "r.h5", "key", written);
    const auto read = read_unit_responses(at / "r.h5", "key");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->nodes.degree, degree);
    EXPECT_EQ(read->nodes.n_cells(), 1u);
    EXPECT_EQ(read->nodes.n_faces(), 1u);
    EXPECT_EQ(read->nodes.cells, written.nodes.cells);
    EXPECT_EQ(read->nodes.faces, written.nodes.faces);
  }
}

TEST(ResponseFiles, AnAxisymmetricOrEmptyBodyComesBack) {
  const Directory at;
  fem::UnitResponses written;
  written.channels = {"seat.fx"};
  written.resultants.resize(1);
  write_unit_responses(at / "r.h5", "key", written);
  const auto read = read_unit_responses(at / "r.h5", "key");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->channels, written.channels);
  EXPECT_TRUE(read->nodes.cells.empty());
}

TEST(ResponseFiles, WhatDoesNotFitCountsAsMissing) {
  const Directory at;
  EXPECT_FALSE(read_unit_responses(at / "none.h5", "key"));
  EXPECT_FALSE(read_unit_responses(at.path, "key"));
  write_unit_responses(at / "r.h5", "key", example_responses());
  EXPECT_TRUE(read_unit_responses(at / "r.h5", "key"));
  EXPECT_FALSE(read_unit_responses(at / "r.h5", "key 2"));
  const std::string whole = bytes(at / "r.h5");
  testing::internal::CaptureStderr();
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(at / "cut.h5", std::ios::binary) << whole.substr(0, size);
    EXPECT_FALSE(read_unit_responses(at / "cut.h5", "key")) << size;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// 200 changes at places drawn once, by one bit, by a byte, or by a block: nothing of the file is believed,
// and all but changes of the key's own hash are told in one line. The library never sees such a file: on
// damaged metadata it may crash.
TEST(ResponseFiles, ChangedBytesAreNeverBelieved) {
  const Directory at;
  write_unit_responses(at / "r.h5", "key", example_responses());
  const std::string whole = bytes(at / "r.h5");
  std::mt19937_64 random(11);
  const auto drawn = [&](std::size_t below) { return std::size_t(random() % below); };
  int n_told = 0;
  const auto tell = [&](const std::string& line) {
    ++n_told;
    EXPECT_EQ(line.rfind((at / "r.h5").string() + ": is damaged", 0), 0u) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  };
  for (int i = 0; i < 200; ++i) {
    auto changed = whole;
    const auto place = drawn(whole.size());
    if (i % 3 == 0) changed[place] = char(changed[place] ^ (1 << drawn(8)));
    if (i % 3 == 1) changed[place] = char(changed[place] + 1 + int(drawn(255)));
    if (i % 3 == 2) {
      const auto n = std::min<std::size_t>(1 + drawn(4096), whole.size() - place);
      const auto from = drawn(whole.size() - n + 1);
      if (whole.compare(place, n, whole, from, n) == 0) continue;
      changed.replace(place, n, whole, from, n);
    }
    std::ofstream(at / "r.h5", std::ios::binary) << changed;
    const int before = n_told;
    EXPECT_FALSE(read_unit_responses(at / "r.h5", "key", tell)) << i << " at " << place;
    EXPECT_LE(n_told, before + 1);
  }
  EXPECT_GT(n_told, 150);
  std::ofstream(at / "r.h5", std::ios::binary) << whole;
  EXPECT_TRUE(read_unit_responses(at / "r.h5", "key", tell));
}

TEST(ResponseFiles, SizesThatDoNotFitAreRefusedAndTheOldFileStays) {
  const Directory at;
  write_unit_responses(at / "r.h5", "key", example_responses());
  const std::string old = bytes(at / "r.h5");
  auto wrong = example_responses();
  wrong.stress_Pa.pop_back();
  try {
    write_unit_responses(at / "r.h5", "key", wrong);
    FAIL() << "was written";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("/stress"), std::string::npos);
  }
  EXPECT_EQ(bytes(at / "r.h5"), old);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(at.path), {}), 1);
}

}  // namespace
