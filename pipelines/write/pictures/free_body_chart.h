/// The free body of a vibratory mill's chamber as a picture.
#pragma once

#include <filesystem>

#include "kinetics/free_body.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Draws the chamber and its forces at an instant, to one scale for all instants, as NAME.png and NAME.svg.
/// The origin is the chamber's centre at rest.
/// @param file  without its extension
/// @return false if the machine offers no EGL
/// @throws FileError naming the file if it cannot be written
bool draw_free_body(const Scene& scene, const kinetics::FreeBody& body, Eigen::Index instant,
                    const std::filesystem::path& file);

}  // namespace pipelines
