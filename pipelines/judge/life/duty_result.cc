#include "pipelines/judge/life/duty_result.h"

#include <cmath>

namespace pipelines {
namespace {

/// Lives of parts of the time add by their shares: 1 / L = sum q_i / L_i (Palmgren 1924; ISO 281, 8).
class LifeSum {
public:
  void add(double share, double life_h) { per_h_ += share / life_h; }
  std::optional<double> life_h() const { return per_h_ > 0 ? std::optional(1 / per_h_) : std::nullopt; }

private:
  double per_h_ = 0;
};

}  // namespace

std::vector<DutyBearing> bearings_over_blocks(const std::vector<BlockResult>& blocks,
                                              const std::vector<BearingScene>& bearings) {
  double in_operation = 0;
  for (const auto& block : blocks) in_operation += block.share;
  std::vector<DutyBearing> result;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const double exponent = kinetics::life_exponent(bearings[i].element);
    LifeSum life, modified;
    double turns = 0, weighted = 0;
    for (const auto& block : blocks) {
      const auto& own = block.bearings[i];
      const double share = block.share / in_operation;
      turns += share * own.speed_rad_s;
      weighted += share * own.speed_rad_s * std::pow(own.equivalent_load_N, exponent);
      if (own.life) life.add(share, own.life->hours);
      if (own.answers.modified_life_h) modified.add(share, *own.answers.modified_life_h);
    }
    DutyBearing bearing{bearings[i].name, 0, life.life_h(), modified.life_h()};
    if (turns > 0) bearing.equivalent_load_N = std::pow(weighted / turns, 1 / exponent);
    result.push_back(std::move(bearing));
  }
  return result;
}

}  // namespace pipelines
