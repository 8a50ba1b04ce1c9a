/// How much memory there is, and how much of it is left.
#pragma once

#include <cstddef>

namespace fem {

/// The smaller of this process' own limits (ulimit -v, ulimit -d) [bytes]; infinite without any.
double limit_of_process();

/// Whether this process could have so many bytes more in one piece: its limits included.
bool has_room_for(std::size_t bytes);

/// What this process may have [bytes]: that of the machine, or less by its own limits (ulimit -v, ulimit -d)
/// or by those of the control groups (version 2) that it is in.
double physical_memory();

/// What is left of it for this process [bytes], without what it keeps for later itself: files that the system
/// keeps in mind give way. All of it where the system does not tell.
double free_memory();

/// Gives free memory back to the system if otherwise so much would not be left.
void make_room(double bytes);

/// Gives memory that is free, but kept for later, back to the system: before something large.
void release_free_memory();

}  // namespace fem
