/// The search of a run: from model to finer model, until a body's governing stress is known well enough.
#pragma once

#include <memory>

#include "pipelines/search/models/body_model.h"

namespace pipelines {

/// Solves, superposes and judges a model of a body, and the finer ones that it names, until the tolerance is
/// met, the time is up or nothing becomes finer. Judged::search says which models were tried, and why
/// no other one was.
/// @param model  the first one; afterwards the one that the result is of
/// @throws what the first model throws, and of finer ones what is neither a lack of time nor of memory
Judged search(std::unique_ptr<BodyModel>& model, const RunOfBody& run);

}  // namespace pipelines
