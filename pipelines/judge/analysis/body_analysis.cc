#include "pipelines/judge/analysis/body_analysis.h"

namespace pipelines {

BodyAnalysis::BodyAnalysis() = default;
BodyAnalysis::BodyAnalysis(const BodyAnalysis&) = default;
BodyAnalysis::BodyAnalysis(BodyAnalysis&&) noexcept = default;
BodyAnalysis& BodyAnalysis::operator=(const BodyAnalysis&) = default;
BodyAnalysis& BodyAnalysis::operator=(BodyAnalysis&&) noexcept = default;
BodyAnalysis::~BodyAnalysis() = default;

}  // namespace pipelines
