#include "pipelines/write/files/stress_history_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/base/files/hdf5_file.h"
#include "pipelines/superpose/envelope/stress_cycle.h"

namespace pipelines {
namespace {

using Eigen::Index;
using nlohmann::ordered_json;

constexpr double to_MPa = 1e-6, to_deg = 180 / pi;

std::string group_of(const HistoryPoint& point) {
  std::string text;
  for (const unsigned char c : point.name) {
    if (std::isalnum(c) || c == '.' || c == '-')
      text += char(c);
    else if (!text.empty() && text.back() != '_')
      text += '_';
  }
  while (!text.empty() && text.back() == '_') text.pop_back();
  return text;
}

/// File name of each point, without an extension; names that would be one get numbers.
std::vector<std::string> file_names(const StressHistories& histories) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const auto& history : histories.points) {
    const auto name = history.point.body + "_" + group_of(history.point);
    auto free = name;
    for (int n = 2; !taken.insert(free).second; ++n) free = fmt::format("{}_{}", name, n);
    names.push_back(free);
  }
  return names;
}

std::vector<double> scaled(const Eigen::Ref<const Eigen::ArrayXd>& values, double factor) {
  const Eigen::ArrayXd result = factor * values;
  return {result.begin(), result.end()};
}

/// What fatigue counts first: the two instants that differ most, whatever sign von Mises stress would have.
StressCycle cycle_of(const StressHistory& history) {
  constexpr double slack = 1e-9;
  return largest_cycle(history.stress_Pa, slack);
}

/// Line of an instant in the CSV file, whose first line has the titles.
Index line_of(Index instant) {
  return instant + 2;
}

void write_point_csv(const std::filesystem::path& file, const StressHistories& histories,
                     const StressHistory& history) {
  std::vector<CsvColumn> columns{{"time", "s", scaled(histories.time_s, 1)},
                                 {"drive_angle", "deg", scaled(histories.drive_angle_rad, to_deg)}};
  const char* const components[] = {"xx", "yy", "zz", "xy", "yz", "xz"};
  for (Index c = 0; c < 6; ++c)
    columns.push_back({components[c], "MPa", scaled(history.stress_Pa.row(c).transpose(), to_MPa)});
  columns.push_back({"von_mises", "MPa", scaled(history.von_mises_Pa(), to_MPa)});
  columns.push_back({"signed_von_mises", "MPa", scaled(history.signed_von_mises_Pa(), to_MPa)});
  const auto principal_Pa = history.principal_Pa();
  for (Index c = 0; c < 3; ++c)
    columns.push_back(
        {fmt::format("principal_{}", c + 1), "MPa", scaled(principal_Pa.row(c).transpose(), to_MPa)});
  write_csv(file, columns);
}

}  // namespace

std::vector<std::string> stress_history_files(const StressHistories& histories) {
  std::vector<std::string> files{"histories.h5"};
  for (const auto& name : file_names(histories)) files.push_back(name + ".csv");
  return files;
}

void write_stress_histories(const std::filesystem::path& directory, const StressHistories& histories) {
  const auto names = file_names(histories);
  AtomicFile file(directory / "histories.h5");
  {
    Hdf5Writer out(file.temporary());
    const auto write = [&](const std::string& object, const Eigen::ArrayXd& values, const Hdf5Label& label) {
      out.write(object, values.data(), {std::size_t(values.size())}, label);
    };
    write("/time", histories.time_s, {"s", "of each instant"});
    write("/drive_angle", histories.drive_angle_rad * to_deg, {"deg", "of the drive"});
    for (std::size_t p = 0; p < names.size(); ++p) {
      const auto& point = histories.points[p].point;
      const Eigen::ArrayXXd stress_MPa = histories.points[p].stress_Pa * to_MPa;
      const Eigen::ArrayXXd principal_MPa = histories.points[p].principal_Pa() * to_MPa;
      const auto group = "/" + point.body + "/" + names[p].substr(point.body.size() + 1);
      const auto n_instants = std::size_t(stress_MPa.cols());
      out.write(group + "/stress", stress_MPa.data(), {n_instants, 6},
                {"MPa", "xx, yy, zz, xy, yz, xz in the body's frame"});
      write(group + "/von_mises", histories.points[p].von_mises_Pa() * to_MPa, {"MPa", "von Mises stress"});
      write(group + "/signed_von_mises", histories.points[p].signed_von_mises_Pa() * to_MPa,
            {"MPa", "von Mises stress with the sign of the principal stress of largest size"});
      out.write(group + "/principal", principal_MPa.data(), {n_instants, 3},
                {"MPa", "principal stresses, falling"});
      out.attribute(group, "point", point.name);
      out.attribute(group, "feature", point.feature);
      for (std::size_t d = 0; d < 3; ++d)
        out.attribute(group, std::string(1, char('x' + d)) + " [m]", point.position_m[d]);
    }
    out.close();
  }
  file.commit();
  for (std::size_t p = 0; p < names.size(); ++p)
    write_point_csv(directory / (names[p] + ".csv"), histories, histories.points[p]);
}

void print_stress_histories(std::ostream& out, const StressHistories& histories, bool json) {
  const auto names = file_names(histories);
  if (json) {
    ordered_json all{{"points", ordered_json::array()}, {"left_out", histories.left_out}};
    for (std::size_t p = 0; p < names.size(); ++p) {
      const auto& history = histories.points[p];
      const auto with_sign = history.signed_von_mises_Pa();
      const auto cycle = cycle_of(history);
      all["points"].push_back({{"body", history.point.body},
                               {"point", history.point.name},
                               {"feature", history.point.feature},
                               {"position_m", history.point.position_m},
                               {"distance_m", history.point.distance_m},
                               {"left_out", history.point.is_left_out},
                               {"file", names[p] + ".csv"},
                               {"von_mises_max_Pa", history.von_mises_Pa().maxCoeff()},
                               {"amplitude_Pa", cycle.amplitude_Pa},
                               {"mean_Pa", cycle.signed_mean_Pa},
                               {"amplitude_between_lines", {line_of(cycle.from), line_of(cycle.to)}},
                               {"signed_von_mises_min_Pa", with_sign.minCoeff()},
                               {"signed_von_mises_max_Pa", with_sign.maxCoeff()}});
    }
    out << all.dump(2) << '\n';
    return;
  }
  std::array<std::size_t, 3> widths{4, 5, 2};  // widths of body, point and feature
  for (const auto& [point, stress_Pa] : histories.points) {
    const std::array<std::size_t, 3> sizes{point.body.size(), point.name.size(), point.feature.size()};
    for (std::size_t c = 0; c < 3; ++c) widths[c] = std::max(widths[c], sizes[c]);
  }
  const auto [body, name, feature] = widths;
  out << fmt::format("\n  {:<{}}  {:<{}}  {:<{}}  {:>13}  {:>13}  {:>8}  {:>13}\n", "body", body, "point",
                     name, "on", feature, "von Mises MPa", "amplitude MPa", "mean MPa", "between lines");
  for (const auto& history : histories.points) {
    const auto cycle = cycle_of(history);
    out << fmt::format("  {:<{}}  {:<{}}  {:<{}}  {:>13.2f}  {:>13.2f}  {:>8.2f}  {:>13}\n",
                       history.point.body, body, history.point.name, name, history.point.feature, feature,
                       history.von_mises_Pa().maxCoeff() / 1e6, cycle.amplitude_Pa / 1e6,
                       cycle.signed_mean_Pa / 1e6,
                       fmt::format("{} and {}", line_of(cycle.from), line_of(cycle.to)));
  }
  out << "  amplitude: half the von Mises stress of the difference of the two instants that differ most, on "
         "these "
         "lines of the CSV file; mean: signed von Mises stress of their middle\n";
  for (const auto& [point, stress_Pa] : histories.points)
    if (point.distance_m > 0)
      out << fmt::format("  {}, {}: at the nearest node, ({:.6g}, {:.6g}, {:.6g}) mm, {:.3g} mm from it\n",
                         point.body, point.name, 1e3 * point.position_m[0], 1e3 * point.position_m[1],
                         1e3 * point.position_m[2], 1e3 * point.distance_m);
  for (const auto& [point, stress_Pa] : histories.points)
    if (point.is_left_out)
      out << fmt::format(
          "  {}, {}: beside a sharp edge, where the run reports no stress: this one is of its mesh alone, a "
          "finer one has another\n",
          point.body, point.name);
  for (const auto& text : histories.left_out) out << "  without: " << text << '\n';
}

}  // namespace pipelines
