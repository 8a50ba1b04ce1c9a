#include "pipelines/scene/tables/load_file.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_fault.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/base/names/units.h"
#include "pipelines/scene/tables/load_columns.h"
#include "pipelines/scene/tables/load_name.h"
#include "pipelines/scene/tables/sampled_turns.h"
#include "pipelines/scene/tables/table_file.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// The file's samples, one reader for each file.
class Samples {
public:
  Samples(SceneTable& entry, const LoadFileKeys& keys, TableFile table, std::vector<ChosenColumn> chosen,
          const OpenTable& open, SceneFindings& findings)
      : entry_(entry),
        keys_(keys),
        table_(std::move(table)),
        chosen_(std::move(chosen)),
        open_(open),
        findings_(findings) {}

  /// @return whether the loads are a mean turn
  bool append_to(kinetics::LoadTable& loads, int window_turns) {
    const auto angle_rad = angles(loads.speed_rad_s);
    if (!angle_rad) {
      loads.loads.push_back(nothing_of(keys_.effect));
      return false;
    }
    angle_rad_ = *angle_rad;
    speed_rad_s_ = loads.speed_rad_s;
    is_ascending_ = check_ascending();
    if (!table_.doubt.empty() &&
        !contains(findings_.warnings, table_.doubt))  // another entry may read it too
      findings_.warnings.push_back(table_.doubt);
    if (table_.columns.size() < 2)
      entry_.refuse("file", "has no load; add columns such as \"pulley_seat.fx [N]\"");
    choose_turns(window_turns, loads);
    const std::size_t first = loads.loads.size();
    for (std::size_t c = 1; c < chosen_.size(); ++c) append_load(c, loads);
    for (std::size_t i = first; i < loads.loads.size(); ++i)
      if (auto* course = std::get_if<kinetics::SampledCourse>(&loads.loads[i].course))
        course->origin = origin();
    return n_averaged_ > 0;
  }

private:
  void refuse(std::size_t c, int line, const std::string& value, const std::string& remedy) {
    const auto& column = table_.columns[c];
    findings_.errors.push_back({table_.file.string(), line, column.column, column.name, value, remedy});
  }

  /// A column in SI; errors go to the findings, at the column's title.
  ArrayXd in_si(std::size_t c, const std::string& si_unit) {
    const auto& column = table_.columns[c];
    const auto& unit = chosen_[c].unit;
    ArrayXd values = Eigen::Map<const ArrayXd>(column.values.data(), Index(column.values.size()));
    if (unit.empty()) {
      refuse(c, table_.title_line, "", "has no unit; write \"" + column.name + " [" + si_unit + "]\"");
      return values;
    }
    try {
      ArrayXd in_SI = values * to_si("1 " + unit, si_unit);
      for (Index i = 0; i < in_SI.size(); ++i)
        if (!loads_within().contains(in_SI[i])) {
          refuse(c, table_.lines[std::size_t(i)], shown(column.values[std::size_t(i)]),
                 loads_within().rule(in_SI[i], si_unit) + "; check the number");
          return values;
        }
      return in_SI;
    } catch (const UnitError& error) {
      const bool is_below = open_.layout.unit_line > 0 && !column.title.is_in_brackets;
      refuse(c, is_below ? open_.layout.unit_line : table_.title_line, unit, error.what());
    }
    return values;
  }

  /// The drive's angle at each row, from a column of time or of angle.
  std::optional<ArrayXd> angles(double speed_rad_s) {
    const std::string key = chosen_.front().key;
    if (key == "angle") return in_si(0, "rad");
    if (key == "time") return in_si(0, "s") * speed_rad_s;
    refuse(0, table_.title_line, "",
           "the first column must be \"time [s]\" or \"angle [deg]\"; rename or add it, or say in the scene "
           "which title is which: columns = { time = \"...\", \"pulley_seat.fx\" = \"...\" }");
    return std::nullopt;
  }

  bool check_ascending() {
    for (Index i = 1; i < angle_rad_.size(); ++i)
      if (angle_rad_[i] <= angle_rad_[i - 1]) {
        const auto& column = table_.columns.front();
        findings_.errors.push_back({table_.file.string(), table_.lines[std::size_t(i)], column.column,
                                    column.name, shown(column.values[std::size_t(i)]),
                                    "does not ascend; sort the rows and remove repetitions"});
        return false;
      }
    return angle_rad_.size() > 1 && angle_rad_.isFinite().all();
  }

  /// "3.02 turns of the drive at 960 rpm, of 0.0625 s each"
  std::string span_text() const {
    return shown(turns_between_ends(angle_rad_), 4) + " turns of the drive, of " +
           shown(2 * pi / speed_rad_s_, 4) + " s each";
  }

  /// What is done with several turns; refuses what is no whole number of them, or what nobody has said.
  void choose_turns(int window_turns, kinetics::LoadTable& loads) {
    constexpr double rounding = 1e-9;
    if (!is_ascending_) return;
    const double span = turns_between_ends(angle_rad_);
    const int whole = std::min(span, 1e6) < 1e6 ? whole_turns(angle_rad_) : 1'000'000;
    const int window = std::max(1, window_turns);
    if (keys_.turns.empty()) {
      if (span > window * (1 + rounding))
        entry_.refuse("file", "has samples over " + span_text() + ", and the window has " +
                                  std::to_string(window) +
                                  ": check machine.speed and the unit of time, and set turns = \"average\" "
                                  "for the mean of the whole turns, or turns = \"as they are\"" +
                                  (window_turns > 0 ? " and sampling.turns to their number" : ""));
      else if (window - span > 0.5 * (1 + rounding))
        entry_.refuse("file", "has samples over " + span_text() + ", and the window has " +
                                  std::to_string(window) +
                                  ": check machine.speed, the unit of time and sampling.turns; the samples "
                                  "must cover whole turns");
      return;
    }
    if (keys_.turns == "average") {
      if (whole < 1)
        entry_.refuse("turns", "the file has samples over " + span_text() +
                                   ": not one whole turn; check machine.speed and the unit of time");
      n_averaged_ = std::max(0, whole);
      return;
    }
    const bool has_rest = span > whole * (1 + rounding) && span - whole <= 0.5;
    if (has_rest || whole < 1)
      entry_.refuse("turns", "the file has samples over " + span_text() +
                                 ": no whole number; cut it, or set turns = \"average\", which leaves the "
                                 "rest out");
    loads.turns = std::max(loads.turns, span > whole * (1 + rounding) ? whole + 1 : whole);
  }

  void append_load(std::size_t c, kinetics::LoadTable& loads) {
    const auto load = parse_load(chosen_[c].key);
    if (!load) {
      const std::string name = keys_.has_columns ? chosen_[c].key : table_.columns[c].name;
      findings_.errors.push_back({table_.file.string(), table_.title_line, table_.columns[c].column, name, "",
                                  not_a_load(name) + unmapped_remedy()});
      loads.loads.push_back(nothing_of(keys_.effect));
      return;
    }
    kinetics::SampledCourse course{angle_rad_, in_si(c, load->unit)};
    if (n_averaged_ > 0) take_mean(c, course);
    loads.loads.push_back({keys_.effect, load->port, load->component, load->unit, std::move(course)});
  }

  std::string unmapped_remedy() const {
    return keys_.has_columns ? "" : "; or say in the scene which columns are loads: columns = { ... }";
  }

  void take_mean(std::size_t c, kinetics::SampledCourse& course) {
    constexpr double worth_a_warning = 0.03;
    const double largest = course.values.abs().maxCoeff();
    const auto mean = mean_turn(course.angle_rad, course.values, n_averaged_);
    if (largest > 0) scatter_ = std::max(scatter_, mean.scatter / largest);
    const double lost = largest - mean.values.abs().maxCoeff();
    if (lost > worth_a_warning * largest)
      findings_.warnings.push_back(table_.file.string() + ": " + chosen_[c].key + ": the mean of " +
                                   std::to_string(n_averaged_) + " turns is " +
                                   shown(100 * lost / largest, 2) +
                                   " % below the largest sample; turns = \"as they are\" keeps it");
    course.angle_rad = mean.angle_rad;
    course.values = mean.values;
  }

  /// "5 rows over 0.0625 s, uneven (steps of 0.01 to 0.0325 s)"
  std::string rows_text() const {
    const auto& at = table_.columns.front().values;
    const std::string unit = chosen_.front().unit;
    std::string text =
        std::to_string(table_.n_rows()) + " rows over " + shown(at.back() - at.front(), 6) + " " + unit;
    if (at.size() < 3) return text;
    double least = at[1] - at[0], most = least;
    for (std::size_t i = 1; i < at.size(); ++i) {
      least = std::min(least, at[i] - at[i - 1]);
      most = std::max(most, at[i] - at[i - 1]);
    }
    const bool is_even = most - least <= 0.01 * most;
    return text +
           (is_even ? ", even"
                    : ", uneven (steps of " + shown(least, 3) + " to " + shown(most, 3) + " " + unit + ")");
  }

  /// "4 of 7 columns (not used: Druck, Temperatur)"
  std::string columns_text() const {
    constexpr std::size_t most_named = 8;
    const std::size_t n = open_.columns.size();
    std::vector<std::string> unused;
    std::size_t n_used = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_used = std::any_of(chosen_.begin(), chosen_.end(),
                                       [&](const ChosenColumn& column) { return column.index == i; });
      n_used += is_used ? 1 : 0;
      const auto& title = open_.columns[i].title.text;
      const bool has_name = !title.empty() && control_character_in(title).empty();
      if (!is_used && unused.size() < most_named)
        unused.push_back(has_name ? title : "#" + std::to_string(i + 1));
    }
    if (n_used == n) return std::to_string(n) + " columns";
    return std::to_string(n_used) + " of " + std::to_string(n) + " columns (not used: " + listed(unused) +
           (n - n_used > unused.size() ? " ..." : "") + ")";
  }

  std::string turns_text() const {
    const double span = turns_between_ends(angle_rad_);
    if (n_averaged_ > 0)
      return ", mean of " + std::to_string(n_averaged_) + (n_averaged_ == 1 ? " turn" : " turns") + " of " +
             shown(span, 4) + ", from which they differ by up to " + shown(100 * scatter_, 2) +
             " % of the largest sample";
    return span > 1 + 1e-9 ? ", " + shown(span, 4) + " turns as they are" : "";
  }

  std::string origin() const {
    if (!is_ascending_) return "";
    return table_.file.filename().string() + ": " + table_.form + ", " + columns_text() + ", " + rows_text() +
           turns_text();
  }

  SceneTable& entry_;
  const LoadFileKeys& keys_;
  TableFile table_;
  std::vector<ChosenColumn> chosen_;
  const OpenTable& open_;
  SceneFindings& findings_;
  ArrayXd angle_rad_;
  double speed_rad_s_ = 0;
  bool is_ascending_ = false;
  int n_averaged_ = 0;  ///< turns that are averaged; 0: the samples stay as they are
  double scatter_ = 0;  ///< scatter of the turns about their mean, as a share of the largest sample
};

}  // namespace

bool read_load_file(SceneTable& entry, const std::filesystem::path& folder, int window_turns,
                    SceneFindings& findings, kinetics::LoadTable& loads) {
  auto keys = read_load_file_keys(entry);
  if (keys.effect.empty() || keys.file.empty()) return false;
  std::vector<std::string> wanted;
  if (!keys.has_columns) wanted = {"time", "angle"};
  for (const auto& column : keys.columns) {
    wanted.push_back(column.title);
    wanted.push_back(parse_title(column.title).name);
  }
  try {
    const auto open = open_table(folder / keys.file, keys.form, wanted);
    const auto chosen =
        keys.has_columns ? columns_by_scene(entry, keys, open, findings) : columns_by_title(open);
    if (!chosen.empty()) {
      std::vector<std::size_t> indices;
      for (const auto& column : chosen) indices.push_back(column.index);
      return Samples(
                 entry, keys,
                 read_columns(open, indices, keys.has_columns ? Titles::are_chosen : Titles::name_columns),
                 chosen, open, findings)
          .append_to(loads, window_turns);
    }
  } catch (const SceneError& error) {
    findings.errors.insert(findings.errors.end(), error.findings().begin(), error.findings().end());
  }
  loads.loads.push_back(nothing_of(keys.effect));
  return false;
}

void repeat_mean_turns(const std::vector<std::size_t>& which, int window_turns, kinetics::LoadTable& loads) {
  if (window_turns < 2) return;
  for (const auto i : which)
    if (auto* course = std::get_if<kinetics::SampledCourse>(&loads.loads[i].course)) {
      course->angle_rad = repeated_angles(course->angle_rad, window_turns);
      course->values = course->values.replicate(window_turns, 1).eval();
    }
}

}  // namespace pipelines
