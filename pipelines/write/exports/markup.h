/// Text in XML and HTML.
#pragma once

#include <string>

namespace pipelines {

/// With & < > " ' as entities.
std::string escaped(const std::string& text);

}  // namespace pipelines
