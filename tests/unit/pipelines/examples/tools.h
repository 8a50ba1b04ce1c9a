/// Programs beside ours that a test needs, and that not every release of Debian has.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace results_test {

inline bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) == 0;
}

}  // namespace results_test

/// ctest lists the test as skipped then.
#define SKIP_WITHOUT(program) \
  if (!results_test::has_program(program)) GTEST_SKIP() << "skipped: " program " is not installed"
