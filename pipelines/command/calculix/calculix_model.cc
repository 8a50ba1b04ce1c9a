#include "pipelines/command/calculix/calculix_model.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <utility>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/open_directory.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/loads/channels/rigid_part.h"

namespace pipelines {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Nodes, elements, material, support. Thirteen digits fill CalculiX's fields of twenty characters.
void write_model(std::FILE* out, const std::string& title, const fem::Material& material,
                 const fem::NodalLoads& loads, const Serendipity& kept) {
  const auto& nodes = loads.nodes;
  std::fprintf(out, "*HEADING\n%s; m, N, Pa\n*NODE, NSET=NALL\n", title.c_str());
  for (std::size_t i = 0; i < nodes.n; ++i)
    if (kept.keeps(i))
      std::fprintf(out, "%zu,%.12E,%.12E,%.12E\n", i + 1, nodes.xyz_m[3 * i], nodes.xyz_m[3 * i + 1],
                   nodes.xyz_m[3 * i + 2]);
  const bool tetrahedra = nodes.kind == fem::CellKind::tetrahedra;
  const std::size_t n_element_nodes = tetrahedra ? nodes.nodes_per_cell() : n_serendipity_nodes;
  std::fprintf(out, "*ELEMENT, TYPE=%s, ELSET=EALL\n", tetrahedra ? "C3D10" : "C3D20");
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    std::fprintf(out, "%zu", c + 1);
    for (std::size_t v = 0; v < n_element_nodes; ++v)
      std::fprintf(out, v == 10 ? ",\n%d" : ",%d", nodes.cell(c)[v] + 1);
    std::fputc('\n', out);
  }
  std::fprintf(out,
               "*MATERIAL, NAME=MATERIAL\n*ELASTIC\n%.12E,%.12E\n*SOLID SECTION, ELSET=EALL, "
               "MATERIAL=MATERIAL\n*BOUNDARY\n",
               material.youngs_modulus_Pa, material.poisson_ratio);
  for (const auto unknown : loads.held)
    std::fprintf(out, "%lld,%d\n", static_cast<long long>(unknown) / 3 + 1, int(unknown % 3 + 1));
}

void write_step(std::FILE* out, const std::string& channel, const double* force, const Serendipity& kept,
                std::size_t n_nodes) {
  // OP=NEW: nothing of the step before stays.
  std::fprintf(out, "** %s = 1\n*STEP\n*STATIC\n*CLOAD, OP=NEW\n", channel.c_str());
  for (std::size_t i = 0; i < n_nodes; ++i)
    for (int d = 0; kept.keeps(i) && d < 3; ++d)
      std::fprintf(out, "%zu,%d,%.12E\n", i + 1, d + 1, force[3 * i + std::size_t(d)]);
  std::fputs("*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n", out);
}

}  // namespace

CalculixForces calculix_forces(const fem::NodalLoads& loads, const Serendipity& nodes) {
  CalculixForces result;
  result.force_N = loads.force_N;
  auto volume_m3 = loads.nodes.volume_m3;
  nodes.condense(volume_m3.data(), 1);
  const RigidPart rigid(loads.nodes, std::move(volume_m3));
  const std::size_t per_load = 3 * loads.nodes.n;
  for (std::size_t at = 0; at < result.force_N.size(); at += per_load) {
    nodes.condense(&result.force_N[at], 3);
    result.moment_removed = std::max(result.moment_removed, rigid.remove_resultants(&result.force_N[at]));
  }
  return result;
}

void write_calculix_model(const std::filesystem::path& file, const std::string& title,
                          const std::vector<std::string>& channels, const fem::Material& material,
                          const fem::NodalLoads& loads) {
  const Serendipity kept(loads.nodes);
  const auto forces = calculix_forces(loads, kept);
  const std::size_t per_load = 3 * loads.nodes.n;
  if (forces.force_N.size() != channels.size() * per_load)
    throw std::invalid_argument("write_calculix_model: a name for each load is needed");
  AtomicFile target(file);
  File out(std::fopen(target.temporary().c_str(), "wb"), std::fclose);
  if (!out) throw FileError(shown(file) + ": cannot be written");
  write_model(out.get(), title, material, loads, kept);
  for (std::size_t k = 0; k < channels.size(); ++k)
    write_step(out.get(), channels[k], &forces.force_N[k * per_load], kept, loads.nodes.n);
  const bool failed = std::ferror(out.get()) != 0;
  if (std::fclose(out.release()) != 0 || failed)
    throw FileError(shown(file) + ": cannot be written; is the disk full?");
  target.commit();
}

}  // namespace pipelines
