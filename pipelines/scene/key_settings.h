/// Values that the command line gives to keys of a scene (--set).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/files/toml_tree.h"

namespace pipelines {

/// Each setting is "KEY=VALUE". A key is dotted, items of arrays counted from 1, as messages name it:
/// "machine.springs[2].stiffness". A value is TOML, or else a text: machine.drive.speed=1500 rpm. Tables on
/// the way are added where they are missing; whether the scene may have the key is for its reader to say.
/// What is set has no place in the file: 0:0.
///
/// The word removed, without quotes, takes the key or the item away, after all that is set:
/// machine.springs[2]=removed. effects.NAME=on or off switches one effect of the scene's list.
/// @throws SceneError where a setting is no such text, leads into no table or beyond an array's end, or sets
///   a key again;
///   where what is removed or switched off is not there
void set_keys(TomlNode& root, const std::vector<std::string>& settings, const std::filesystem::path& file);

}  // namespace pipelines
