/// How far the stress of tetrahedra is from the stress recovered from it, around one node.
#pragma once

#include <vector>

#include "fem/base/values/body.h"
#include "fem/base/values/unit_responses.h"

namespace fem {

/// Recovered against cells' own stress, at one node and one instant.
struct CellsAgainstRecovered {
  double recovered_Pa = 0;  ///< von Mises stress at the node
  double difference_Pa =
      0;  ///< root mean square over the volume of the cells around: von Mises of the difference
};

/// Over the cells around the node, or around both ends of the edge whose middle it is: those whose samples
/// the node's recovered stress comes from. Interpolates both between their nodes.
/// @param responses  of quadratic tetrahedra
/// @param material   of the body
/// @param node       index into responses.nodes
/// @param factors    one per channel: the load case
/// @throws std::invalid_argument if the cells are no tetrahedra, or none holds the node
CellsAgainstRecovered cells_against_recovered(const UnitResponses& responses, const Material& material,
                                              std::size_t node, const std::vector<double>& factors);

}  // namespace fem
