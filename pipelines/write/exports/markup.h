/// Text in XML and HTML.
#pragma once

#include <string>

namespace pipelines {

/// The text with & < > " ' as entities.
std::string escaped(const std::string& text);

}  // namespace pipelines
