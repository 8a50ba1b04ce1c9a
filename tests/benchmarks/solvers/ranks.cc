/// Twelve unit loads of the shaft of shaft.toml by conjugate gradients on some MPI ranks: seconds, steps,
/// messages and the largest memory of each rank, from the mesh to the file of unit responses.
///   mpirun -n N rank_benchmark <shaft.toml> <cells on a fillet quarter> <sectors>
#include <mpi.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "fem/mesh/ranks/ranks.h"
#include "fem/models/solid/model.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/respond/responses/response_files.h"
#include "pipelines/scene/whole/scene.h"
#include "tests/benchmarks/solvers/benchmark_shaft.h"
#include "tests/benchmarks/solvers/process.h"

namespace {

std::atomic<double> n_messages{0}, sent_bytes{0};

void count_message(int n, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  n_messages = n_messages + 1;
  sent_bytes = sent_bytes + double(n) * size;
}

}  // namespace

// MPI's profiling interface: these stand before the library's own.
extern "C" int MPI_Send(const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm communicator) {
  count_message(n, type);
  return PMPI_Send(data, n, type, to, tag, communicator);
}

extern "C" int MPI_Isend(const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm communicator,
                         MPI_Request* request) {
  count_message(n, type);
  return PMPI_Isend(data, n, type, to, tag, communicator, request);
}

namespace {

struct Solved {
  std::size_t n_dofs = 0;
  double wall_s = 0;
  int n_iterations = 0;
};

/// On every rank.
Solved solve(const char* scene_file, const measure::Refinement& refinement) {
  const auto scene = pipelines::read_scene(scene_file);
  const auto directory =
      std::filesystem::temp_directory_path() / ("rank_benchmark_" + std::to_string(getpid()));
  if (fem::this_rank(MPI_COMM_WORLD) == 0) std::filesystem::create_directories(directory);
  const auto meshed = pipelines::mesh_body(measure::refined_shaft(scene, refinement), {});
  fem::SolverChoice choice;
  choice.solver = fem::Solver::iterative;
  const double start_s = measure::wall_s();
  const auto responses =
      meshed.model->unit_responses(measure::seat_loads(meshed.mesh), {}, fem::Recovery::patch, {}, choice);
  const double wall_s = measure::wall_s() - start_s;
  pipelines::write_unit_responses(directory / "unit_responses.h5", "benchmark", responses);
  std::filesystem::remove_all(directory);
  if (responses.solver.used != fem::Solver::iterative)
    throw std::runtime_error("not solved by the iteration: " + responses.solver.reason);
  return {responses.n_dofs, wall_s, responses.solver.n_iterations};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: mpirun -n N rank_benchmark SHAFT.toml FILLET_CELLS SECTORS\n");
    return 2;
  }
  const fem::Environment environment(1);
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  Solved solved;
  try {
    solved = solve(argv[1], {std::atoi(argv[2]), std::atoi(argv[3])});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rank %d: %s\n", rank, error.what());
    MPI_Abort(MPI_COMM_WORLD, 3);
  }
  const std::array<double, 3> own{measure::memory_bytes("VmHWM:"), n_messages, sent_bytes};
  std::vector<std::array<double, 3>> all(static_cast<std::size_t>(n_ranks));
  MPI_Gather(own.data(), 3, MPI_DOUBLE, all.data(), 3, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  if (rank != 0) return 0;
  double others_bytes = 0, messages = 0, bytes = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (r > 0) others_bytes = std::max(others_bytes, all[r][0]);
    messages += all[r][1];
    bytes += all[r][2];
  }
  std::printf("| %d | %zu | %.1f | %d | %.0f | %.2f | %.3f | %.3f |\n", n_ranks, solved.n_dofs, solved.wall_s,
              solved.n_iterations, messages, 1e-9 * bytes, 1e-9 * all[0][0], 1e-9 * others_bytes);
  return 0;
}
