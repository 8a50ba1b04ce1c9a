/// Style and script of every page, from the files beside this one.
#pragma once

#include <string>

namespace pipelines {

const std::string& page_style();
const std::string& page_script();

}  // namespace pipelines
