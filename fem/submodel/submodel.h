/// Submodels: the cells around a place solved once more on finer cells, held at their rim by the displacement
/// of the whole body. What stress changes by shows what the mesh of the whole body costs at that place.
#pragma once

#include <cstddef>
#include <vector>

#include "fem/values/body.h"
#include "fem/values/unit_load.h"
#include "fem/values/unit_responses.h"

namespace fem {

/// How much of the body a submodel takes in.
struct SubmodelControl {
  int n_layers = 3;  ///< of cells around the node
  int n_cuts = 1;    ///< how often edges are halved: once makes eight cells of one
};

/// Von Mises stress of a submodel at one instant.
struct SubmodelStress {
  double at_node_Pa = 0;  ///< at the node itself
  double largest_Pa = 0;  ///< on the body's surface within the first layer; at_node_Pa if that is not surface
  std::size_t n_dofs = 0;
};

/// Of the sum of all channels times their factors. Surfaces that carry loads are held like the rim, body
/// forces act; displacement at the rim is that of the whole body, so that what it is wrong by there stays.
/// @param responses  of quadratic tetrahedra
/// @param material   of the body
/// @param loads      one per channel
/// @param node       index into responses.nodes
/// @param factors    one per channel
/// @param left_out   one per node, or empty: cells with such a node are not searched for the largest stress
/// @throws std::invalid_argument if the cells are no tetrahedra, there is no such node, or numbers of loads
///         and factors are not those of the channels
/// @throws SolveFailed as the direct solver
SubmodelStress submodel_stress(const UnitResponses& responses, const Material& material,
                               const std::vector<UnitLoad>& loads, std::size_t node,
                               const std::vector<double>& factors, const std::vector<char>& left_out = {},
                               const SubmodelControl& control = {});

}  // namespace fem
