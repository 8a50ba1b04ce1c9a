/// Bodies that are their own mirror image, solved whole and by halves.
#pragma once

#include <filesystem>

namespace measure {

/// The default chamber on meshes of `tolerance = "none"` and of twice as large cells, under its seats' fx and
/// fy, which are mirrored, and with one load more that is not. Prints a table.
/// @param scene_file  of the shipped vibratory mill
void compare_halves(const std::filesystem::path& scene_file);

}  // namespace measure
