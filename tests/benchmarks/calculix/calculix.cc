/// Twelve unit loads on the shaft of shaft.toml here and in CalculiX, in the same run on the same machine,
/// each in a process of its own; and our direct path beside bare CHOLMOD. Ratios of one run.
///   calculix_benchmark <shaft.toml> [largest number of our unknowns, default 250000
///   [seconds that CalculiX may take for each mesh, default 600]]
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <thread>

#include "fem/models/solid/model.h"
#include "tests/benchmarks/calculix/calculix_work.h"
#include "tests/benchmarks/calculix/child_process.h"
#include "tests/benchmarks/solvers/benchmark_shaft.h"

namespace {

namespace fs = std::filesystem;
constexpr int n_loads = 12;

/// A mesh that is solved by us and by CalculiX, and a finer one on which CalculiX has as many unknowns as we
/// have on the first: a C3D20 mesh has half the unknowns of ours.
struct Size {
  measure::Refinement mesh, finer;
};
constexpr Size sizes[] = {{{4, 12}, {2, 20}}, {{4, 24}, {4, 32}}};

/// What a part of the benchmark printed, by name.
std::map<std::string, double> figures(const fs::path& log) {
  std::map<std::string, double> result;
  std::ifstream in(log);
  std::string name, value;
  while (in >> name >> value) result[name] = std::atof(value.c_str());
  return result;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs parts of this program, and CalculiX, in one directory per mesh.
class Bench {
public:
  Bench(const char* program, const char* scene, double time_limit_s)
      : time_limit_s_(time_limit_s),
        program_(fs::canonical(program)),
        scene_(fs::absolute(scene)),
        directory_(fs::temp_directory_path() / ("calculix_benchmark_" + std::to_string(getpid()))) {
    fs::create_directory(directory_);
  }
  ~Bench() {
    std::error_code ignored;
    fs::remove_all(directory_, ignored);
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  fs::path place(const measure::Refinement& mesh) const {
    auto result = directory_ / (std::to_string(mesh.fillet_cells) + "_" + std::to_string(mesh.sectors));
    fs::create_directory(result);
    return result;
  }

  measure::ChildCost part(const char* name, const measure::Refinement& mesh) const {
    const auto cost = measure::run_child({program_, scene_, "--part", name, std::to_string(mesh.fillet_cells),
                                          std::to_string(mesh.sectors), place(mesh)},
                                         place(mesh), name, {}, 3600);
    if (!cost.finished)
      std::printf("  %s did not come to its end:\n%s\n", name, text_of(place(mesh) / name).c_str());
    return cost;
  }

  measure::ChildCost calculix(const measure::Refinement& mesh) const {
    const std::string n = std::to_string(measure::n_threads);
    return measure::run_child({"ccx", "-i", "shaft"}, place(mesh), "ccx.log",
                              {"OMP_NUM_THREADS=" + n, "CCX_NPROC_EQUATION_SOLVER=" + n,
                               "CCX_NPROC_STIFFNESS=" + n, "CCX_NPROC_RESULTS=" + n},
                              time_limit_s_);
  }

private:
  double time_limit_s_;  ///< of CalculiX
  std::string program_, scene_;
  fs::path directory_;
};

/// Without unknowns: it did not come about.
struct Row {
  std::string name;
  double unknowns = 0, wall_s = 0, cpu_s = 0, peak_gigabytes = 0;
  bool finished = true;  ///< all steps: there are results to compare
};

void print(const Row& row, const Row& direct, const Row& iterative) {
  if (row.unknowns == 0) {
    std::printf("  %-34s not measured\n", row.name.c_str());
    return;
  }
  std::printf("  %-34s %8.0f %9.2f %9.2f %7.2f %8.1f %8.1f %8.1f %8.1f\n", row.name.c_str(), row.unknowns,
              row.wall_s, row.cpu_s, row.peak_gigabytes, row.wall_s / direct.wall_s,
              row.wall_s / iterative.wall_s, row.cpu_s / direct.cpu_s, row.cpu_s / iterative.cpu_s);
}

Row ours(const Bench& bench, const char* name, const measure::Refinement& mesh, double unknowns) {
  const auto cost = bench.part(name, mesh);
  auto taken = figures(bench.place(mesh) / name);
  if (taken.count("another_solver")) std::printf("  %s: the other solver took over\n", name);
  return {std::string("ours, ") + name, unknowns, taken["wall_s"], taken["cpu_s"], cost.peak_gigabytes, true};
}

int n_steps_done(const fs::path& sta) {
  std::ifstream in(sta);
  int n_lines = 0;
  for (std::string line; std::getline(in, line);) ++n_lines;
  return std::max(0, n_lines - 2);  // of header
}

/// Of twelve steps that are alike: a run that was stopped tells by those done how long all would take.
Row theirs(const Bench& bench, const measure::Refinement& mesh, double unknowns, const char* which) {
  const auto cost = bench.calculix(mesh);
  const std::string log = text_of(bench.place(mesh) / "ccx.log");
  const auto at = log.find("using the ");
  if (at != std::string::npos)
    std::printf("  CalculiX's solver: %s\n", log.substr(at + 10, log.find('\n', at) - at - 10).c_str());
  Row row{std::string("CalculiX, ") + which, unknowns, cost.wall_s, cost.cpu_s, cost.peak_gigabytes, true};
  if (cost.finished) return row;
  Row not_measured{row.name, 0, 0, 0, 0, false};
  row.finished = false;
  if (!cost.timed_out) {
    std::printf("  CalculiX failed:\n%s\n", log.c_str());
    return not_measured;
  }
  const int n_steps = n_steps_done(bench.place(mesh) / "shaft.sta");
  std::printf("  CalculiX was stopped after %.0f s and %d of %d steps: its seconds are those times %d/%d\n",
              cost.wall_s, n_steps, n_loads, n_loads, n_steps);
  if (n_steps == 0) return not_measured;
  row.wall_s *= double(n_loads) / n_steps;
  row.cpu_s *= double(n_loads) / n_steps;
  return row;
}

void measure_size(const Bench& bench, const Size& size, double most) {
  if (!bench.part("model", size.mesh).finished) return;
  auto counts = figures(bench.place(size.mesh) / "model");
  const double unknowns = counts["unknowns"];
  if (unknowns > most) return;
  std::printf("%.0f unknowns, %d unit loads, %d threads on %u cores\n", unknowns, n_loads, measure::n_threads,
              std::thread::hardware_concurrency());
  const Row direct = ours(bench, "direct", size.mesh, unknowns);
  const Row iterative = ours(bench, "iterative", size.mesh, unknowns);
  const Row same_mesh = theirs(bench, size.mesh, counts["calculix_unknowns"], "the same mesh");
  bench.part("model", size.finer);
  auto finer = figures(bench.place(size.finer) / "model");
  const Row same_count = theirs(bench, size.finer, finer["calculix_unknowns"], "as many unknowns");
  std::printf("  %-34s %8s %9s %9s %7s %17s %17s\n", "mesh file to stresses on the disk", "unknowns",
              "wall s", "CPU s", "peak GB", "wall / ours", "CPU / ours");
  std::printf("  %-34s %8s %9s %9s %7s %8s %8s %8s %8s\n", "", "", "", "", "", "direct", "iterat.", "direct",
              "iterat.");
  for (const Row& row : {direct, iterative, same_mesh, same_count}) print(row, direct, iterative);
  const auto solve = [&](const char* name, const char* figure) {
    return figures(bench.place(size.mesh) / name)[figure];
  };
  std::printf(
      "  of ours, loads, assembly and solution alone: direct %.2f s (CPU %.2f), iterative %.2f s (CPU "
      "%.2f)\n",
      solve("direct", "solve_wall_s"), solve("direct", "solve_cpu_s"), solve("iterative", "solve_wall_s"),
      solve("iterative", "solve_cpu_s"));
  if (bench.part("factorise", size.mesh).finished) {
    auto factor = figures(bench.place(size.mesh) / "factorise");
    std::printf(
        "  direct path over bare CHOLMOD (analyse, factorise, solve: %.2f s): with assembly %.2f (CPU %.2f), "
        "without "
        "%.2f (CPU %.2f); answers differ by %.1e\n",
        factor["bare_s"], factor["with_assembly"], factor["with_assembly_cpu"], factor["without_assembly"],
        factor["without_assembly_cpu"], factor["apart"]);
  }
  if (same_mesh.finished && bench.part("compare", size.mesh).finished)
    std::printf("%s", text_of(bench.place(size.mesh) / "compare").c_str());
}

int run_part(int argc, char** argv) {
  if (argc != 7) return 2;
  const std::string name = argv[3];
  const fem::Environment environment(measure::n_threads);
  const measure::Work work{
      measure::refined_shaft(pipelines::read_scene(argv[1]), {std::atoi(argv[4]), std::atoi(argv[5])}),
      argv[6]};
  if (name == "model")
    measure::write_model(work);
  else if (name == "factorise")
    measure::factorise(work);
  else if (name == "compare")
    measure::compare(work);
  else
    measure::solve(work, name == "direct" ? fem::Solver::direct : fem::Solver::iterative);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::string(argv[2]) == "--part") return run_part(argc, argv);
  if (argc < 2) {
    std::fprintf(
        stderr,
        "usage: calculix_benchmark <shaft.toml> [largest number of unknowns [seconds for CalculiX]]\n");
    return 2;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const Bench bench(argv[0], argv[1], argc > 3 ? std::atof(argv[3]) : 600);
  for (const auto& size : sizes) measure_size(bench, size, argc > 2 ? std::atof(argv[2]) : 2.5e5);
}
