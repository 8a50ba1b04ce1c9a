#include "pipelines/base/common/several_ranks.h"

#include <cstdlib>

#include "fem/mesh/ranks/ranks.h"

namespace pipelines {

namespace {
bool works_alone = false;
}

bool started_on_several_ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_NTASKS"})  // Open MPI, MPICH, srun
    if (const char* size = std::getenv(name); size != nullptr && std::atoi(size) > 1) return true;
  return false;
}

std::string number_from_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char* number = std::getenv(name)) return number;
  return "";
}

MPI_Comm ranks_of_a_body() {
  return works_alone ? MPI_COMM_SELF : MPI_COMM_WORLD;
}

int n_ranks_of_a_body() {
  return fem::n_ranks(ranks_of_a_body());
}

void work_on_bodies_alone() {
  works_alone = true;
}

bool is_first_rank() {
  return fem::this_rank(ranks_of_a_body()) == 0;
}

double as_on_first_rank(double value) {
  fem::take_from_first(ranks_of_a_body(), &value, sizeof value);
  return value;
}

int as_on_first_rank(int value) {
  fem::take_from_first(ranks_of_a_body(), &value, sizeof value);
  return value;
}

bool as_on_first_rank(bool value) {
  return as_on_first_rank(value ? 1 : 0) != 0;
}

void wait_for_ranks() {
  fem::wait_for_all(ranks_of_a_body());
}

}  // namespace pipelines
