#include <gtest/gtest.h>

#include "fem/base/common/blas_kernels.h"
#include "fem/base/common/parallel.h"
#include "fem/models/solid/model.h"

int main(int argc, char** argv) {
  fem::restart_with_wide_blas(argv);
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();  // listing needs no MPI
  const fem::Environment environment(0);
  const fem::SerialBlas
      serial;  // its threads wait by yielding: beside a second test that costs ten times the seconds
  return RUN_ALL_TESTS();
}
