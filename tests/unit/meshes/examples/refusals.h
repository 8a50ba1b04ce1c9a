/// Shafts that must be refused, and what the message must say.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "meshes/shaft_layout/shaft_geometry.h"

struct Refusal {
  std::string what;
  std::function<void(meshes::Shaft&, meshes::ShaftMeshControl&)> spoil;  ///< applied to the laboratory shaft
  std::vector<std::string> expected;                                     ///< all of them in the message
};

/// Each is refused with std::invalid_argument whose message has all the expected parts, and leaves no file.
void expect_refused(const std::vector<Refusal>& refusals);
