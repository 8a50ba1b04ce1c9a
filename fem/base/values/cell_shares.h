/// How the cells of a body are shared among ranks. No deal.II.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "fem/base/values/unit_responses.h"

namespace fem {

/// The share, 0 .. n_shares - 1, of each cell: shares of equal number, cut across the longest extent of the
/// body. The ranks share them alike.
std::vector<int> shares_of_cells(const Nodes& nodes, int n_shares);

/// Rows for responses that the ranks read, by these shares; null on one rank.
std::shared_ptr<SharedRows> share_rows(MPI_Comm communicator, const Nodes& nodes);

}  // namespace fem
