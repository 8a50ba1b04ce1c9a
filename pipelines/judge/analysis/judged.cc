#include "pipelines/judge/analysis/judged.h"

#include <utility>

namespace pipelines {

Judged::Judged() = default;
Judged::Judged(Superposed superposed) : Superposed(std::move(superposed)) {}
Judged::Judged(const Judged&) = default;
Judged::Judged(Judged&&) noexcept = default;
Judged& Judged::operator=(const Judged&) = default;
Judged& Judged::operator=(Judged&&) noexcept = default;
Judged::~Judged() = default;

}  // namespace pipelines
