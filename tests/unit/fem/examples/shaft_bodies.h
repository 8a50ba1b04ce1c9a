/// Shafts of meshes as bodies of fem, and sums of unit responses: what the tests of fem share.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_load.h"
#include "fem/base/values/unit_responses.h"
#include "fem/mesh/grid/grid.h"
#include "fem/models/axisymmetric/meridian_body.h"
#include "meshes/shaft_layout/shaft_geometry.h"
#include "meshes/values/body_mesh.h"

namespace fem_tests {

inline constexpr fem::Material steel{206e9, 0.3, 7850};

struct ShaftBody {
  fem::Body body;
  std::map<std::string, fem::LoadSurface> ports;
  std::map<std::string, int> features;  ///< boundary ids
  std::vector<fem::SectionPlane> planes;
};

/// Forces of displacements of a body of steel, one per column; rows at hanging nodes are zero, and their
/// displacements those of the nodes they hang on.
Eigen::MatrixXd stiffness_times(const fem::Grid& grid, Eigen::MatrixXd displacement);

/// The cells of a mesh as fem takes them.
std::shared_ptr<const fem::CoarseMesh> cells_of(const meshes::BodyMesh& mesh);

/// A mesh with its surfaces, of steel.
fem::Body steel_body(const meshes::BodyMesh& mesh);

/// Meshes the shaft.
ShaftBody build(const meshes::Shaft& shaft, const meshes::ShaftMeshControl& control);

/// The shaft's half section, with the boundary ids of build().
fem::MeridianBody half_section(const meshes::Shaft& shaft, const meshes::ShaftMeshControl& control);

/// Rod of diameter 50 mm and length 200 mm from z = 0: ports end_1, end_2, and its whole surface "rod".
ShaftBody rod(int n_sectors = 16);

/// Small stepped shaft with an eccentric seat (offset 2 mm along x) between two bearing seats.
meshes::Shaft small_eccentric_shaft();
ShaftBody eccentric_shaft(int cells_per_fillet_quarter = 4);

/// Its own mirror image about z = 0: a seat in two parts between the ports bearing_1 and bearing_2, with
/// faces of cells in its middle.
ShaftBody mirrored_shaft();

/// Cut locally: cycles of a share of the cells each, at random.
fem::Body refined_at_random(fem::Body body, int n_cycles, double share, unsigned seed);

/// One unit load named "<port>.<component>".
fem::UnitLoad resultant(const ShaftBody& body, const std::string& port,
                        fem::SurfaceResultant::Component component);

/// Tensor (xx, yy, zz, xy, yz, xz) at a node in the load case: sum of factor times channel.
using LoadCase = std::vector<std::pair<std::string, double>>;
std::array<double, 6> stress(const fem::UnitResponses& responses, const LoadCase& sum, std::size_t node);

/// Of some channels the largest difference of two fields' entries over the largest entry of the second.
/// @param a, b  n_nodes x n_channels x n_components
double difference(const std::vector<double>& a, const std::vector<double>& b,
                  const std::vector<std::size_t>& channels, std::size_t n_channels, std::size_t n_components);

/// Resultant, rim shear, rigid motion of one plane in the load case.
fem::SectionResponse section(const fem::UnitResponses& responses, const LoadCase& sum, std::size_t plane);

}  // namespace fem_tests
