#include <gtest/gtest.h>

#include "fem/model/model.h"
#include "fem/ranks/helper_ranks.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const fem::Environment environment(1);
  if (fem::this_rank(MPI_COMM_WORLD) != 0) return fem::help_first_rank();
  const int result = RUN_ALL_TESTS();
  fem::dismiss_helpers(result);
  return result;
}
