/// The library of materials as the command `materials` shows it.
#pragma once

#include <string>
#include <vector>

#include "pipelines/scene/materials/material_library.h"

namespace pipelines {

/// A table with a row for each range of thickness.
std::string materials_text(const std::vector<LibraryMaterial>& materials);

/// The same for machines, in SI units.
std::string materials_json(const std::vector<LibraryMaterial>& materials);

}  // namespace pipelines
