#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "pipelines/base/files/hdf5_file.h"
#include "pipelines/loads/channels/load_files.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::bytes;
using results_test::Directory;

namespace {

constexpr int n_rows = 5;

kinetics::LoadHistory example() {
  kinetics::LoadHistory loads;
  loads.machine = "vibratory_mill";
  loads.convention = "newton";
  loads.effects = {"gravity", "inertia"};
  loads.warnings = {"the pitch is large", "second"};
  loads.time_s = Eigen::ArrayXd::LinSpaced(n_rows, 0, 0.04);
  loads.phi_rad = loads.time_s * 157.1;
  loads.speed_rad_s = Eigen::ArrayXd::Constant(n_rows, 157.1);
  loads.acceleration_rad_s2 = loads.phi_rad.cos();
  loads.quantities = {{"theta", "rad", "angle of the bearing force, (12)", loads.phi_rad.sin()},
                      {"spring_1.fx", "N", "", loads.phi_rad * 3}};
  const Eigen::Array3Xd a = Eigen::Array3Xd::Random(3, n_rows), b = Eigen::Array3Xd::Random(3, n_rows);
  loads.resultants = {{"eccentric", "on the shaft", a + b, {{0, a}, {1, b}}},
                      {"debalance", "on the shaft", b, {{1, b}}}};
  return loads;
}

ChannelHistory example_channels() {
  ChannelHistory channels;
  channels.body = "shaft";
  channels.channels = {{"main_bearing_1.fx", "N"}, {"pulley.mz", "N m"}};
  channels.effects = {"gravity", "gravity_shaft"};
  channels.by_effect = {Eigen::ArrayXXd::Random(2, n_rows), Eigen::ArrayXXd::Random(2, n_rows)};
  channels.values = channels.by_effect[0] + channels.by_effect[1];
  return channels;
}

void expect_equal(const std::vector<double>& read, const Eigen::ArrayXd& written) {
  ASSERT_EQ(read.size(), static_cast<std::size_t>(written.size()));
  for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i], written(static_cast<Eigen::Index>(i)));
}

/// Shares of effects are floats of 32 bits, but where another series has the same values.
void expect_equal_singles(const std::vector<double>& read, const Eigen::ArrayXd& written) {
  ASSERT_EQ(read.size(), static_cast<std::size_t>(written.size()));
  for (std::size_t i = 0; i < read.size(); ++i) {
    const double value = written(static_cast<Eigen::Index>(i));
    EXPECT_TRUE(read[i] == value || read[i] == double(float(value))) << read[i] << " of " << value;
  }
}

TEST(LoadFiles, Hdf5HoldsEverySeriesWithItsUnit) {
  const Directory at;
  const auto loads = example();
  const auto channels = example_channels();
  write_loads_h5(at / "loads.h5", loads, {&channels});
  const Hdf5Reader in(at / "loads.h5");
  expect_equal(in.numbers("/time"), loads.time_s);
  expect_equal(in.numbers("/phi"), loads.phi_rad);
  expect_equal(in.numbers("/acceleration"), loads.acceleration_rad_s2);
  EXPECT_EQ(in.text_attribute("/speed", "unit"), "rad/s");
  EXPECT_EQ(in.names("/quantities"), (std::vector<std::string>{"theta", "spring_1.fx"}));
  EXPECT_EQ(in.text_attribute("/quantities/theta", "description"), "angle of the bearing force, (12)");
  expect_equal(in.numbers("/quantities/spring_1.fx"), loads.quantities[1].values);
  for (const auto& resultant : loads.resultants) {
    expect_equal(in.numbers("/resultants/" + resultant.role + "/fx"), resultant.total.row(0));
    expect_equal(in.numbers("/resultants/" + resultant.role + "/fy"), resultant.total.row(1));
    expect_equal(in.numbers("/resultants/" + resultant.role + "/torque"), resultant.total.row(2));
    for (const auto& part : resultant.contributions)
      expect_equal_singles(
          in.numbers("/effects/" + loads.effects[part.effect] + "/" + resultant.role + "/torque"),
          part.load.row(2));
  }
  EXPECT_EQ(in.text_attribute("/resultants/eccentric/torque", "unit"), "N m");
  EXPECT_EQ(in.text_attribute("/resultants/eccentric/fy", "unit"), "N");
  EXPECT_FALSE(in.has("/effects/gravity/debalance"));
  EXPECT_TRUE(in.has("/channels/shaft"));
  EXPECT_EQ(in.text_attribute("/channels/shaft/pulley.mz", "unit"), "N m");
  expect_equal(in.numbers("/channels/shaft/pulley.mz"), channels.values.row(1));
  const auto share = in.numbers("/effects/gravity_shaft/shaft/main_bearing_1.fx");
  expect_equal_singles(share, channels.by_effect[1].row(0));
  EXPECT_NE(share[1], channels.by_effect[1](0, 1)) << "all digits";
  EXPECT_EQ(in.texts("/effect_names"), loads.effects);
  EXPECT_EQ(in.texts("/warnings"), loads.warnings);
  EXPECT_EQ(in.text_attribute("/", "convention"), "newton");
}

// Two bodies may have ports, and effects, of the same name: each keeps its own.
TEST(LoadFiles, BodiesKeepTheirChannelsApart) {
  const Directory at;
  const auto loads = example();
  const auto shaft = example_channels();
  auto chamber = shaft;
  chamber.body = "chamber";
  chamber.values *= 2;
  for (auto& part : chamber.by_effect) part *= 2;
  write_loads_h5(at / "loads.h5", loads, {&shaft, &chamber});
  const Hdf5Reader in(at / "loads.h5");
  EXPECT_EQ(in.names("/channels"), (std::vector<std::string>{"shaft", "chamber"}));
  expect_equal(in.numbers("/channels/shaft/pulley.mz"), shaft.values.row(1));
  expect_equal(in.numbers("/channels/chamber/pulley.mz"), 2 * shaft.values.row(1));
  expect_equal_singles(in.numbers("/effects/gravity/chamber/pulley.mz"), 2 * shaft.by_effect[0].row(1));
}

// Turns red: infinite or lost shares, where 32 bits do not reach.
TEST(LoadFiles, SharesBeyondFloatsKeepAllDigits) {
  for (const double size : {1e45, 1e-45}) {
    const Directory at;
    auto channels = example_channels();
    for (auto& part : channels.by_effect) part *= size;
    write_loads_h5(at / "loads.h5", example(), {&channels});
    expect_equal(Hdf5Reader(at / "loads.h5").numbers("/effects/gravity/shaft/pulley.mz"),
                 channels.by_effect[0].row(1));
  }
}

TEST(LoadFiles, TheLoadStageAloneHasNoChannels) {
  const Directory at;
  write_loads_h5(at / "loads.h5", example());
  const Hdf5Reader in(at / "loads.h5");
  EXPECT_FALSE(in.has("/channels"));
  EXPECT_TRUE(in.has("/effects/inertia/debalance/fx"));
}

// Exact numbers, of angles fifteen digits of what people read.
TEST(LoadFiles, CsvHasARowPerInstantAndExactNumbers) {
  const Directory at;
  const auto loads = example();
  const auto channels = example_channels();
  write_loads_csv(at / "loads.csv", loads, {&channels});
  std::istringstream lines(bytes(at / "loads.csv"));
  std::string line, cell;
  std::getline(lines, line);
  std::vector<std::string> titles;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) titles.push_back(cell);
  const auto column = [&](const std::string& title) {
    return std::find(titles.begin(), titles.end(), title) - titles.begin();
  };
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    auto& row = rows.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      row.push_back(std::strtod(cell.c_str(), nullptr));
    ASSERT_EQ(row.size(), titles.size());
  }
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(n_rows));
  const std::vector<std::pair<std::string, Eigen::ArrayXd>> expected = {
      {"time [s]", loads.time_s},
      {"phi [deg]", loads.phi_rad * 180 / M_PI},
      {"theta [deg]", loads.quantities[0].values * 180 / M_PI},
      {"eccentric.torque [N m]", loads.resultants[0].total.row(2)},
      {"inertia/eccentric.fx [N]", loads.resultants[0].contributions[1].load.row(0)},
      {"shaft/pulley.mz [N m]", channels.values.row(1)},
      {"gravity_shaft/shaft/pulley.mz [N m]", channels.by_effect[1].row(1)}};
  for (const auto& [title, values] : expected) {
    const auto c = static_cast<std::size_t>(column(title));
    ASSERT_LT(c, titles.size()) << title;
    const double digits = title.find("[deg]") != std::string::npos ? 1e-14 : 0;
    for (int i = 0; i < n_rows; ++i)
      EXPECT_NEAR(rows[static_cast<std::size_t>(i)][c], values(i), digits * std::abs(values(i))) << title;
  }
}

TEST(LoadFiles, TwoWritesGiveTheSameBytes) {
  const Directory at;
  const auto loads = example();
  const auto channels = example_channels();
  for (const char* name : {"a", "b"}) {
    write_loads_h5(at / (name + std::string(".h5")), loads, {&channels});
    write_loads_csv(at / (name + std::string(".csv")), loads, {&channels});
  }
  EXPECT_EQ(bytes(at / "a.h5"), bytes(at / "b.h5"));
  EXPECT_EQ(bytes(at / "a.csv"), bytes(at / "b.csv"));
}

TEST(LoadFiles, RefusesWhatWouldMislead) {
  const Directory at;
  auto loads = example();
  auto channels = example_channels();
  channels.by_effect.pop_back();
  EXPECT_THROW(write_loads_h5(at / "loads.h5", loads, {&channels}), std::invalid_argument);
  channels = example_channels();
  channels.values.conservativeResize(2, n_rows - 1);
  EXPECT_THROW(write_loads_csv(at / "loads.csv", loads, {&channels}), std::invalid_argument);
  loads.quantities[0].name = "a/b";
  EXPECT_THROW(write_loads_h5(at / "loads.h5", loads), std::invalid_argument);
  loads = example();
  loads.quantities[0].values.conservativeResize(n_rows - 2);
  EXPECT_THROW(write_loads_h5(at / "loads.h5", loads), std::invalid_argument);
  EXPECT_TRUE(std::filesystem::is_empty(at.path));
}

}  // namespace
