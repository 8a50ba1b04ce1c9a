#include "pipelines/search/models/beam_model.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "fem/models/beam/beam_responses.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/loads/channels/closure.h"
#include "pipelines/scene/reader/why_not.h"
#include "pipelines/search/cheap_models/cheap_responses.h"

namespace pipelines {
namespace {

/// The beam's cylinders have no fillets, so that its body forces carry a little less than the masses that the
/// loads were made with; balancing takes the difference away again. What is stated are those masses.
void take_resultants(const std::vector<fem::UnitLoad>& loads, const std::vector<RegionMass>& regions,
                     fem::UnitResponses& responses) {
  for (std::size_t k = 0; k < loads.size(); ++k)
    if (std::holds_alternative<fem::BodyForce>(loads[k].shape))
      responses.resultants[k] = wanted_resultant(loads[k], regions);
}

/// Adds a node on the axis for every circle of nodes, with the circle's mean, and the cells between axis and
/// surface, all of degree 1.
fem::UnitResponses with_axis(fem::UnitResponses r, int n_angles) {
  const std::size_t n = std::size_t(n_angles), n_surface = r.nodes.n, n_circles = n_surface / n;
  const auto append_means = [&](std::vector<double>& values, std::size_t width) {
    for (std::size_t circle = 0; circle < n_circles; ++circle) {
      std::vector<double> mean(width, 0);
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < width; ++i) mean[i] += values[(circle * n + j) * width + i] / double(n);
      values.insert(values.end(), mean.begin(), mean.end());
    }
  };
  append_means(r.nodes.xyz_m, 3);
  append_means(r.displacement_m, 3 * r.channels.size());
  append_means(r.stress_Pa, 6 * r.channels.size());
  auto& nodes = r.nodes;
  nodes.n += n_circles;
  nodes.volume_m3.assign(nodes.n, 0);
  const auto axis = [&](std::int32_t node) { return std::int32_t(n_surface + std::size_t(node) / n); };
  // A face of nine nodes: corners, edges, centre; each quarter has two nodes on one circle, two on the next.
  const std::array<std::array<std::size_t, 4>, 4> quarters{
      {{0, 4, 8, 7}, {4, 1, 5, 8}, {7, 8, 6, 3}, {8, 5, 2, 6}}};
  std::vector<std::int32_t> faces, ids;
  for (std::size_t f = 0; f < nodes.n_faces(); ++f)
    for (const auto& quarter : quarters) {
      std::array<std::int32_t, 4> q;
      for (std::size_t i = 0; i < 4; ++i) q[i] = nodes.face(f)[quarter[i]];
      faces.insert(faces.end(), q.begin(), q.end());
      ids.push_back(nodes.face_boundary_id[f]);
      const auto a = axis(q[0]), b = axis(q[3]);
      nodes.cells.insert(nodes.cells.end(), {a, b, q[3], q[0], a, b, q[2], q[1]});
      nodes.cell_volume_id.push_back(0);
    }
  nodes.degree = 1;
  nodes.faces = std::move(faces);
  nodes.face_boundary_id = std::move(ids);
  return r;
}

}  // namespace

Judged BeamModel::solve() {
  if (const auto why = why_not_beam(body()); !why.empty())
    throw StageRefused("the " + body().name + " " + why + ": no beam");
  const RunTime time;
  MeshedBody own = meshed();
  own.mesh.sections.clear();
  auto responses = clock().run("solve", [&] {
    auto surface = beam_responses(body(), own.mesh, body_loads().unit_loads).value();
    take_resultants(body_loads().unit_loads, own.regions, surface);
    return with_axis(std::move(surface), fem::BeamShaft().n_angles);
  });
  seconds_ = time.seconds();
  auto by_beam = responded(body(), own, body_loads(), std::move(responses));
  by_beam.method = Method::beam;
  by_beam.solve_s = seconds_;
  return judged(std::move(by_beam), own);
}

void BeamModel::judge(Judged& solved) {
  for (const auto& entry :
       beam_model_entries(*beam_shaft(body(), meshed().mesh), solved.loads, solved.responses.nodes,
                          solved.envelope.von_mises.value_Pa, solved.places.excluded, solved.peak.value_Pa))
    solved.peak.errors.set_model(entry);
}

Finer BeamModel::finer(const Judged& judged, const Search& search) {
  auto scene = better_loads_.next(loaded_.scene, run_.index, judged, run_.tolerance);
  if (!scene)
    return {nullptr, search.met ? "the tolerance is met"
                                : "a beam has no mesh to refine (method \"auto\" takes a finer model)"};
  auto better = std::make_unique<BeamModel>(*this);
  better->loaded_ = loaded_with(*scene, MeshedBody(meshed()));
  return {std::move(better), "", seconds_};
}

Judged BeamModel::again(Judged& before) {
  auto after = solve();
  judge(after);
  after.search = std::move(before.search);
  return after;
}

}  // namespace pipelines
