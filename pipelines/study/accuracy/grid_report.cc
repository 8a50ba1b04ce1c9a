#include <fmt/core.h>

#include <ostream>

#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/study/accuracy/accuracy_report.h"

namespace pipelines {

void print_grid_study(std::ostream& out, const GridStudy& study) {
  const auto& c = study.convergence;
  out << "\n  systematic meshes\n"
      << fmt::format("    {:>10}{:>12}{:>9}{:>9}  {}\n", "unknowns", "cell, mm", "ratio", "MPa", "mesh");
  for (std::size_t i = 0; i < study.meshes.size(); ++i) {
    const auto& mesh = study.meshes[i];
    const std::string ratio =
        i > 0 ? fmt::format("{:.3f}", study.meshes[i - 1].size_m / mesh.size_m) : std::string();
    out << fmt::format("    {:>10}{:>12.3f}{:>9}{:>9.3f}  {}\n", mesh.n_dofs, 1e3 * mesh.size_m, ratio,
                       mesh.value_Pa / 1e6, mesh.fineness);
  }
  if (c.observed_order != 0) out << fmt::format("    observed order {:.2f}", c.observed_order);
  if (c.order > 0)
    out << fmt::format(
        "{}Richardson's value {:.3f} MPa; index of the finest {:.3f} MPa (factor {:g}, order {:.2f})",
        c.observed_order != 0 ? "; " : "    ", c.extrapolated / 1e6, c.index_21 / 1e6, c.safety, c.order);
  if (c.asymptotic_ratio != 0) out << fmt::format("; GCI_32 / (r^p GCI_21) = {:.3f}", c.asymptotic_ratio);
  if (c.observed_order != 0 || c.order > 0) out << '\n';
  if (study.between_nodes_Pa > 0)
    out << fmt::format(
        "    values are those between nodes too: the finest's peak, at a node, is {:.3f} MPa less\n",
        study.between_nodes_Pa / 1e6);
  if (!c.usable()) out << "    index refused: " << c.refusal << '\n';
}

void write_grid_csv(const std::filesystem::path& file, const GridStudy& study) {
  std::vector<std::string> meshes;
  std::vector<double> unknowns, sizes, values;
  for (const auto& mesh : study.meshes) {
    meshes.push_back(mesh.fineness);
    unknowns.push_back(double(mesh.n_dofs));
    sizes.push_back(mesh.size_m);
    values.push_back(mesh.value_Pa);
  }
  write_csv(file, in_shown_units({{"mesh", "", meshes},
                                  {"unknowns", "1", unknowns},
                                  {"cell_size", "m", sizes},
                                  {"value", "Pa", values}}));
}

}  // namespace pipelines
