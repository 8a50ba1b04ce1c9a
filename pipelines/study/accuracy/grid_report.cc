#include <fmt/core.h>

#include <ostream>

#include "pipelines/base/fields/field_outputs.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/study/accuracy/accuracy_report.h"

namespace pipelines {
namespace {

std::vector<GridRow> rows_of(const GridStudy& study) {
  std::vector<GridRow> rows;
  for (const auto& mesh : study.meshes) rows.push_back({mesh, rows.empty() ? nullptr : &rows.back().mesh});
  return rows;
}

}  // namespace

FieldTable<GridRow> grid_fields() {
  using Field = FieldOf<GridRow>;
  return {
      {"mesh", quantities::text, "in words", "mesh", [](const auto& r) { return r.mesh.fineness; }},
      {"unknowns", quantities::count, "of the mesh", "unknowns", [](const auto& r) { return r.mesh.n_dofs; }},
      Field("cell_size", quantities::length, "of its cells", "cell",
            [](const auto& r) { return r.mesh.size_m; })
          .digits("{:.3f}"),
      Field("ratio", quantities::ratio, "of the coarser mesh's cells to its own", "ratio",
            [](const auto& r) {
              return r.coarser ? summary::Json(r.coarser->size_m / r.mesh.size_m) : summary::Json(nullptr);
            })
          .digits("{:.3f}"),
      Field("value", quantities::stress, "largest stress", "stress", [](const auto& r) {
        return r.mesh.value_Pa;
      }).digits("{:.3f}")};
}

void print_grid_study(std::ostream& out, const GridStudy& study) {
  const auto& c = study.convergence;
  out << "\n  systematic meshes";
  print_list(out, grid_fields(), rows_of(study));
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
  write_csv(file, csv_columns(fields_of(grid_fields()), whole_rows(grid_fields(), rows_of(study))));
}

}  // namespace pipelines
