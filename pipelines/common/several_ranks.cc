#include "pipelines/common/several_ranks.h"

#include <cstdlib>

namespace pipelines {

bool started_on_several_ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_NTASKS"})  // Open MPI, MPICH, srun
    if (const char* size = std::getenv(name); size != nullptr && std::atoi(size) > 1) return true;
  return false;
}

}  // namespace pipelines
