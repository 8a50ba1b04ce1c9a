/// What `check` finds out about a scene, for its table and its JSON.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/loads/stage/machine_masses.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/study/accuracy/cost_forecast.h"
#include "pipelines/study/effects/body_effect_report.h"

namespace pipelines {

struct CheckedPort {
  std::string name;
  std::string where;  ///< "z -30.00 .. 30.00 mm, diameter 60.00 mm, axis at (4.00, 0.00) mm"
};

struct CheckedBody {
  std::string name;
  const MeshedBody* meshed = nullptr;
  std::vector<MassFigure> masses;  ///< masses of the machine beside those of mesh and added masses
  std::vector<CheckedPort> ports;
  bool ports_are_known = true;  ///< a mesh alone finds those of a STEP file, and the loads that enter there
  std::vector<ModelForecast> forecast;
  std::vector<EffectSize> effects;
  std::string instants;               ///< how many know the crests of every channel; empty: not to be told
  std::vector<std::string> channels;  ///< "shaft/volume.ax [m/s2]"
};

struct CheckReport {
  Scene scene;  ///< with the effects that are chosen
  std::vector<MeshedBody> meshed;
  std::vector<CheckedBody> bodies;
  std::vector<std::string> warnings;  ///< warnings of the loads; the scene has its own
  std::vector<std::string> blocks;    ///< "heavy: 25 % of the time"
  std::optional<RunForecast> run;     ///< none without bodies
};

/// First that the scene is valid and what a run takes; then bodies, effects, ports, blocks, warnings.
/// @param all  also descriptions, defaults, masses, forecasts of all models, sizes of effects, channels
void print_check(std::ostream& out, const CheckReport& report, bool all);

/// The whole report as JSON.
std::string check_json(const CheckReport& report);

}  // namespace pipelines
