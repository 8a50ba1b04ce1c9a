#include "tests/cases/program/swept_points.h"

namespace cases {

nlohmann::json points_of(const fs::path& directory, const std::string& arguments, std::string* err) {
  const auto outcome = as_a_user(directory, "sweep " + arguments + " --json --threads 2");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  if (err != nullptr) *err = outcome.err;
  return nlohmann::json::parse(outcome.out)["points"];
}

double figure(const nlohmann::json& point, const std::string& name) {
  return point.at("figures").at(name).at("value");
}

}  // namespace cases
