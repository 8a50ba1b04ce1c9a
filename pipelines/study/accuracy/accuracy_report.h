/// An accuracy study as a table, CSV and HDF5.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "pipelines/base/fields/field.h"
#include "pipelines/study/accuracy/accuracy.h"

namespace pipelines {

/// A line for each of 5, 2 and 1 %: the stress that `run --tolerance` ends with, its seconds and its distance
/// from the reference.
std::string where_tolerances_end(const AccuracyStudy& study);

/// A warning that names every run which the reference contradicts; empty if there is none.
std::string disagreements(const AccuracyStudy& study);

/// A run and the study that it belongs to.
struct StudyRow {
  const AccuracyStudy& study;
  const AccuracyRow& run;
};

/// <body>.csv and accuracy.h5.
FieldTable<StudyRow> accuracy_fields();

/// A systematic mesh and the one before it, if there is one.
struct GridRow {
  const GridStudy::Mesh& mesh;
  const GridStudy::Mesh* coarser;
};

/// <body>_gci.csv.
FieldTable<GridRow> grid_fields();

/// The table on the terminal, with what it ran on.
void print_accuracy(std::ostream& out, const AccuracyStudy& study);

/// The systematic meshes, with order, extrapolated value and index, or why there is none.
void print_grid_study(std::ostream& out, const GridStudy& study);

/// One row per systematic mesh: mesh, unknowns, cell size, stress.
/// @throws FileError naming the file if it cannot be written
void write_grid_csv(const std::filesystem::path& file, const GridStudy& study);

/// One row per run: model, mesh, unknowns, stress, every entry of the budget, true error, seconds per stage,
/// memory.
/// @throws FileError naming the file if it cannot be written
void write_accuracy_csv(const std::filesystem::path& file, const AccuracyStudy& study);

/// /<body>/<series>, the columns of the CSV; reference, tolerance, machine and versions are attributes, and
/// so is the grid convergence index (grid_convergence_*).
/// @throws FileError naming the file if it cannot be written
void write_accuracy_h5(const std::filesystem::path& file, const std::vector<AccuracyStudy>& studies);

/// Effectivity (estimated over true error) of all runs but the references: how many are bounded, the median.
struct Effectivities {
  std::size_t n_runs = 0, n_bounded = 0;
  double median = 0, smallest = 0;
};
/// Runs closer to the reference than the reference's own error count as bounded if their estimate says so
/// much.
Effectivities effectivities(const AccuracyStudy& study);

/// "AMD EPYC 7B13, 2 threads, 25 GB; millstress 0.1, deal.II 9.4.1, ...".
std::string machine_and_versions();

}  // namespace pipelines
