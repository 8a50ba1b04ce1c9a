/// A scene's only body by harmonics around the axis, for the tests of these runs.
#pragma once

#include <fstream>
#include <string>

#include "pipelines/judge/stages/judge_body.h"
#include "pipelines/loads/stage/load_stage.h"
#include "pipelines/respond/responses/respond.h"
#include "pipelines/search/cheap_models/axisymmetric_body.h"
#include "pipelines/search/cheap_models/axisymmetric_refinement.h"
#include "pipelines/search/loop/search.h"
#include "pipelines/search/models/first_method.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace loaded_shaft {

using namespace pipelines;

/// A plain load table on a concentric shaft; the force at its end bends it most at the first fillet, while
/// the bearing under the thick segment presses.
inline const char* const overhung = R"(
title = "Overhung"
effects = ["pull"]
[machine]
type = "load_table"
speed = "600 rpm"
[[machine.constants]]
effect = "pull"
load = "left.fy"
value = "12 kN"
[sampling]
instants_per_turn = 24
turns = 1
[shaft]
contour = [
  { port = "left",    diameter = "44 mm", length = "18 mm" },
  { name = "thin",    diameter = "44 mm", length = "26 mm" },
  { fillet = "2 mm" },
  { name = "thick",   diameter = "54 mm", length = "70 mm" },
  { port = "b1",      diameter = "54 mm", length = "20 mm" },
  { name = "between", diameter = "54 mm", length = "20 mm" },
  { port = "right",   diameter = "54 mm", length = "20 mm" },
]
bearings = ["b1", "right"]
axial_support = "right"
torque_support = "right"
[shaft.material]
name = "C45"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
)";

inline Scene scene_of(const std::string& text) {
  const results_test::Directory at;
  std::ofstream(at / "scene.toml", std::ios::binary) << text;
  return read_scene(at / "scene.toml");
}

/// A body by its solid mesh as it is.
inline Judged by_solid(const BodyScene& body, const MeshedBody& meshed, const BodyLoads& loads,
                       StageClock& clock) {
  auto superposed = superpose(respond(body, meshed, loads, {1, true}, clock), 1, clock);
  return judge_body(std::move(superposed), meshed, true, 1, clock);
}

/// A scene's only body, described and loaded.
struct LoadedShaft {
  Scene scene;
  StageClock clock;
  Loaded loaded;

  explicit LoadedShaft(Scene given) : scene(std::move(given)) {
    loaded = load_bodies(scene, {describe_revolved(scene.bodies[0])}, clock);
  }
  const BodyScene& body() const { return scene.bodies[0]; }
  Judged axisymmetric(double tolerance = 0) { return searched(Method::axisymmetric, tolerance); }
  Judged beam() { return searched(Method::beam, 0); }
  Judged searched(Method method, double tolerance) {
    RunOfBody run;
    run.options = {1, true};
    run.tolerance = tolerance;
    run.clock = &clock;
    run.load = [this](const Scene& next, std::vector<MeshedBody> meshed) {
      return load_bodies(next, std::move(meshed), clock);
    };
    auto model = model_of(method, run, loaded);
    return search(model, run);
  }
  AxisymmetricStresses stresses(double target) {
    return axisymmetric_stresses(body(), loaded.meshed[0], loaded.body_loads[0], 1, target, 400000);
  }
};

}  // namespace loaded_shaft
