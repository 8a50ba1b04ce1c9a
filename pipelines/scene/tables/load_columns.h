/// Which column of a table of samples is which load: by the scene's `columns`, or by the titles.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pipelines/scene/tables/table_file.h"
#include "pipelines/scene/whole/scene_table.h"

namespace pipelines {

/// One entry of `columns`.
struct WantedColumn {
  std::string key;    ///< "time", "angle" or a load
  std::string title;  ///< as the scene writes it
  SceneTable table;   ///< where it stands, under `name`
  std::string name;
};

/// One entry of [[machine.files]].
struct LoadFileKeys {
  std::string effect, file, turns;
  TableForm form;
  std::vector<WantedColumn> columns;
  bool has_columns = false;
};

/// A column that is read.
struct ChosenColumn {
  std::size_t index = 0;
  std::string key;  ///< "time", "angle" or a load
  std::string unit;
};

/// Reads the entry and closes it.
LoadFileKeys read_load_file_keys(SceneTable& entry);

/// The column of time or angle first; empty where something was refused.
/// @param findings  get a warning of each column that has no unit
std::vector<ChosenColumn> columns_by_scene(SceneTable& entry, LoadFileKeys& keys, const OpenTable& table,
                                           SceneFindings& findings);

/// Chooses all columns, each under its own title.
std::vector<ChosenColumn> columns_by_title(const OpenTable& table);

}  // namespace pipelines
