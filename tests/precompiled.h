/// Precompiled header of the tests: the heavy includes of their .cc files. The code builds without it too.
#pragma once

#include <gtest/gtest.h>

#if __has_include(<Eigen/Dense>)
#include <Eigen/Dense>
#endif
#if __has_include(<nlohmann/json.hpp>)
#include <nlohmann/json.hpp>
#endif
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>
