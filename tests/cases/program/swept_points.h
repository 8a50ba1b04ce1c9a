/// What `millstress sweep` says of its points.
#pragma once

#include <string>

#include "tests/cases/program/program.h"

namespace cases {

/// A row's figures as sweep --json has them.
nlohmann::json points_of(const fs::path& directory, const std::string& arguments, std::string* err = nullptr);

double figure(const nlohmann::json& point, const std::string& name);

}  // namespace cases
