/// Values of summary.json as report.html shows them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pipelines::html {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

/// JSON has no infinities: they are null or text there. "-" for what is no number and no text.
/// @param format  format of fmt
std::string number(const Json& value, double factor = 1, const char* format = "{:.4g}");

/// A stress given in Pa.
std::string MPa(const Json& pascals);

}  // namespace pipelines::html
