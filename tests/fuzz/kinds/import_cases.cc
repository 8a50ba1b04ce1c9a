/// STEP files and meshes: the checks of their text in this process, whole imports with gmsh in its child.
#include <cmath>

#include "meshes/gmsh/msh_writer.h"
#include "meshes/imported/file_checks.h"
#include "meshes/imported/imported.h"
#include "meshes/values/refused.h"
#include "tests/fuzz/kinds/samples.h"
#include "tests/fuzz/verdicts.h"

namespace fuzz {
namespace {

/// Refusals have a line; the import puts the file's name before it.
Verdict text_judged(void (*check)(const std::string&), const std::string& text) {
  return judged("line ", [&] {
    check(text);
    return std::string();
  });
}

/// One port at the bottom: most damage leaves it where it is.
meshes::Import import_of(const std::filesystem::path& file) {
  meshes::Import import;
  import.geometry = file;
  import.scale_to_m = 1e-3;
  import.ports = {
      { "foot",
        meshes::Port::Kind::face,
        meshes::BoxSelection {
          {-1, -1, -1e-6},
          { 1,
            1,
            1e-6 }
        } }};
  import.control.size_m = 0.012;
  import.control.cells_per_circle = 6;
  import.control.min_scaled_jacobian = 0.01;
  return import;
}

std::string fault_of_import(const std::filesystem::path& file, const std::filesystem::path& mesh) {
  const auto body = meshes::build_imported(import_of(file));
  meshes::write_msh(body, mesh);
  if (!std::isfinite(body.quality.min_scaled_jacobian) || !std::isfinite(body.quality.max_aspect))
    return "the quality is not finite";
  meshes::check_msh_text(read_bytes(mesh));  // what is written must pass as well
  return "";
}

Verdict import_judged(const std::string& name, const std::string& text, const Place& place) {
  write_bytes(place / name, text);
  auto verdict = judged(name, [&] { return fault_of_import(place / name, place / "mesh.msh"); });
  if (!verdict.fault.empty()) return verdict;
  const auto files = all_files(place.directory);
  if (files.size() != (verdict.accepted ? 2 : 1)) verdict.fault = "the import leaves files";
  return verdict;
}

std::string damaged_step(Mutator& random, const Place& place) {
  const auto& step = random.one_of(place.samples.steps);
  return random.damage(step, Grammar::step, step);
}

std::string damaged_mesh(Mutator& random, const Place& place) {
  const auto& mesh = random.one_of(place.samples.meshes);
  return random.damage(mesh, Grammar::msh, random.one_of(place.samples.meshes));
}

}  // namespace

Verdict step_text_case(Mutator& random, const Place& place) {
  const auto text = damaged_step(random, place);
  write_bytes(place / "part.step", text);
  return text_judged(meshes::check_step_text, text);
}

Verdict msh_text_case(Mutator& random, const Place& place) {
  const auto text = damaged_mesh(random, place);
  write_bytes(place / "part.msh", text);
  return text_judged(meshes::check_msh_text, text);
}

Verdict step_case(Mutator& random, const Place& place) {
  return import_judged("part.step", damaged_step(random, place), place);
}

Verdict msh_case(Mutator& random, const Place& place) {
  return import_judged("part.msh", damaged_mesh(random, place), place);
}

}  // namespace fuzz
