#include <gtest/gtest.h>

#include <functional>

#include "kinetics/values/load_history.h"
#include "kinetics/values/wrong_input.h"

namespace {

kinetics::LoadHistory history() {
  kinetics::LoadHistory h;
  h.machine = "mill";
  h.convention = "consistent";
  h.quantities = {{"T", "N m", "torque", Eigen::ArrayXd::Ones(3)}};
  h.resultants = {{"drive", "", Eigen::Array3Xd::Ones(3, 3), {}}};
  return h;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::out_of_range& error) {
    return error.what();
  }
  return "nothing thrown";
}

}  // namespace

TEST(LoadHistory, FindsByName) {
  EXPECT_EQ(history().quantity("T").unit, "N m");
  EXPECT_EQ(history().resultant("drive").total(2, 1), 1);
  EXPECT_TRUE(history().has_resultant("drive"));
  EXPECT_FALSE(history().has_resultant("inner_wall"));
}

TEST(LoadHistory, SaysWhatIsMissingAndWhatThereIs) {
  const auto quantity = message_of([] { history().quantity("R_E"); });
  EXPECT_NE(quantity.find("\"R_E\""), std::string::npos) << quantity;
  EXPECT_NE(quantity.find("it has: T"), std::string::npos) << quantity;
  const auto role = message_of([] { history().resultant("inner_wall"); });
  EXPECT_NE(role.find("\"inner_wall\""), std::string::npos) << role;
  EXPECT_NE(role.find("it has: drive"), std::string::npos) << role;
}

TEST(WrongInput, NearestWordTakesTheFewestChanges) {
  const std::vector<std::string> known{"springs", "spring_damping", "pitch", "charge_lag"};
  EXPECT_EQ(kinetics::nearest("sprigns", known), "springs");
  EXPECT_EQ(kinetics::nearest("Pitch", known), "pitch");
  EXPECT_EQ(kinetics::nearest("x", {}), "");
}
