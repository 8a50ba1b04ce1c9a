/// One body of a living page.
#pragma once

#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/write/living/effect_toggles.h"
#include "pipelines/write/living/packed_block.h"

namespace pipelines {

/// What of a cycle a page shows: all its instants, or of long ones the turns around the largest stress.
struct ShownInstants {
  std::vector<Eigen::Index> instants;  ///< columns of the load history
  bool is_all = true;
};

/// Rows of a series or table at the instants.
Eigen::ArrayXXd at(const ShownInstants& shown, const Eigen::ArrayXXd& values);

/// Nodes whose unit fields are needed: brought to the first rank where several share the body.
void bring_page_rows(const Judged& analysis);

/// Adds the body's sections to the block, under names that begin with the body's.
/// @param index  of the body in the scene
/// @return its keys
summary::Json living_body(const Judged& analysis, std::size_t index, const FactorSignals& signals,
                          const std::vector<EffectToggle>& toggles, const ShownInstants& shown,
                          PackedBlock& block);

}  // namespace pipelines
