#include "pipelines/write/files/stress_histories.h"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/disk/cache.h"
#include "pipelines/base/files/hdf5_file.h"
#include "pipelines/base/files/json_file.h"
#include "pipelines/base/files/kept_file.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/respond/responses/response_files.h"
#include "pipelines/superpose/envelope/superposition.h"
#include "pipelines/write/exports/vtk_files.h"
#include "pipelines/write/files/envelope_files.h"
#include "pipelines/write/files/result_names.h"
#include "pipelines/write/files/run_record.h"

namespace pipelines {
namespace {

using Eigen::Index;
using nlohmann::ordered_json;

/// Relative agreement of what the run states and what its files give: both are sums of the same terms in
/// another order.
constexpr double agreement = 1e-9;

/// A body of the run, with what its stress is superposed from.
struct RunBody {
  std::string name;
  const ordered_json& summary;
  fem::UnitResponses responses;
  ChannelHistory channels;
  std::vector<std::int32_t> left_out{};  ///< by node, 0: not; empty: none is, or it is not known

  bool is_left_out(std::size_t node) const { return node < left_out.size() && left_out[node] != 0; }
};

std::array<double, 3> position_of(const ordered_json& place) {
  return place.at("position_m").get<std::array<double, 3>>();
}

struct NearestNode {
  std::size_t node = 0;
  double distance_m = 0;
};

NearestNode nearest_node(const fem::Nodes& nodes, const std::array<double, 3>& position_m) {
  const Eigen::Map<const Eigen::Matrix3Xd> all(nodes.xyz_m.data(), 3, Index(nodes.n));
  Index node = 0;
  const double squared = (all.colwise() - Eigen::Map<const Eigen::Vector3d>(position_m.data()))
                             .colwise()
                             .squaredNorm()
                             .minCoeff(&node);
  return {std::size_t(node), std::sqrt(squared)};
}

/// The longest distance from a node to another one of its cells: how far from the nearest node a place inside
/// the body can be.
double cell_size_m(const fem::Nodes& nodes, std::size_t node) {
  const auto position = [&](std::size_t i) { return Eigen::Vector3d(&nodes.xyz_m[3 * i]); };
  double size_m = 0;
  for (std::size_t c = 0; c < nodes.n_cells(); ++c) {
    const auto cell = nodes.cell(c);
    if (std::find(cell.begin(), cell.end(), std::int32_t(node)) == cell.end()) continue;
    for (const auto i : cell) size_m = std::max(size_m, (position(std::size_t(i)) - position(node)).norm());
  }
  return size_m;
}

/// The node that is at a place of the run, to the digits of its summary.
std::size_t node_at(const RunBody& body, const std::array<double, 3>& position_m) {
  const auto nearest = nearest_node(body.responses.nodes, position_m);
  if (nearest.distance_m > 1e-9)
    throw FileError(fmt::format(
        "{}: among the kept unit responses no node is at ({:.6g}, {:.6g}, {:.6g}) m, where the "
        "run's summary.json has a place: the kept ones are of another run; run the scene with --fresh",
        body.name, position_m[0], position_m[1], position_m[2]));
  return nearest.node;
}

/// Whether the place is a weld toe; its stress is not in the unit responses where it was solved as a
/// submodel.
bool has_parts(const ordered_json& place) {
  return place.contains("extrapolated_from") && !place["extrapolated_from"].is_null();
}

HistoryPoint point_at(const RunBody& body, const std::string& name, const ordered_json& place,
                      const char* stress_key) {
  HistoryPoint point{body.name,          name, place.value("feature", ""),
                     position_of(place), {},   place.at(stress_key)};
  if (has_parts(place))
    for (const auto& part : place["extrapolated_from"])
      point.parts.push_back({node_at(body, position_of(part)), part.at("weight")});
  else
    point.parts.push_back({node_at(body, point.position_m), 1});
  return point;
}

HistoryPoint point_at_zone(const RunBody& body, std::size_t i) {
  return point_at(body, fmt::format("zone {}", i + 1), body.summary["zones"][i], "peak_von_mises_Pa");
}

const char* const without_history =
    "its stress comes from a submodel, whose responses a run does not keep; with a tolerance, as --tolerance "
    "\"5 %\", toes are refined in the mesh and have histories";

ordered_json list_of(const RunBody& body, const char* key) {
  return body.summary.contains(key) ? body.summary[key] : ordered_json::array();
}

void add_all(const RunBody& body, StressHistories& histories, std::vector<HistoryPoint>& points) {
  for (std::size_t i = 0; i < list_of(body, "zones").size(); ++i) points.push_back(point_at_zone(body, i));
  for (const auto& spot : list_of(body, "hot_spots")) {
    const std::string name = spot.at("name");
    if (has_parts(spot))
      points.push_back(point_at(body, name, spot, "von_mises_Pa"));
    else
      histories.left_out.push_back(body.name + "/" + name + ": " + without_history);
  }
}

bool has_hot_spot(const RunBody& body, const std::string& name) {
  const auto spots = list_of(body, "hot_spots");
  return std::any_of(spots.begin(), spots.end(), [&](const auto& spot) { return spot.at("name") == name; });
}

/// Names of surfaces, ports and weld toes that have a history.
std::vector<std::string> place_names_of(const RunBody& body) {
  std::vector<std::string> names;
  for (const auto& spot : list_of(body, "hot_spots"))
    if (has_parts(spot)) names.push_back(spot.at("name"));
  for (const auto& place : list_of(body, "places"))
    if (!has_hot_spot(body, place.at("feature"))) names.push_back(place.at("feature"));
  return names;
}

/// The points of a body that are like a text, or some of them: a chamber has dozens of toes.
std::string names_like(const RunBody& body, const std::string& what) {
  constexpr std::size_t most = 4;
  const auto places = place_names_of(body);
  std::vector<std::string> names;
  if (const auto nearest = nearest_name(what, places); !nearest.empty()) names.push_back(nearest);
  for (const auto& name : places)
    if (!what.empty() && name.find(what) != std::string::npos && !contains(names, name))
      names.push_back(name);
  for (const auto& name : places)
    if (names.size() < most && !contains(names, name)) names.push_back(name);
  names.resize(std::min(most, names.size()));
  const auto n_zones = list_of(body, "zones").size();
  std::string text = n_zones > 0 ? fmt::format("zone 1 to {}, ", n_zones) : "";
  for (const auto& name : names) text += "\"" + name + "\", ";
  if (places.size() > names.size()) text += fmt::format("{} more names, ", places.size() - names.size());
  return text + fmt::format("node 0 to {}, x, y, z mm", body.responses.nodes.n - 1);
}

/// What a text means in one body: a point, or why there is none; neither: it is no point of the body.
struct FoundPoint {
  std::optional<HistoryPoint> point;
  std::string why_not;

  FoundPoint() = default;
  FoundPoint(HistoryPoint found) : point(std::move(found)) {}
};

FoundPoint refused_point(std::string why_not) {
  FoundPoint found;
  found.why_not = std::move(why_not);
  return found;
}

/// The node that is nearest to a place in or beside the body.
FoundPoint point_near(const RunBody& body, const std::string& what, const std::array<double, 3>& wanted_m) {
  const auto& nodes = body.responses.nodes;
  const auto nearest = nearest_node(nodes, wanted_m);
  const double cell_m = cell_size_m(nodes, nearest.node);
  if (nearest.distance_m > cell_m)
    return refused_point(
        fmt::format("is {:.4g} mm from the nearest node of the {}, whose cells are {:.3g} mm "
                    "long there: write a place in the body, in its frame",
                    1e3 * nearest.distance_m, body.name, 1e3 * cell_m));
  const double* x = &nodes.xyz_m[3 * nearest.node];
  HistoryPoint point{body.name, what, "", {x[0], x[1], x[2]}, {{nearest.node, 1}}, 0};
  point.distance_m = nearest.distance_m;
  point.is_left_out = body.is_left_out(nearest.node);
  return point;
}

FoundPoint find_point(const RunBody& body, const std::string& what) {
  static const std::regex zone("zone ([0-9]{1,6})"), node("node ([0-9]{1,10})"),
      position(R"(\(?\s*([-+0-9.eE]+)\s*,\s*([-+0-9.eE]+)\s*,\s*([-+0-9.eE]+)\s*\)?\s*mm)");
  std::smatch match;
  if (std::regex_match(what, match, zone)) {
    const auto number = std::stoul(match[1]);
    if (number == 0 || number > list_of(body, "zones").size()) return {};
    return point_at_zone(body, number - 1);
  }
  const auto& nodes = body.responses.nodes;
  const auto at_node = [&](std::size_t i) {
    const double* x = &nodes.xyz_m[3 * i];
    HistoryPoint point{body.name, what, "", {x[0], x[1], x[2]}, {{i, 1}}, 0};
    point.is_left_out = body.is_left_out(i);
    return point;
  };
  if (std::regex_match(what, match, node)) {
    const auto number = std::stoull(match[1]);
    return number < nodes.n ? FoundPoint(at_node(number)) : FoundPoint();
  }
  if (std::regex_match(what, match, position)) {
    std::array<double, 3> wanted_m{};
    for (std::size_t d = 0; d < 3; ++d) {
      char* end = nullptr;
      const std::string text = match[d + 1];
      wanted_m[d] = 1e-3 * std::strtod(text.c_str(), &end);
      if (*end != '\0' || !std::isfinite(wanted_m[d])) return {};
    }
    return point_near(body, what, wanted_m);
  }
  for (const auto& spot : list_of(body, "hot_spots"))
    if (spot.at("name") == what)
      return has_parts(spot) ? FoundPoint(point_at(body, what, spot, "von_mises_Pa"))
                             : refused_point(without_history);
  for (const auto& place : list_of(body, "places"))
    if (place.at("feature") == what && place.contains("position_m"))
      return point_at(body, what, place, "von_mises_Pa");
  return {};
}

/// The points that a text means, in every body that has one.
std::vector<std::pair<std::size_t, HistoryPoint>> find_points(const std::vector<RunBody>& bodies,
                                                              const std::string& wanted) {
  std::vector<std::pair<std::size_t, HistoryPoint>> found;
  std::string known, why_not;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& body = bodies[b];
    const std::string prefix = body.name + "/";
    const bool names_body = wanted.rfind(prefix, 0) == 0;
    const bool names_other = !names_body && std::any_of(bodies.begin(), bodies.end(), [&](const auto& other) {
      return wanted.rfind(other.name + "/", 0) == 0;
    });
    if (names_other) continue;
    const auto what = names_body ? wanted.substr(prefix.size()) : wanted;
    auto [point, refusal] = find_point(body, what);
    if (point) found.emplace_back(b, std::move(*point));
    if (!refusal.empty()) why_not += (why_not.empty() ? "" : "; ") + refusal;
    known += fmt::format("; {} has {}", body.name, names_like(body, what));
  }
  if (found.empty() && !why_not.empty()) throw OptionError("--at " + wanted + ": " + why_not);
  if (found.empty()) throw OptionError("--at " + wanted + ": is no point of the run" + known);
  return found;
}

Eigen::ArrayXd column(const Hdf5Reader& file, const std::string& name) {
  const auto values = file.numbers(name);
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), Index(values.size()));
}

/// Nodes beside sharp edges, where the run's results have no stress. The pieces of a run on several ranks do
/// not tell.
std::vector<std::int32_t> left_out_of(const ordered_json& summary, const std::filesystem::path& envelope,
                                      std::size_t n_nodes) {
  if (!summary.contains("singular") || !std::filesystem::exists(envelope)) return {};
  auto left_out = read_node_ids(envelope, excluded_field);
  if (left_out.size() != n_nodes) left_out.clear();
  return left_out;
}

ChannelHistory channels_of(const Hdf5Reader& loads, const std::string& body,
                           const fem::UnitResponses& responses, Index n_instants) {
  ChannelHistory history;
  history.body = body;
  history.values.resize(Index(responses.channels.size()), n_instants);
  for (std::size_t k = 0; k < responses.channels.size(); ++k) {
    history.channels.push_back({responses.channels[k], ""});
    const auto values = column(loads, "/channels/" + body + "/" + responses.channels[k]);
    if (values.size() != n_instants)
      throw FileError("loads.h5: the channel " + responses.channels[k] + " of " + body +
                      " has another number of instants than the time; run the scene with --fresh");
    history.values.row(Index(k)) = values.transpose();
  }
  return history;
}

StressHistory superpose(const RunBody& body, HistoryPoint point) {
  Eigen::MatrixXd unit_Pa = Eigen::MatrixXd::Zero(6, Index(body.responses.channels.size()));
  for (const auto& part : point.parts)
    unit_Pa += part.weight *
               Eigen::Map<const Eigen::MatrixXd>(body.responses.unit_stress_Pa(part.node), 6, unit_Pa.cols());
  StressHistory history{std::move(point), (unit_Pa * body.channels.values.matrix()).array()};
  const double found_Pa = history.von_mises_Pa().maxCoeff(), stated_Pa = history.point.stated_Pa;
  if (stated_Pa > 0 && std::abs(found_Pa - stated_Pa) > agreement * stated_Pa)
    throw FileError(
        fmt::format("{}, {}: unit responses and loads give {:.9g} MPa where summary.json has {:.9g}: the "
                    "files are not of one "
                    "run; run the scene with --fresh",
                    body.name, history.point.name, found_Pa / 1e6, stated_Pa / 1e6));
  return history;
}

Stress stress_of(const Eigen::ArrayXXd& all, Index i) {
  return {all(0, i), all(1, i), all(2, i), all(3, i), all(4, i), all(5, i)};
}

/// Unit responses of a run, from the body's folder or the user's cache.
/// @param key_hash  text_hash of their key
std::optional<fem::UnitResponses> responses_of(const std::filesystem::path& folder,
                                               const std::string& key_hash) {
  for (const auto& file : {folder / responses_file_name, cached_file(key_hash)})
    if (!key_hash.empty() && check_kept_file_of(file, key_hash) == KeptFile::whole)
      return read_unit_responses(file, Hdf5Reader(file).text_attribute("/", "key"));
  return std::nullopt;
}

}  // namespace

Eigen::ArrayXd StressHistory::von_mises_Pa() const {
  Eigen::ArrayXd result(stress_Pa.cols());
  for (Index i = 0; i < result.size(); ++i) result[i] = pipelines::von_mises_Pa(stress_of(stress_Pa, i));
  return result;
}

Eigen::ArrayXXd StressHistory::principal_Pa() const {
  Eigen::ArrayXXd result(3, stress_Pa.cols());
  for (Index i = 0; i < result.cols(); ++i) {
    const auto s = stress_of(stress_Pa, i);
    Eigen::Matrix3d tensor;
    tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    result.col(i) = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly)
                        .eigenvalues()
                        .reverse()
                        .array();
  }
  return result;
}

Eigen::ArrayXd StressHistory::signed_von_mises_Pa() const {
  const auto principal = principal_Pa();
  const Eigen::ArrayXd size_Pa = von_mises_Pa();
  return (principal.row(0).transpose() + principal.row(2).transpose() < 0).select(-size_Pa, size_Pa);
}

StressHistories read_stress_histories(const std::filesystem::path& results,
                                      const std::vector<std::string>& wanted) {
  const auto summary = read_json_file(results / "summary.json");
  if (!summary.is_object() || !summary.contains("bodies") || summary["bodies"].empty())
    throw StageRefused((results / "summary.json").string() + ": the run has no body, and so no stress");
  auto record = read_run_record(results / run_record_name);
  StressHistories histories;
  const Hdf5Reader loads(results / "loads.h5");
  histories.time_s = column(loads, "/time");
  histories.drive_angle_rad = column(loads, "/phi");
  std::vector<RunBody> bodies;
  for (const auto& [name, json] : summary.at("bodies").items()) {
    const std::string method = json.value("method", "solid");
    if (method == "beam") {
      histories.left_out.push_back(name + ": a beam keeps no unit responses; --method solid does");
      continue;
    }
    auto responses = responses_of(results / name, record.responses[name]);
    if (!responses) {
      histories.left_out.push_back(name +
                                   ": its unit responses are not in the cache, where the run could not leave "
                                   "them; keep = \"all\" in [results] leaves them beside the results");
      continue;
    }
    auto channels = channels_of(loads, name, *responses, histories.time_s.size());
    auto left_out = wanted.empty() ? std::vector<std::int32_t>()
                                   : left_out_of(json, results / name / "envelope.vtu", responses->nodes.n);
    bodies.push_back({name, json, std::move(*responses), std::move(channels), std::move(left_out)});
  }
  if (bodies.empty()) {
    std::string reasons;
    for (const auto& reason : histories.left_out) reasons += (reasons.empty() ? "" : "; ") + reason;
    throw StageRefused("no body has a stress history: " + reasons);
  }
  std::vector<HistoryPoint> points;
  for (const auto& body : bodies) {
    if (!wanted.empty()) break;
    points.clear();
    add_all(body, histories, points);
    for (auto& point : points) histories.points.push_back(superpose(body, std::move(point)));
  }
  for (const auto& what : wanted)
    for (auto& [b, point] : find_points(bodies, what))
      histories.points.push_back(superpose(bodies[b], std::move(point)));
  return histories;
}

}  // namespace pipelines
