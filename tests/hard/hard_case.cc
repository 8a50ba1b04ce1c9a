#include "tests/hard/hard_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace hard_cases {

void check(const HardCase& tried) {
  const std::string where = tried.family + ": " + tried.name;
  EXPECT_TRUE(tried.our_error <= tried.bound)
      << where << ": off by " << tried.our_error << ", bound " << tried.bound;
  if (tried.naive_error) {
    EXPECT_FALSE(*tried.naive_error <= tried.bound)
        << where << ": the naive way (" << tried.naive << ") is within the bound too, off by "
        << *tried.naive_error;
  }
  const char* file = std::getenv("MILLSTRESS_HARD_ROWS");
  if (file == nullptr) return;
  std::ofstream out(file, std::ios::app);
  out.precision(2);
  out << tried.family << '\t' << tried.name << '\t' << tried.what_is_hard << '\t'
      << (tried.naive.empty() ? "-" : tried.naive) << '\t';
  if (tried.naive_error)
    out << *tried.naive_error;
  else
    out << '-';
  out << '\t' << tried.our_error << '\t' << tried.bound << '\n';
}

double relative(long double ours, long double reference) {
  return double(std::abs(reference == 0 ? ours : ours / reference - 1));
}

}  // namespace hard_cases
