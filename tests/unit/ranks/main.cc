#include <gtest/gtest.h>

#include <iostream>

#include "fem/mesh/ranks/ranks.h"
#include "fem/models/solid/model.h"

namespace {

/// Of the ranks beside the first one: failures alone.
class Failures : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (result.failed())
      std::cerr << "rank " << fem::this_rank(MPI_COMM_WORLD) << ": " << result.file_name() << ":"
                << result.line_number() << ": " << result.message() << std::endl;
  }
};

}  // namespace

/// All ranks run the tests together.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const fem::Environment environment(1);
  if (fem::this_rank(MPI_COMM_WORLD) != 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Failures);  // which owns it
  }
  int result = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return result;
}
