#include "pipelines/respond/responses/response_files.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "fem/base/values/cell_shares.h"
#include "fem/mesh/ranks/ranks.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/hdf5_file.h"
#include "pipelines/base/files/kept_file.h"

namespace pipelines {
namespace {

/// Version of the file's arrangement: files of another one count as missing.
constexpr double arrangement = 6;

struct Counts {
  std::size_t nodes, cells, faces, channels, planes, rings;
  std::size_t volumes;       ///< cells whose volume group is known: all or none
  std::size_t energy_cells;  ///< cells and channels with energies: all or none
  std::size_t energy_channels;
  std::size_t node_images;  ///< mirror images of nodes, and of cells: all or none
  std::size_t cell_images;
};

// These are written and read as rows of numbers.
static_assert(sizeof(fem::SectionPlane) == 5 * sizeof(double));
static_assert(sizeof(fem::SectionResponse) == 14 * sizeof(double));

double* entries(std::vector<double>& v) {
  return v.data();
}
std::int32_t* entries(std::vector<std::int32_t>& v) {
  return v.data();
}
template <std::size_t n>
double* entries(std::vector<std::array<double, n>>& v) {
  return v.empty() ? nullptr : v.front().data();
}
double* entries(std::vector<fem::SectionPlane>& v) {
  return reinterpret_cast<double*>(v.data());
}
double* entries(std::vector<fem::SectionResponse>& v) {
  return reinterpret_cast<double*>(v.data());
}

/// VTK's names for the orders of nodes in cells and faces.
std::array<const char*, 2> vtk_names(const fem::CellShape& shape) {
  if (shape.is_tetrahedron()) return {"VTK_QUADRATIC_TETRA", "VTK_QUADRATIC_TRIANGLE"};
  if (shape.degree == 1) return {"VTK_HEXAHEDRON", "VTK_QUAD"};
  if (shape.degree == 2) return {"VTK_TRIQUADRATIC_HEXAHEDRON", "VTK_BIQUADRATIC_QUAD"};
  return {"VTK_LAGRANGE_HEXAHEDRON", "VTK_LAGRANGE_QUADRILATERAL"};
}

/// The shape of cells with so many nodes.
fem::CellShape shape_of(std::size_t nodes_per_cell) {
  if (nodes_per_cell == 10) return {fem::CellKind::tetrahedra, 2};
  for (const int degree : {1, 2, 3})
    if (std::size_t(fem::CellShape{fem::CellKind::hexahedra, degree}.nodes_per_cell()) == nodes_per_cell)
      return {fem::CellKind::hexahedra, degree};
  throw FileError("/nodes/cells: no cells have " + std::to_string(nodes_per_cell) + " nodes");
}

/// Visits every array of the responses with its name, its extents and its label: the one list that writer and
/// reader share.
template <class Visit>
void visit_arrays(fem::UnitResponses& r, const Counts& n, Visit visit) {
  using Extents = std::vector<std::size_t>;
  visit("/nodes/xyz", r.nodes.xyz_m, Extents{n.nodes, 3}, Hdf5Label{"m", ""});
  visit("/nodes/volume", r.nodes.volume_m3, Extents{n.nodes},
        Hdf5Label{"m3", "integral of the shape function"});
  const auto order = vtk_names(r.nodes.shape());
  visit("/nodes/cells", r.nodes.cells, Extents{n.cells, r.nodes.nodes_per_cell()}, Hdf5Label{"", order[0]});
  visit("/nodes/faces", r.nodes.faces, Extents{n.faces, r.nodes.nodes_per_face()}, Hdf5Label{"", order[1]});
  visit("/nodes/face_boundary_id", r.nodes.face_boundary_id, Extents{n.faces}, Hdf5Label{});
  visit("/nodes/cell_volume_id", r.nodes.cell_volume_id, Extents{n.volumes}, Hdf5Label{});
  visit("/energy/norm", r.energy_error.norm_sqrtJ, Extents{n.energy_channels}, Hdf5Label{"J^(1/2)", ""});
  visit("/energy/products", r.energy_error.energy, Extents{n.energy_channels, n.energy_channels},
        Hdf5Label{"1", "of the channels' stresses, in units of their norms"});
  visit("/energy/error", r.energy_error.error, Extents{n.energy_channels, n.energy_channels},
        Hdf5Label{"1", "of recovered minus cells' stresses, in the same units"});
  visit("/energy/error_of_cells", r.energy_error.of_cells, Extents{n.energy_cells, n.energy_channels},
        Hdf5Label{"1", "the cells' parts of the diagonal"});
  visit("/images/node", r.images.node, Extents{n.node_images}, Hdf5Label{"", "each node's mirror image"});
  visit("/images/cell", r.images.cell, Extents{n.cell_images}, Hdf5Label{"", "each cell's mirror image"});
  visit("/displacement", r.displacement_m, Extents{n.nodes, n.channels, 3}, Hdf5Label{"m", "x y z"});
  visit("/stress", r.stress_Pa, Extents{n.nodes, n.channels, 6}, Hdf5Label{"Pa", "xx yy zz xy yz xz"});
  visit("/resultants", r.resultants, Extents{n.channels, 6}, Hdf5Label{"", "fx fy fz [N], mx my mz [N m]"});
  visit("/planes", r.planes, Extents{n.planes, 5}, Hdf5Label{"m", "z, radius, axis x, axis y, inner radius"});
  visit("/plane_area", r.plane_area_m2, Extents{n.planes}, Hdf5Label{"m2", ""});
  visit("/sections", r.sections, Extents{n.planes, n.channels, 14},
        Hdf5Label{"",
                  "fx fy fz [N], mx my mz [N m], mean rim shear r_theta, theta_z [Pa], translation [m], "
                  "rotation [rad]"});
  visit("/ring_shear", r.ring_shear_Pa, Extents{n.rings, n.channels, 2}, Hdf5Label{"Pa", "r_theta, theta_z"});
}

/// Sizes a vector for extents whose last one may be that of its elements.
template <class Element>
void resize(std::vector<Element>& v, const std::vector<std::size_t>& extents) {
  const std::size_t n = std::accumulate(extents.begin(), extents.end(), std::size_t{1}, std::multiplies<>());
  v.resize(n * sizeof(*entries(v)) / sizeof(Element));
}

template <class Element>
bool fits(std::vector<Element>& v, const std::vector<std::size_t>& extents) {
  const std::size_t n = std::accumulate(extents.begin(), extents.end(), std::size_t{1}, std::multiplies<>());
  return v.size() * sizeof(Element) == n * sizeof(*entries(v));
}

fem::SolverCost& predicted_of_used(fem::SolverReport& report) {
  return report.used == fem::Solver::iterative ? report.predicted_iterative : report.predicted_direct;
}

bool is_of_nodes(const std::string& name) {
  return name == "/displacement" || name == "/stress";
}

/// Nodes whose rows are written or read at once.
constexpr std::size_t nodes_at_once = 8192;

/// Rows of all nodes, one piece after another, from the ranks that have them. The others wait for the first
/// one, so that it takes all pieces even where it cannot write them.
/// @param out  null: of another rank, or without a file
void write_shared(Hdf5Writer* out, const std::string& name, const std::vector<double>& rows,
                  const std::vector<std::size_t>& extents, const Hdf5Label& label,
                  const fem::UnitResponses& responses) {
  const std::size_t width = extents[1] * extents[2];
  std::exception_ptr failure;
  const auto write = [&](const auto& part) {
    try {
      if (out != nullptr && !failure) part();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  write([&] { out->make(name, extents, label, Hdf5Compression::deflate); });
  std::vector<double> piece;
  for (std::size_t first = 0; first < extents[0]; first += nodes_at_once) {
    const std::size_t n = std::min(nodes_at_once, extents[0] - first);
    piece.assign(n * width, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      if (responses.has(first + i))
        std::copy_n(&rows[responses.row_of(first + i) * width], width, &piece[i * width]);
    fem::add_on_first(responses.shared->communicator, piece.data(), piece.size());
    write([&] { out->write_rows(name, piece.data(), first, n); });
  }
  if (failure) std::rethrow_exception(failure);
}

/// Hands rows of nodes to the first rank: those of displacement, stress, or of what is left of these.
void hand_over(const fem::UnitResponses& responses, int n_done) {
  const std::size_t n = responses.nodes.n, n_channels = responses.channels.size();
  if (n_done < 1)
    write_shared(nullptr, "/displacement", responses.displacement_m, {n, n_channels, 3}, {}, responses);
  if (n_done < 2) write_shared(nullptr, "/stress", responses.stress_Pa, {n, n_channels, 6}, {}, responses);
}

void read_shared(const Hdf5Reader& in, const std::string& name, std::vector<double>& rows,
                 const std::vector<std::size_t>& extents, const fem::UnitResponses& responses) {
  const std::size_t width = extents[1] * extents[2];
  rows.resize(responses.n_rows() * width);
  std::vector<double> piece;
  for (std::size_t first = 0; first < extents[0]; first += nodes_at_once) {
    const std::size_t n = std::min(nodes_at_once, extents[0] - first);
    piece.resize(n * width);
    in.read_rows(name, piece.data(), first, n);
    for (std::size_t i = 0; i < n; ++i)
      if (responses.has(first + i))
        std::copy_n(&piece[i * width], width, &rows[responses.row_of(first + i) * width]);
  }
}

/// Reads on every rank of those that share the body.
fem::UnitResponses read(const Hdf5Reader& in) {
  fem::UnitResponses r;
  r.channels = in.texts("/channels");
  r.nodes.n = in.shape("/nodes/xyz").at(0);
  const auto shape = shape_of(in.shape("/nodes/cells").at(1));
  r.nodes.kind = shape.kind;
  r.nodes.degree = shape.degree;
  const Counts n = {r.nodes.n,
                    in.shape("/nodes/cells").at(0),
                    in.shape("/nodes/faces").at(0),
                    r.channels.size(),
                    in.shape("/planes").at(0),
                    in.shape("/rings").at(0),
                    in.shape("/nodes/cell_volume_id").at(0),
                    in.shape("/energy/error_of_cells").at(0),
                    in.shape("/energy/norm").at(0),
                    in.shape("/images/node").at(0),
                    in.shape("/images/cell").at(0)};
  visit_arrays(r, n, [&](const char* name, auto& values, const auto& extents, const Hdf5Label&) {
    if (in.shape(name) != extents) throw FileError(std::string(name) + ": unexpected extents");
    if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<double>>) {
      if (name == std::string("/displacement")) r.shared = fem::share_rows(ranks_of_a_body(), r.nodes);
      if (r.shared && is_of_nodes(name)) return read_shared(in, name, values, extents, r);
    }
    resize(values, extents);
    in.read(name, entries(values));
  });
  const auto rings = in.numbers("/rings");
  for (std::size_t i = 0; i < n.rings; ++i)
    r.rings.push_back({rings.at(3 * i), rings.at(3 * i + 1), static_cast<std::int32_t>(rings.at(3 * i + 2))});
  r.support_reaction = in.number_attribute("/", "support_reaction");
  r.residual = in.number_attribute("/", "residual");
  r.n_dofs = static_cast<std::size_t>(in.number_attribute("/", "n_dofs"));
  r.factor_gigabytes = in.number_attribute("/", "factor_gigabytes");
  r.solver.used =
      in.number_attribute("/", "solver_iterations") > 0 ? fem::Solver::iterative : fem::Solver::direct;
  r.solver.n_iterations = int(in.number_attribute("/", "solver_iterations"));
  r.solver.reason = in.text_attribute("/", "solver_reason");
  r.solver.rounding = in.number_attribute("/", "solver_rounding");
  r.solver.used_bytes = in.number_attribute("/", "solver_bytes");
  predicted_of_used(r.solver).bytes = in.number_attribute("/", "solver_bytes_predicted");
  if (!in.has("/ranks")) return r;
  const auto ranks = in.numbers("/ranks");
  for (std::size_t i = 0; i + 2 < ranks.size(); i += 3)
    r.solver.ranks.push_back(
        {static_cast<std::size_t>(ranks[i]), static_cast<std::size_t>(ranks[i + 1]), ranks[i + 2]});
  return r;
}

/// @param n_handed_over  counts the arrays of nodes that other ranks have handed over
void write_file(const std::filesystem::path& path, const std::string& key,
                const fem::UnitResponses& responses, int& n_handed_over) {
  AtomicFile file(path);
  Hdf5Writer out(file.temporary());
  out.attribute("/", "key", key);
  out.attribute("/", "arrangement", arrangement);
  out.attribute("/", "support_reaction", responses.support_reaction);
  out.attribute("/", "residual", responses.residual);
  out.attribute("/", "n_dofs", static_cast<double>(responses.n_dofs));
  out.attribute("/", "factor_gigabytes", responses.factor_gigabytes);
  out.attribute("/", "solver_iterations",
                responses.solver.used == fem::Solver::iterative ? responses.solver.n_iterations : 0);
  out.attribute("/", "solver_reason", responses.solver.reason);
  out.attribute("/", "solver_rounding", responses.solver.rounding);
  out.attribute("/", "solver_bytes", responses.solver.used_bytes);
  out.attribute("/", "solver_bytes_predicted", responses.solver.predicted().bytes);
  out.write("/channels", responses.channels);
  std::vector<double> rings;
  for (const auto& ring : responses.rings)
    rings.insert(rings.end(), {ring.z_m, ring.radius_m, static_cast<double>(ring.boundary_id)});
  std::vector<double> ranks;
  for (const auto& rank : responses.solver.ranks)
    ranks.insert(ranks.end(), {double(rank.n_cells), double(rank.n_unknowns), rank.bytes});
  if (!ranks.empty())
    out.write("/ranks", ranks.data(), {ranks.size() / 3, 3}, {"", "cells, unknowns, bytes of each MPI rank"});
  out.write("/rings", rings.data(), {responses.rings.size(), 3}, {"", "z [m], radius [m], boundary id"});

  const auto& energy = responses.energy_error;
  const Counts n = {responses.nodes.n,
                    responses.nodes.n_cells(),
                    responses.nodes.n_faces(),
                    responses.channels.size(),
                    responses.planes.size(),
                    responses.rings.size(),
                    responses.nodes.cell_volume_id.size(),
                    energy.norm_sqrtJ.empty() ? 0 : energy.of_cells.size() / energy.norm_sqrtJ.size(),
                    energy.norm_sqrtJ.size(),
                    responses.images.node.size(),
                    responses.images.cell.size()};
  // The list is shared with the reader, which fills the arrays; here they are only looked at.
  visit_arrays(
      const_cast<fem::UnitResponses&>(responses), n,
      [&](const char* name, auto& values, const auto& extents, const Hdf5Label& label) {
        if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<double>>)
          if (responses.shared && is_of_nodes(name)) {
            ++n_handed_over;
            return write_shared(&out, name, values, extents, label, responses);
          }
        if (!fits(values, extents))
          throw std::invalid_argument(std::string("unit responses: the size of ") + name +
                                      " does not fit the number of nodes, cells, channels, planes or rings");
        out.write(name, entries(values), extents, label, Hdf5Compression::deflate);
      });
  out.close();
  append_checksum(file.temporary(), key);
  file.commit();
}

/// @throws FileError, std::bad_alloc, std::length_error
std::optional<fem::UnitResponses> read_whole(const std::filesystem::path& path, const std::string& key) {
  const Hdf5Reader in(path);
  if (in.text_attribute("/", "key") != key || in.number_attribute("/", "arrangement") != arrangement)
    return std::nullopt;
  return read(in);
}

}  // namespace

void write_unit_responses(const std::filesystem::path& path, const std::string& key,
                          const fem::UnitResponses& responses) {
  if (responses.shared && !is_first_rank()) return hand_over(responses, 0);
  int n_handed_over = 0;
  try {
    write_file(path, key, responses, n_handed_over);
  } catch (...) {
    if (responses.shared) hand_over(responses, n_handed_over);
    throw;
  }
}

std::optional<fem::UnitResponses> read_unit_responses(const std::filesystem::path& path,
                                                      const std::string& key, const Tell& tell) {
  const auto damaged = [&] {
    if (tell) tell(damaged_file_text(path));
    return std::nullopt;
  };
  const auto state = checked_on_first_rank(path, key);
  if (state == KeptFile::damaged) return damaged();
  if (state != KeptFile::whole) return std::nullopt;
  try {
    std::optional<fem::UnitResponses> responses;
    fem::agree(ranks_of_a_body(), [&] { responses = read_whole(path, key); });
    return responses;
  } catch (const FileError&) {  // whole, but not written by write_unit_responses; or removed meanwhile
    if (!std::filesystem::exists(path)) return std::nullopt;
    return damaged();
  } catch (const fem::FailedTogether&) {  // on one of several ranks
    return damaged();
  } catch (const std::bad_alloc&) {  // more than this machine's memory now holds
    return std::nullopt;
  } catch (const std::length_error&) {
    return damaged();
  }
}

}  // namespace pipelines
