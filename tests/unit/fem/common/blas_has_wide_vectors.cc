// OpenBLAS takes the kernels for the vectors that the processor has, and they multiply.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>

#include "fem/common/blas_kernels.h"

extern "C" void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*,
                       const double*, const int*, const double*, const int*, const double*, double*,
                       const int*);

namespace {

// The environment of the tests (examples/main.cc) has mended them. OpenBLAS 0.3.21 takes "Prescott", vectors
// of two numbers, for processors that it does not know.
TEST(BlasKernels, AreThoseForTheProcessorsVectors) {
  if (fem::blas_kernels().empty()) GTEST_SKIP() << "no OpenBLAS";
  if (std::getenv("OPENBLAS_CORETYPE") != nullptr) GTEST_SKIP() << "the user has chosen";
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP() << "no wide vectors";
  EXPECT_NE(fem::blas_kernels(), "Prescott");
}

// Sums of n = 301 products in another order differ by rounding, n epsilon / 2 of the sum of sizes at most.
TEST(BlasKernels, MultiplyMatrices) {
  fem::mend_blas_kernels();
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
