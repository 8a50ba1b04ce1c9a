/// What goes with a body that is taken out of a scene (--set shaft=removed).
#pragma once

#include <string>
#include <vector>

#include "pipelines/base/files/toml_tree.h"

namespace pipelines {

/// Whether a scene's table describes a body that its machine may have.
bool is_body_table(const TomlNode& root, const std::string& table);

/// Takes out what needs a body that the scene has no more: effects that are the body's own, in `effects` and
/// in the blocks of [[duty]], bearings that its ports load, and keys that [sweep] varies in it. What has to
/// take its place, as an inertia that its mesh gave, stays for the reader to refuse.
/// @param table  the body's name in the scene
/// @param body   the table that was removed
/// @return a sentence for each thing that went
std::vector<std::string> drop_what_needs(TomlNode& root, const std::string& table, const TomlNode& body);

}  // namespace pipelines
