/// Damage in the user's files that can be told with a line, before gmsh or OpenCASCADE trusts them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace meshes {

/// Largest geometry that is read: with one of this size gmsh takes minutes.
constexpr std::uintmax_t most_bytes_of_a_geometry = 2'000'000'000;

/// Refuses a STEP file (ISO 10303-21) that is cut off, defines an entity twice, or refers to an entity that
/// it does not have. Readers pass over such entities, or crash: either way the solid would be another.
/// @throws GeometryRefused "line 12: ..."
void check_step_text(const std::string& text);

/// Checks like check_step_text, and returns the text as OpenCASCADE reads it: without a mark of the order of
/// bytes, and without blanks and comments between ISO-10303-21, HEADER, DATA, ENDSEC, END-ISO-10303-21 and
/// their semicolons.
std::string step_text_to_read(std::string text);

/// Checks the scale of a STEP file that states its lengths in another unit than mm: the reader has converted
/// them to mm already.
/// @param text        the file's text, found whole by check_step_text
/// @param scale_to_m  length of a mm of the file, as asked for [m]
/// @throws GeometryRefused if it is no mm, since the part would be scaled once more
void check_step_unit(const std::string& text, double scale_to_m);

/// Checks a .msh of version 2.2 or 4.1 in text form: counts, numbers of nodes and elements, types, and that
/// coordinates are finite. Other versions and binary files are left to gmsh.
/// @throws GeometryRefused "line 12: ..."
void check_msh_text(const std::string& text);

/// Names of the groups of surfaces in a .msh in text form, used or not.
std::vector<std::string> surface_groups_named(const std::string& text);

}  // namespace meshes
