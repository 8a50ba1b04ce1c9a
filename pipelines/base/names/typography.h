/// Signs that plain ASCII lacks, for people: on pages, and on terminals that can show them.
#pragma once

#include <string>

namespace pipelines {

/// "1.0 +- 0.1 mm3" as "1.0 ± 0.1 mm³".
std::string typographic(std::string text);

/// Whether stdout is a terminal whose locale (LC_ALL, LC_CTYPE, LANG) is in UTF-8.
bool stdout_shows_utf8();

}  // namespace pipelines
