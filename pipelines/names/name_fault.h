/// Names that files and tables cannot carry.
#pragma once

#include <string>

namespace pipelines {

/// Why a text cannot be written to the files of a run, with the remedy: a control character (HDF5 ends a name
/// at a NUL, a line break ends a row). Empty: it can.
std::string control_character_in(const std::string& text);

/// The same of a name: also where a spreadsheet would take it for a formula, which begins with = + - or @.
std::string name_fault(const std::string& name);

}  // namespace pipelines
