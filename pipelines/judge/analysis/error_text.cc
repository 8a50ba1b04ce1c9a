#include "pipelines/judge/analysis/error_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "pipelines/judge/analysis/exclusion_border.h"

namespace pipelines {
namespace {

constexpr double negligible_share = 1e-3;  // of the stress

std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string in_MPa(double value_Pa) {
  return fixed(value_Pa / 1e6, 1);
}

/// What helps against an assumption.
std::string remedy_of_model(const std::string& source) {
  if (source == "load_patches" || source == "load_edges")
    return "give the seats' pressure as it is known (half_angle, clearance, harmonics); no mesh lowers it";
  if (source == "charge_patch") return "give the half_angle of the charge on inner_wall as it is known";
  if (source == "quasi_static")
    return "keep the natural frequencies, which may be lower by their errors, away from the harmonics of the "
           "stress; a mesh lowers their errors alone";
  for (const char* of_cheap_model :
       {"model", "beam_model", "near_loads", "ovalisation", "spin", "eccentric_segments", "offset_axis"})
    if (source == of_cheap_model) return "--method solid";
  if (source == "dropped_effects") return "name the effects instead of effects = \"auto\"";
  return "no mesh lowers it";
}

std::string remedy_of_calculation(const std::string& source, const Search& search) {
  if (source == "cancellation")
    return "give the difference of the loads that cancel as one load; no mesh lowers it";
  if (search.steps.empty()) return "--tolerance \"5 %\"";
  if (search.time_was_up()) return "more time (--time-limit)";  // without a tolerance whatever is met
  if (search.met) return "a smaller --tolerance";
  return "another mesh, since " + search.ended;
}

}  // namespace

std::string fixed(double value, int decimals) {
  const bool is_plain =
      value == 0 || (std::abs(value) >= 0.5 * std::pow(10, -decimals) && std::abs(value) < 1e7);
  return is_plain || !std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals)
                                           : fmt::format("{:.3g}", value);
}

std::string stress_in_MPa(double value_Pa, double error_Pa) {
  constexpr double shown = 0.05;  // with one decimal
  constexpr int most_digits = 8, least_digits = 3;
  const double error = error_Pa / 1e6, value = std::abs(value_Pa) / 1e6;
  if (!(value > 0) || !std::isfinite(value)) return in_MPa(value_Pa);
  const int before_point = int(std::floor(std::log10(value))) + 1;
  const int wanted = error > 0 && error < shown ? int(std::ceil(-std::log10(error))) : 1;
  const int decimals = std::min(std::max({wanted, value < 1 ? least_digits - before_point : 1, 1}),
                                std::max(most_digits - before_point, 1));
  return decimals > most_digits ? fmt::format("{:.3g}", value_Pa / 1e6) : fixed(value_Pa / 1e6, decimals);
}

std::string with_error(double value, double error, double unit) {
  constexpr int digits = 4;
  const double shown = value / unit, size = std::abs(shown);
  const int before_point = size > 0 ? int(std::floor(std::log10(size))) + 1 : 1;
  const int decimals = std::clamp(digits - before_point, 0, 2 * digits);
  if (!std::isfinite(error)) return fixed(shown, decimals) + " +- ?";
  const double last = std::pow(10, -decimals), rounding = std::abs(shown - std::round(shown / last) * last);
  constexpr double tiny = 1e-9;  // of the last digit: what rounding adds to a sum
  const double up = std::max(0.0, std::ceil((error / unit + rounding) / last - tiny)) * last;
  return fixed(shown, decimals) + " +- " + fixed(up, decimals);
}

std::string value_with_shares(double value_Pa, const ErrorBudget& errors) {
  auto text = with_error(value_Pa, errors.total_Pa()) + " MPa";
  bool is_first = true;
  for (const auto& entry : errors.model) {
    if (entry.value_Pa < negligible_share * value_Pa || entry.value_Pa == 0) continue;
    text += fmt::format(", {}{} from {}", in_MPa(entry.value_Pa), is_first ? " of it" : "",
                        in_words(entry.source));
    is_first = false;
  }
  return text;
}

std::string value_with_errors(double value_Pa, const ErrorBudget& errors) {
  auto text = stress_in_MPa(value_Pa, errors.numerical_Pa()) + " MPa +- " + in_MPa(errors.numerical_Pa()) +
              " (numerical)";
  bool is_any = false;
  for (const auto& entry : errors.model) {
    if (entry.value_Pa < negligible_share * value_Pa || entry.value_Pa == 0) continue;
    text += fmt::format("{} +- {} from {}{}", is_any ? "," : " and", in_MPa(entry.value_Pa),
                        in_words(entry.source), entry.condition.empty() ? "" : " (" + entry.condition + ")");
    is_any = true;
  }
  return is_any ? text + ", which no mesh lowers" : text;
}

std::string corners_left_out(const Judged& analysis) {
  constexpr std::size_t told = 4;
  if (!analysis.hot_spots.empty() || analysis.method == Method::beam) return {};
  const auto& edges = analysis.mesh.sharp_edges;
  std::string text;
  for (std::size_t i = 0; i < std::min(told, edges.size()); ++i)
    text += fmt::format("{}{} ({:.2g} mm)", i > 0 ? ", " : "", edges[i].name, edges[i].distance_m * 1e3);
  if (edges.size() > told) text += fmt::format(" and {} more", edges.size() - told);
  return text;
}

std::string rises_towards_edge(const Judged& analysis) {
  if (governing_stress(analysis).kind != GoverningStress::Kind::peak) return {};
  const auto* edge = edge_beside_peak(analysis);
  if (edge == nullptr) return {};
  std::string weld = "judge a weld by the stress at points farther away (millstress history)";
  if (std::holds_alternative<meshes::Import>(analysis.scene.shape)) {
    const auto& at_m = analysis.peak.position_m;
    weld = fmt::format(
        "where it is a weld say so, then its hot-spot stress is judged: [[{}.edges]] at = [\"{:.1f} mm\", "
        "\"{:.1f} mm\", \"{:.1f} mm\"], kind = \"weld\", thickness = that of the plate; kind = \"notch\", "
        "radius = \"1 mm\" rounds it "
        "for its effective notch stress",
        analysis.scene.name, 1e3 * at_m[0], 1e3 * at_m[1], 1e3 * at_m[2]);
  }
  return fmt::format(
      "the stress rises towards the sharp inner edge {}, around which {:.2g} mm are left out: {} MPa at the "
      "border, and no limit nearer to the edge; model its fillet, or {}",
      edge->name, edge->distance_m * 1e3, fixed(largest_at_border_Pa(analysis) / 1e6, 1), weld);
}

namespace {

/// The largest source of an error, and what lowers it.
struct LargestError {
  std::string source, remedy;
};

LargestError largest_error(const ErrorBudget& errors, const Search& search) {
  const auto smaller = [](const auto& a, const auto& b) { return a.value_Pa < b.value_Pa; };
  const auto largest_of = [&](const std::vector<ErrorEntry>& entries) {
    const auto found = std::max_element(entries.begin(), entries.end(), smaller);
    return found == entries.end() ? ErrorEntry{} : *found;
  };
  const auto numerical = largest_of(errors.numerical), model = largest_of(errors.model);
  if (smaller(numerical, model)) return {model.source, remedy_of_model(model.source)};
  return {numerical.source, remedy_of_calculation(numerical.source, search)};
}

}  // namespace

std::string remedy_of_error(const ErrorBudget& errors, const Search& search) {
  const auto largest = largest_error(errors, search);
  return in_words(largest.source) + "; remedy: " + largest.remedy;
}

std::string not_known_well(const GoverningStress& stress, const Search& search) {
  const double total_Pa = stress.errors.total_Pa();
  if (!(total_Pa > largest_plain_error * stress.value_Pa)) return {};
  return fmt::format("{} MPa +- {} MPa ({:.0f} %): {}", stress_in_MPa(stress.value_Pa, total_Pa),
                     in_MPa(total_Pa), 100 * total_Pa / stress.value_Pa,
                     remedy_of_error(stress.errors, search));
}

std::string text_of_step(const std::string& body, const Search& search) {
  const auto& step = search.steps.back();
  const double percent = step.value_Pa > 0 ? 100 * step.errors.reducible_Pa() / step.value_Pa : 0;
  return fmt::format("{}, step {}: {} unknowns, {:.4g} MPa known to {:.2g} %, {:.1f} s", body,
                     search.steps.size(), step.n_dofs, step.value_Pa / 1e6, percent, step.seconds);
}

}  // namespace pipelines
