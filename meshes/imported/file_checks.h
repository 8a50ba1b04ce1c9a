/// Damage in the user's files that can be told with a line, before gmsh or OpenCASCADE trusts them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace meshes {

/// Of a geometry that is read: of this size gmsh takes minutes.
constexpr std::uintmax_t most_bytes_of_a_geometry = 2'000'000'000;

/// Of a STEP file (ISO 10303-21): cut off, an entity that is defined twice, or that refers to one that the
/// file does not have. Readers pass over such entities, or crash: either way the solid would be another.
/// @throws GeometryRefused "line 12: ..."
void check_step_text(const std::string& text);

/// Of a STEP file that states its lengths in another unit than mm: reading has them in mm already.
/// @param text        of the file, whole by check_step_text
/// @param scale_to_m  length of a mm of the file, as asked for [m]
/// @throws GeometryRefused if it is no mm, since the part would be scaled once more
void check_step_unit(const std::string& text, double scale_to_m);

/// Of a .msh of version 2.2 or 4.1 in text form: counts, numbers of nodes and elements, types, and
/// coordinates that are finite. Other versions and binary files are left to gmsh.
/// @throws GeometryRefused "line 12: ..."
void check_msh_text(const std::string& text);

/// Names of the groups of surfaces in a .msh in text form, used or not.
std::vector<std::string> surface_groups_named(const std::string& text);

}  // namespace meshes
