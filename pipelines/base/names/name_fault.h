/// Names that files and tables cannot carry.
#pragma once

#include <string>

namespace pipelines {

/// Why a text cannot be written to the files of a run, with the remedy: a control character (HDF5 ends a name
/// at a NUL, a line break ends a row, others turn a terminal's text around), or no character at all (U+FFFF,
/// which XML refuses). Empty: it can.
/// @param text  UTF-8
std::string control_character_in(const std::string& text);

/// The same of a text that may head a column or a row: also where a spreadsheet would take it for a formula,
/// which begins with = + - or @.
std::string cell_fault(const std::string& text);

/// The same of the name of an effect, a port or another thing of a scene, which becomes a path in HDF5 files,
/// a group of a mesh and a part of longer names: also ".", "..", a name with "/" or a quotation mark, and one
/// of more than 100 characters.
std::string name_fault(const std::string& name);

}  // namespace pipelines
