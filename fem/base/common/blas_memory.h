/// Memory that OpenBLAS works in. Internal to fem.
#pragma once

namespace fem {

/// OpenBLAS takes a block of 128 MB for each thread that calls it, and one for each of its own; a thread that
/// gets none asks again for ever. Where the memory of this process is limited (ulimit -v, -d), this takes
/// those of the callers now; OpenBLAS keeps them for calls to come. Nothing happens without such a limit or
/// with another BLAS. To be called once OpenBLAS' own threads have been started.
/// @param n_threads  that call BLAS at the same time
/// @throws DoesNotFit if there is no room for them
void reserve_blas_memory(int n_threads);

}  // namespace fem
