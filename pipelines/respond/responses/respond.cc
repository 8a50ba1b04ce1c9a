#include "pipelines/respond/responses/respond.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/common/significant_bits.h"
#include "pipelines/base/disk/cache.h"
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

/// Bits of displacements: those of the 32-bit floats that they end as, in fields for viewers.
constexpr int displacement_bits = 24;

/// What the cache has under a key; nothing if it has none, or cannot be used.
std::optional<fem::UnitResponses> kept_responses(const std::string& key, const Tell& tell) {
  std::filesystem::path file;
  try {
    file = cached_file(text_hash(key));
  } catch (const FileError&) {  // told when the responses are to be kept
  }
  auto kept = read_unit_responses(file, key, tell);
  if (kept && is_first_rank()) mark_used(file);
  return kept;
}

}  // namespace

int threads(int wanted) {
  return wanted > 0 ? wanted : int(std::max(1u, std::thread::hardware_concurrency()));
}

Responded respond(const BodyScene& body, const MeshedBody& meshed, BodyLoads loads, const RunOptions& options,
                  StageClock& clock) {
  const auto start = std::chrono::steady_clock::now();
  const auto key = key_of_responses(body, meshed, loads, options);
  std::vector<std::string> warnings;
  const auto tell = [&](const std::string& line) { warnings.push_back(line); };
  if (!options.fresh)
    if (auto kept = clock.run("solve", [&] { return kept_responses(key, tell); })) {
      auto result = responded(body, meshed, std::move(loads), std::move(*kept));
      result.responses_reused = true;
      return result;
    }
  auto responses = clock.run("solve", [&] {
    fem::SolverChoice choice;
    choice.solver = body.solver;
    choice.keep_factor = options.keep_factor;
    return meshed.model->unit_responses(
        loads.unit_loads, to_fem_planes(meshed.mesh.sections), fem::Recovery::patch,
        [&](double share, const std::string& step) { clock.advance(share, step); }, choice);
  });
  for (double& moved_m : responses.displacement_m)
    moved_m = with_significant_bits(moved_m, displacement_bits);
  const std::chrono::duration<double> solve = std::chrono::steady_clock::now() - start;
  auto result = responded(body, meshed, std::move(loads), std::move(responses));
  result.warnings = std::move(warnings);
  result.solve_s = solve.count();
  return result;
}

std::string key_of_responses(const BodyScene& body, const MeshedBody& meshed, const BodyLoads& loads,
                             const RunOptions& options) {
  auto key = response_key(meshed.body, loads.unit_loads, to_fem_planes(meshed.mesh.sections), body.solver,
                          threads(options.n_threads));
  if (const int n = n_ranks_of_a_body(); n > 1) key += "ranks " + std::to_string(n) + '\n';
  return key;
}

std::string key_of_harmonics(const fem::UnitResponses& responses) {
  auto key = "harmonics around the axis\nprogram " + program_fingerprint() + '\n';
  for (const auto& channel : responses.channels) key += channel + '\n';
  for (const auto* values : {&responses.nodes.xyz_m, &responses.stress_Pa, &responses.displacement_m})
    key += text_hash({reinterpret_cast<const char*>(values->data()), sizeof(double) * values->size()}) + '\n';
  return key;
}

void KeptResponses::keep(const Responded& responded, const std::string& key, StageClock& clock) {
  keys[responded.scene.name] = key;
  const bool is_of_all_ranks = responded.responses.shared != nullptr;
  if (responded.responses_reused || !(is_of_all_ranks || is_first_rank())) return;
  const auto note = [&](const std::exception& error) {
    faults.push_back(responded.scene.name + ": unit responses are not kept for later runs: " + error.what());
  };
  try {
    const auto limit = cache_limit();
    if (limit == 0) return;
    clock.run("write", [&] { write_unit_responses(cached_file(text_hash(key)), key, responded.responses); });
    if (is_first_rank()) keep_cache_within(limit);
  } catch (const std::runtime_error& error) {  // the disk is full, or the directory not this user's to write
    note(error);
  } catch (const OptionError& error) {
    note(error);
  }
}

}  // namespace pipelines
