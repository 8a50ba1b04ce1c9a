/// Submodels: the cells around a place solved once more on finer cells, held at their rim by the displacement
/// of the whole body. What stress changes by shows what the mesh of the whole body costs at that place.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_load.h"
#include "fem/base/values/unit_responses.h"

namespace fem {

/// What a submodel does where the body is loaded. Springs and clamps hold it in any case.
enum class LoadedFaces {
  held,    ///< at the displacement of the whole body: the stress there stays that of its mesh
  loaded,  ///< by the traction of the loads
};

/// How much of the body a submodel takes in.
struct SubmodelControl {
  int n_layers = 3;  ///< of cells around the nodes
  int n_cuts = 1;    ///< how often edges are halved: once makes eight cells of one
  LoadedFaces loaded_faces = LoadedFaces::held;
};

/// Whether no stress is looked for at a place of the surface: position [m], boundary group.
using LeftOut = std::function<bool(const std::array<double, 3>&, int)>;

/// A node whose stress counts, and how much.
struct WeightedNode {
  std::size_t node = 0;  ///< index into the responses' nodes
  double weight = 1;
};

/// Von Mises stress of a submodel at one instant.
struct SubmodelStress {
  double at_point_Pa = 0;  ///< of the weighted sum of the nodes' stress
  double largest_Pa = 0;  ///< on the body's surface in the cells that hold one of the nodes, and at the point
  std::size_t n_dofs = 0;
};

/// Solves a submodel for the sum of all channels times their factors. Surfaces that carry springs or clamps
/// are held like the rim, those that carry loads as the control says; body forces act. What the displacement
/// of the whole body is wrong by at the rim stays.
/// @param responses  of cells of degree 2, not refined locally: faces between large and small cells would be
///                   held like the rim
/// @param body       its charts serve the recovery, its mesh is not read
/// @param loads      one per channel
/// @param point      one node, or several whose weighted sum counts
/// @param factors    one per channel
/// @param left_out   places where the largest stress is not looked for, as beside sharp edges; null: none
/// @throws std::invalid_argument if the cells are of another degree, there is no such node, or numbers of
/// loads and factors are not those of the channels
/// @throws SolveFailed as the direct solver
SubmodelStress submodel_stress(const UnitResponses& responses, const Body& body,
                               const std::vector<UnitLoad>& loads, const std::vector<WeightedNode>& point,
                               const std::vector<double>& factors, const LeftOut& left_out = {},
                               const SubmodelControl& control = {});

/// Whether a node of the point lies on a surface with a load, a spring or a clamp. Where a submodel holds it,
/// the displacement of the whole body decides the stress there, and nothing is learnt.
bool is_on_load(const UnitResponses& responses, const Body& body, const std::vector<UnitLoad>& loads,
                const std::vector<WeightedNode>& point);

/// Whether one of the cells that hold the point has a face with a spring or a clamp, which every submodel
/// holds.
bool is_beside_support(const UnitResponses& responses, const Body& body,
                       const std::vector<WeightedNode>& point);

/// Stress of every unit load, (xx, yy, zz, xy, yz, xz) [Pa], summed over the nodes of the point.
/// @throws as submodel_stress
std::vector<std::array<double, 6>> submodel_unit_stress_Pa(const UnitResponses& responses, const Body& body,
                                                           const std::vector<UnitLoad>& loads,
                                                           const std::vector<WeightedNode>& point,
                                                           const SubmodelControl& control = {});

}  // namespace fem
