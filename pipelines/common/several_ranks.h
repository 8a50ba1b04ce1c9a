/// The program under mpirun.
#pragma once

namespace pipelines {

/// Whether a launcher of MPI programs says that it started several processes: without one MPI is started only
/// where a body is looked at.
bool started_on_several_ranks();

}  // namespace pipelines
