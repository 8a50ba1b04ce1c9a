/// What every load history must be, whatever its machine.
#pragma once

#include <gtest/gtest.h>

#include "kinetics/values/load_history.h"

namespace machines {

/// Every series has the instants, finite values, and words that say what it is.
inline void expect_whole(const kinetics::LoadHistory& loads, Eigen::Index n_instants) {
  for (const auto& resultant : loads.resultants) {
    EXPECT_EQ(resultant.total.cols(), n_instants);
    EXPECT_TRUE(resultant.total.allFinite()) << resultant.role;
  }
  for (const auto& quantity : loads.quantities) {
    EXPECT_EQ(quantity.values.size(), n_instants) << quantity.name;
    EXPECT_TRUE(quantity.values.allFinite()) << quantity.name;
    EXPECT_FALSE(quantity.unit.empty() || quantity.description.empty()) << quantity.name;
  }
}

}  // namespace machines
