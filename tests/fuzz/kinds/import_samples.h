/// A part as STEP file and as meshes of two versions of the format.
#pragma once

#include <filesystem>

namespace fuzz {

/// A block of 30 x 30 x 20 mm with a hole of 10 along z in its middle, in millimetres: sound.step,
/// sound_41.msh and sound_22.msh. Starts and ends gmsh.
void write_import_samples(const std::filesystem::path& directory);

}  // namespace fuzz
