/// A JSON schema of scenes, from what the reader has asked for in some of them: editors complete keys by it,
/// and mark what is misspelt or of the wrong kind.
#pragma once

#include <string>
#include <vector>

#include "pipelines/scene/whole/key_form.h"

namespace pipelines {

/// A key may be what it is in any of the scenes. Which keys have to be there, and how they go together, is
/// left to the reader.
/// @param scenes  Scene::key_forms of scenes that have each table at least once
/// @return JSON, of draft 7
std::string scene_schema(const std::vector<KeyForms>& scenes);

}  // namespace pipelines
