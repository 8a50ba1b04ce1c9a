// STEP files and meshes that are damaged by chance: whatever gmsh and OpenCASCADE make of them, this process
// goes on, soon, and what it throws names the file.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <iterator>

#include "meshes/imported/imported.h"
#include "meshes/values/refused.h"
#include "tests/unit/meshes/examples/damaged_samples.h"
#include "tests/unit/meshes/examples/example_shafts.h"

namespace {

double used_by_children_s() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/// One port at the bottom: most damage leaves it where it is.
meshes::Import import_of_mutant(const std::filesystem::path& file) {
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

/// Message of what is thrown; empty: the file was taken.
std::string outcome_of(const std::filesystem::path& file) {
  try {
    meshes::build_imported(import_of_mutant(file), temporary_msh("of_mutant"));
  } catch (const meshes::GeometryRefused& error) {
    return error.what();
  } catch (const meshes::MeshRefused& error) {
    return error.what();
  }
  return "";
}

TEST(MutatedImports, AreRefusedOrTakenAndNothingElse) {
  const auto directory = temporary_msh("x").parent_path();
  damaged::write_samples(directory);
  for (const auto& sample : damaged::samples) EXPECT_EQ(outcome_of(directory / sample), "");
  const int n_mutants = damaged::n_mutants(60);
  damaged::Mutator mutator(1);
  std::map<std::string, int> count;
  double slowest_s = 0;
  for (int i = 0; i < n_mutants; ++i) {
    const auto sample = directory / damaged::samples[std::size_t(i) % damaged::samples.size()];
    std::ifstream in(sample, std::ios::binary);
    const std::string sound{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const auto file = directory / ("mutant" + sample.extension().string());
    std::string what;
    const std::string text = mutator.damage(sound, sample.extension() == ".step", what);
    std::ofstream(file, std::ios::binary) << text;
    SCOPED_TRACE(std::to_string(i) + " of " + sample.filename().string() + ", " + what);
    const double before_s = used_by_children_s();
    const std::string refusal = outcome_of(file);
    const double took_s = used_by_children_s() - before_s;
    slowest_s = std::max(slowest_s, took_s);
    EXPECT_LT(took_s, 10);
    EXPECT_TRUE(refusal.empty() || refusal.find(file.string()) != std::string::npos) << refusal;
    const auto has = [&](const char* words) { return refusal.find(words) != std::string::npos; };
    ++count[refusal.empty()                 ? "taken"
            : has("gmsh crashed")           ? "crashed apart"
            : has("did not come to an end") ? "hung apart"
            : has("ran out of memory")      ? "too large apart"
            : has(": line ")                ? "told with a line"
                                            : "refused"];
  }
  std::cout << "mutants: " << damaged::told(count) << "slowest " << slowest_s << " s of a core\n";
  EXPECT_GT(n_mutants - count["taken"], n_mutants / 2) << "the damage is none";
  EXPECT_GT(count["told with a line"], n_mutants / 4) << "nobody looked at the text";
}

}  // namespace
