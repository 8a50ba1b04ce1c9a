// OpenBLAS takes the kernels for the vectors that the processor has, and they multiply.
#include <gtest/gtest.h>
#include <strings.h>

#include <Eigen/Core>
#include <cstdlib>
#include <limits>
#include <string>

#include "fem/base/common/blas_kernels.h"

extern "C" void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*,
                       const double*, const int*, const double*, const int*, const double*, double*,
                       const int*);

namespace {

/// By the names of OpenBLAS: whether kernels have vectors of four numbers and more.
bool are_wide(const std::string& kernels) {
  return kernels != "Prescott" && kernels != "Core2" && kernels != "Nehalem" && kernels != "Generic";
}

// The tests' main asks for them. OpenBLAS 0.3.21 takes "Prescott", vectors
// of two numbers, for processors that it does not know. tests/run installs OpenBLAS; a user's choice goes
// before, and a processor without wide vectors has none.
TEST(BlasKernels, AreThoseForTheProcessorsVectors) {
  const char* chosen = std::getenv("OPENBLAS_CORETYPE");
  const bool has_wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  ASSERT_NE(fem::blas_kernels(), "") << "OpenBLAS is not the BLAS in use: pipelines/setup installs it";
  if (chosen != nullptr)
    EXPECT_EQ(strcasecmp(fem::blas_kernels().c_str(), chosen), 0) << fem::blas_kernels();
  else
    EXPECT_TRUE(!has_wide || are_wide(fem::blas_kernels())) << fem::blas_kernels();
}

// Sums of n = 301 products in another order differ by rounding, n epsilon / 2 of the sum of sizes at most.
TEST(BlasKernels, MultiplyMatrices) {
  const int n = 301;
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n), b = Eigen::MatrixXd::Random(n, n);
  Eigen::MatrixXd c(n, n);
  const double one = 1, zero = 0;
  dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
  const Eigen::MatrixXd bound = a.cwiseAbs().lazyProduct(b.cwiseAbs());
  EXPECT_LT(((c - a.lazyProduct(b)).array().abs() / bound.array()).maxCoeff(),
            n * std::numeric_limits<double>::epsilon());
}

}  // namespace
