/// All tables of fields, as pipelines/base/fields/README.md lists them.
#pragma once

#include <string>
#include <vector>

#include "pipelines/base/fields/field_outputs.h"

namespace fields_test {

struct Table {
  std::string title;  ///< CSV file and place in summary.json
  std::vector<pipelines::Field> fields;
};

std::vector<Table> all_tables();

}  // namespace fields_test
