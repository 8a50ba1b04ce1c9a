/// A picture of a body with its ports coloured and labelled. Needs no display.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "meshes/values/body_mesh.h"
#include "pipelines/write/pictures/port_body.h"

namespace pipelines {

/// A cut through the z direction and the axes of the bores that are furthest apart; if they all have one
/// axis, through it and y. Empty without bores.
std::optional<CutPlane> cut_through_bores(const std::vector<meshes::Port>& ports);

/// Draws the surface in light grey with every port in a colour of its own and its name beside it, from one
/// side or, if that does not show every port, from two; the second may show the body cut open.
/// @param vtu    file of write_port_surface
/// @param title  title of the picture
/// @param png    written whole or not at all
/// @return false if this machine cannot draw (no EGL): nothing is written
/// @throws FileError naming the file if the VTU cannot be read, has no ports, or the picture cannot
/// be written
bool write_port_picture(const std::filesystem::path& vtu, const std::string& title,
                        const std::filesystem::path& png, const std::optional<CutPlane>& cut = {});

}  // namespace pipelines
