#include "kinetics/torsion_chain/reduced.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kinetics/torsion_chain/checks.h"
#include "kinetics/values/constants.h"
#include "kinetics/values/machine_refused.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics::torsion {
namespace {

/// Sets of vertices that are already connected.
class Pieces {
public:
  explicit Pieces(std::size_t n) : leader_(n) { std::iota(leader_.begin(), leader_.end(), Index{0}); }
  Index leader(Index i) const {
    while (leader_[i] != i) i = leader_[i];
    return i;
  }
  /// False if both already are in one piece.
  bool join(Index a, Index b) {
    const Index from = leader(a), to = leader(b);
    leader_[std::max(from, to)] = std::min(from, to);
    return from != to;
  }

private:
  std::vector<Index> leader_;
};

std::vector<Edge> links_of(const DriveTrain& train) {
  std::vector<Edge> links;
  for (const TrainElement& e : train.elements)
    links.push_back(
        {inertia_at(train, e.first, e.name + ".first"), inertia_at(train, e.second, e.name + ".second")});
  return links;
}

void require_tree(const DriveTrain& train, const std::vector<Edge>& links) {
  Pieces pieces(train.inertias.size());
  for (std::size_t e = 0; e < links.size(); ++e)
    if (!pieces.join(links[e].first, links[e].second))
      throw MachineRefused("element " + train.elements[e].name + ": closes a cycle between " +
                           train.elements[e].first + " and " + train.elements[e].second +
                           "; a train is a tree, take one element of the cycle out");
  for (std::size_t i = 1; i < train.inertias.size(); ++i)
    if (pieces.leader(static_cast<Index>(i)) != 0)
      throw MachineRefused("inertia " + train.inertias[i].name + ": no elements connect it with " +
                           train.inertias[0].name +
                           "; these are two trains, connect them or compute each by itself");
}

/// u per inertia; every inertia of a shaft line must come out at the same.
Eigen::ArrayXd ratios(const DriveTrain& train, const std::vector<Edge>& links) {
  const auto on_reference = [&](const TrainInertia& i) { return i.shaft == train.reference_shaft; };
  const auto reference = std::find_if(train.inertias.begin(), train.inertias.end(), on_reference);
  if (reference == train.inertias.end())
    throw MachineRefused("reference_shaft = \"" + train.reference_shaft +
                         "\": no inertia sits on a shaft line of that name; give one of theirs");
  const Index n = static_cast<Index>(train.inertias.size()), root = reference - train.inertias.begin();
  Eigen::ArrayXd u = Eigen::ArrayXd::Ones(n);
  for (const Step& step : walk(n, links, root)) {
    const double ratio = train.elements[step.edge].ratio;
    u[step.child] = step.sense > 0 ? u[step.parent] * ratio : u[step.parent] / ratio;
  }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < i; ++j)
      if (train.inertias[i].shaft == train.inertias[j].shaft && std::abs(u[i] / u[j] - 1) > 1e-12)
        refuse("ratio of " + train.inertias[i].name + " to the reference shaft", u[i],
               train.inertias[j].name + " on the same shaft line \"" + train.inertias[i].shaft + "\" has " +
                   number(u[j]) + "; correct the ratios between them, or name two shaft lines");
  return u;
}

}  // namespace

std::vector<Step> walk(Index n_vertices, const std::vector<Edge>& edges, Index root) {
  std::vector<std::vector<Index>> at(n_vertices);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    at[edges[e].first].push_back(static_cast<Index>(e));
    at[edges[e].second].push_back(static_cast<Index>(e));
  }
  std::vector<Step> steps;
  std::vector<bool> seen(n_vertices, false);
  std::vector<Index> open{root};
  seen[root] = true;
  while (!open.empty()) {
    const Index vertex = open.back();
    open.pop_back();
    for (const Index e : at[vertex]) {
      const bool forward = edges[e].first == vertex;
      const Index next = forward ? edges[e].second : edges[e].first;
      if (seen[next]) continue;
      seen[next] = true;
      steps.push_back({vertex, next, e, forward ? 1.0 : -1.0});
      open.push_back(next);
    }
  }
  return steps;
}

double stiffness_N_m_rad(const TrainElement& e) {
  if (e.stiffness_N_m_rad) return *e.stiffness_N_m_rad;
  const double I_p_m4 = pi / 32 * (std::pow(e.diameter_m, 4) - std::pow(e.bore_m, 4));
  return e.shear_modulus_Pa * I_p_m4 / e.length_m;
}

ReducedTrain reduce(const DriveTrain& train) {
  check_parameters(train);
  ReducedTrain reduced;
  reduced.links = links_of(train);
  require_tree(train, reduced.links);
  reduced.ratio = ratios(train, reduced.links);

  const Index n = static_cast<Index>(train.inertias.size()), m = static_cast<Index>(train.elements.size());
  Pieces rigid(train.inertias.size());
  for (Index e = 0; e < m; ++e)
    if (train.elements[e].rigid) rigid.join(reduced.links[e].first, reduced.links[e].second);
  Index n_nodes = 0;
  reduced.node_of.resize(n);
  for (Index i = 0; i < n; ++i)
    reduced.node_of[i] = rigid.leader(i) == i ? n_nodes++ : reduced.node_of[rigid.leader(i)];

  reduced.inertia = reduced.damping = Eigen::ArrayXd::Zero(n_nodes);
  for (Index i = 0; i < n; ++i) {
    const double u2 = reduced.ratio[i] * reduced.ratio[i];
    reduced.inertia[reduced.node_of[i]] += train.inertias[i].inertia_kg_m2 * u2;
    reduced.damping[reduced.node_of[i]] += train.inertias[i].damping_N_m_s * u2;
    if (!train.inertias[i].held) continue;
    reduced.held = reduced.node_of[i];
    reduced.base = i;
  }

  for (Index i = 0; i < n; ++i)
    if (!(reduced.inertia[reduced.node_of[i]] > 0))
      refuse(train.inertias[i].name + ".inertia", train.inertias[i].inertia_kg_m2,
             "must be positive where no rigid element joins it to an inertia: write 1e-12, which vibrates so "
             "fast by itself that nothing else feels it");

  reduced.link_ratio.resize(m);
  reduced.stiffness = reduced.edge_damping = reduced.loss_factor = Eigen::ArrayXd::Zero(n_nodes - 1);
  for (Index e = 0; e < m; ++e) {
    const TrainElement& element = train.elements[e];
    const auto [first, second] = reduced.links[e];
    reduced.link_ratio[e] = reduced.ratio[first];
    if (element.rigid) continue;
    const bool on_second =
        element.kind != ElementKind::shaft && element.stiffness_on == train.inertias[second].shaft;
    const double u = reduced.ratio[on_second ? second : first];
    const Index k = static_cast<Index>(reduced.edges.size());
    reduced.edges.push_back({reduced.node_of[first], reduced.node_of[second]});
    reduced.element_of.push_back(e);
    reduced.stiffness[k] = stiffness_N_m_rad(element) * u * u;
    reduced.edge_damping[k] = element.damping_N_m_s * u * u;
    reduced.loss_factor[k] = element.loss_factor;
  }
  return reduced;
}

}  // namespace kinetics::torsion
