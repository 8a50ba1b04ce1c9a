/// Limits that the process was started with, at which libraries would end it without a reason.
#pragma once

#include <string>

namespace pipelines {

/// Lets the stack grow as it usually may (8 MB), on threads to come too, where the hard limit allows it.
/// To be called before other threads are started.
/// @throws OptionError naming limit, value and remedy: less than 1 MB of stack, in which drawing ends by a
///   signal
void require_usable_stack();

/// Whether memory of this process is limited. Then a thread of OpenBLAS that got none asks for it until it
/// does, and a process that ends in the usual way waits for that thread.
bool memory_is_limited();

/// Whether a limited process may still have what a picture takes: the compiler of its shaders aborts without.
bool has_memory_to_draw();

/// Why there is no picture on this machine, or of this process.
std::string why_nothing_draws();

}  // namespace pipelines
