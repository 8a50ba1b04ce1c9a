#include <gtest/gtest.h>

#include "fem/model/model.h"
#include "fem/ranks/ranks.h"

/// All ranks run the tests; those beside the first one tell of failures alone, on stderr.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const fem::Environment environment(1);
  if (fem::this_rank(MPI_COMM_WORLD) != 0) testing::GTEST_FLAG(brief) = true;
  int result = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return result;
}
