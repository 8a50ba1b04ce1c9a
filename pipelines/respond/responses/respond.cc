#include "pipelines/respond/responses/respond.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/files/content_hash.h"
#include "pipelines/respond/responses/response_files.h"
#include "pipelines/respond/responses/response_key.h"

namespace pipelines {
namespace {

std::vector<fem::SectionPlane> to_fem_planes(const std::vector<meshes::SectionPlane>& planes) {
  std::vector<fem::SectionPlane> result;
  for (const auto& plane : planes)
    result.push_back({plane.z_m, plane.radius_m, plane.axis_x_m, plane.axis_y_m, plane.inner_radius_m});
  return result;
}

std::string key_of(const MeshedBody& meshed, const BodyLoads& loads,
                   const std::vector<fem::SectionPlane>& planes, fem::Solver solver, int n_threads) {
  auto key = response_key(meshed.body, loads.unit_loads, planes, solver, n_threads);
  if (const int n = n_ranks_of_a_body(); n > 1) key += "ranks " + std::to_string(n) + '\n';
  return key;
}

std::filesystem::path kept_responses(const RunOptions& options) {
  return options.directory / kept_responses_name(Method::solid);
}

}  // namespace

std::string kept_responses_name(Method method) {
  return method == Method::axisymmetric ? "unit_harmonics.h5" : "unit_responses.h5";
}

int threads(int wanted) {
  return wanted > 0 ? wanted : int(std::max(1u, std::thread::hardware_concurrency()));
}

Responded respond(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads, const RunOptions& options,
                  StageClock& clock) {
  const auto start = std::chrono::steady_clock::now();
  const auto planes = to_fem_planes(meshed.mesh.sections);
  const auto key = key_of(meshed, loads, planes, body.solver, threads(options.n_threads));
  std::vector<std::string> warnings;
  const auto tell = [&](const std::string& line) { warnings.push_back(line); };
  if (!options.fresh)
    if (auto kept =
            clock.run("solve", [&] { return read_unit_responses(kept_responses(options), key, tell); })) {
      auto result = responded(body, meshed, std::move(loads), std::move(*kept));
      result.responses_reused = true;
      return result;
    }
  auto responses = clock.run("solve", [&] {
    fem::SolverChoice choice;
    choice.solver = body.solver;
    choice.keep_factor = options.keep_factor;
    return meshed.model->unit_responses(
        loads.unit_loads, planes, fem::Recovery::patch,
        [&](double share, const std::string& step) { clock.advance(share, step); }, choice);
  });
  const std::chrono::duration<double> solve = std::chrono::steady_clock::now() - start;
  auto result = responded(body, meshed, std::move(loads), std::move(responses));
  result.warnings = std::move(warnings);
  result.solve_s = solve.count();
  return result;
}

std::string keep_responses(const BodyScene& body, const MeshedBody& meshed, const Responded& responded,
                           const RunOptions& options, StageClock& clock) {
  const auto key = key_of(meshed, responded.loads, to_fem_planes(meshed.mesh.sections), body.solver,
                          threads(options.n_threads));
  if (!responded.responses_reused)
    clock.run("write", [&] { write_unit_responses(kept_responses(options), key, responded.responses); });
  return text_hash(key);
}

std::string keep_harmonics(const Responded& responded, const RunOptions& options, StageClock& clock) {
  const auto& responses = responded.responses;
  auto key = "harmonics around the axis\nprogram " + program_fingerprint() + '\n';
  for (const auto& channel : responses.channels) key += channel + '\n';
  for (const auto* values : {&responses.nodes.xyz_m, &responses.stress_Pa, &responses.displacement_m})
    key += text_hash({reinterpret_cast<const char*>(values->data()), sizeof(double) * values->size()}) + '\n';
  clock.run("write", [&] {
    if (!is_first_rank()) return;
    write_unit_responses(options.directory / kept_responses_name(responded.method), key, responses);
  });
  return text_hash(key);
}

}  // namespace pipelines
