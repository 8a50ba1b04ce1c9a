#include <algorithm>
#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/scene/machines/kinds.h"
#include "pipelines/scene/machines/load_table_reader.h"
#include "pipelines/scene/reader/scene_effects.h"
#include "pipelines/scene/whole/plausibility.h"

namespace pipelines {
namespace {

const kinetics::LoadTable& table_in(const Machine& machine) {
  return std::get<kinetics::LoadTable>(machine);
}

/// Highest order of the harmonics of these effects; 0: there are none.
double highest_order(const kinetics::LoadTable& table, const std::vector<std::string>& effects) {
  double highest = 0;
  for (const auto& load : table.loads)
    if (const auto* harmonic = std::get_if<kinetics::HarmonicCourse>(&load.course);
        harmonic != nullptr && harmonic->amplitude != 0 && contains(effects, load.effect))
      highest = std::max(highest, harmonic->order);
  return highest;
}

/// Angles of denser instants, a multiple of the grid's and these among them, where the highest order has
/// three instants per period or fewer: by three a spectrum cannot tell that there is nothing above. None
/// where there would be too many.
Eigen::ArrayXd denser_instants(const kinetics::LoadTable& table, const std::vector<std::string>& effects,
                               const kinetics::TimeGrid& grid) {
  constexpr double few = 3, wanted = 24, most = 4096;
  const double per_period = grid.instants_per_turn / highest_order(table, effects);
  if (!(per_period <= few * (1 + 1e-9))) return {};
  const double times = std::ceil(wanted / per_period);
  const double n = times * grid.turns * grid.instants_per_turn;
  if (n > most) return {};
  return Eigen::ArrayXd::LinSpaced(Eigen::Index(n), 0, n - 1) * (2 * pi / (times * grid.instants_per_turn));
}

class LoadTableKind : public MachineKind {
public:
  std::string type() const override { return "load_table"; }

  void read(SceneReading& reading) const override {
    auto& [root, machine, scene, findings, bodies] = reading;
    auto table =
        read_load_table(machine, scene.file.parent_path(), root.whole_at("sampling", "turns"), findings);
    root.know("effects");
    if (!table.loads.empty()) read_effects(root, {kinetics::load_table_effects(table)}, scene, findings);
    scene.machine = std::move(table);
  }
  /// A turn, or those of a file whose turns are taken as they are.
  Period period(const Scene& scene, int, bool) const override {
    return {true, table_in(scene.machine).turns};
  }
  void doubt(const Scene& scene, Doubts& doubts) const override {
    doubts.speed("machine", table_in(scene.machine).speed_rad_s);
  }
  std::vector<kinetics::EffectInfo> effects(const Machine& machine) const override {
    return kinetics::load_table_effects(table_in(machine));
  }
  int instants_of_orders(const Machine& machine) const override {
    constexpr double in_a_period = 4, of_a_kind = 12, most = 100'000;
    std::vector<std::string> all;
    for (const auto& effect : kinetics::load_table_effects(table_in(machine))) all.push_back(effect.name);
    const double instants =
        of_a_kind * std::ceil(in_a_period * highest_order(table_in(machine), all) / of_a_kind);
    return instants <= most ? int(instants) : 0;
  }
  bool has_samples() const override { return true; }
  std::vector<kinetics::ResamplingError> resampling_errors(const Machine& machine,
                                                           const kinetics::TimeGrid& grid) const override {
    return kinetics::resampling_errors(table_in(machine), grid);
  }
  std::optional<kinetics::LoadHistory> loads_passed_over(const Scene& scene,
                                                         const Machine& machine) const override {
    const auto& table = table_in(machine);
    const auto effects = scene.kinetics_effects();
    const auto course_rad = kinetics::course_of_rough_samples(table, effects, scene.sampling);
    if (course_rad.size() > 0) return kinetics::loads_at(table, effects, scene.sampling, course_rad);
    const auto phi_rad = kinetics::samples_passed_over(table, effects, scene.sampling);
    const auto denser_rad = phi_rad.size() > 0 ? phi_rad : denser_instants(table, effects, scene.sampling);
    if (denser_rad.size() == 0) return std::nullopt;
    auto between = kinetics::loads_at(table, effects, scene.sampling, denser_rad);
    if (phi_rad.size() > 0) between.warnings = kinetics::warnings_of_cycles(table, effects, scene.sampling);
    return between;
  }
  bool is_headline(const std::string&) const override { return true; }
};

}  // namespace

const MachineKind& load_table_kind() {
  static const LoadTableKind kind;
  return kind;
}

}  // namespace pipelines
