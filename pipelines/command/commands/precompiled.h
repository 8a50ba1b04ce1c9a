/// Private precompiled header of the program: CLI11 costs 3 s. The code builds without it too.
#pragma once

#include <CLI/CLI.hpp>
