/// Values that the command line gives to keys of a scene (--set).
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pipelines/base/files/toml_tree.h"

namespace pipelines {

/// Sets keys: each setting is "KEY=VALUE". A key is dotted, items of arrays counted from 1, as messages name
/// it: "machine.springs[2].stiffness". A value is TOML, or else a text: machine.drive.speed=1500 rpm. Tables
/// on the way are added where they are missing; whether the scene may have the key is for its reader to say.
/// What is set has no place in the file: 0:0.
///
/// The word removed, without quotes, takes the key or the item away, after all that is set:
/// machine.springs[2]=removed. effects.NAME=on or off switches one effect of the scene's list. With a body
/// (shaft=removed) goes what needs it (removed_body.h).
/// @return a sentence for each thing that went with a body
/// @throws SceneError where a setting is no such text, leads into no table or beyond an array's end, or sets
///   a key again;
///   where what is removed or switched off is not there
std::vector<std::string> set_keys(TomlNode& root, const std::vector<std::string>& settings,
                                  const std::filesystem::path& file);

/// Values that a table of the scene gives to other keys of it ([[duty]]): each entry by its key, which may
/// lead through tables (set.machine.drive.speed) or be quoted as for set_keys
/// ("machine.springs[2].stiffness"). Values keep their place in the file. The texts "removed", and "on" or
/// "off" of an effect, mean what they mean there.
/// @param key  key of the table, for errors: "duty[2].set"
/// @throws SceneError as set_keys, at the value's place
void set_entries(TomlNode& root, const TomlNode& table, const std::string& key,
                 const std::filesystem::path& file);

using ValueListener = std::function<void(const std::string& key, const TomlNode& value)>;

/// Every value of a scene with its key as messages name it, in the order of the file. An array of plain
/// values is one value.
/// @param key  of the node; the root has none
void for_each_value(const TomlNode& node, const ValueListener& listener, const std::string& key = "");

/// Every value of a scene as a text, by its key as messages name it. Arrays of plain values are one text.
std::map<std::string, std::string> texts_by_key(const TomlNode& root);

}  // namespace pipelines
