#include "pipelines/judge/texts/life_text.h"

#include <fmt/core.h>

#include <cmath>

#include "pipelines/judge/analysis/error_text.h"

namespace pipelines {
namespace {

std::optional<double> number_or_none(const summary::Json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

std::optional<double> seconds_in(const summary::Json& hours) {
  const auto number = number_or_none(hours);
  return number ? std::optional(*number * seconds_per_hour) : std::nullopt;
}

}  // namespace

/// Two digits without an exponent below a million.
std::string plain_hours(double life_s) {
  const double hours = life_s / seconds_per_hour;
  if (!(hours >= 0.01) || hours >= 1e6) return fmt::format("{:.2g}", hours);
  const double digit = std::pow(10, std::floor(std::log10(hours)) - 1);
  return fmt::format("{:g}", std::round(hours / digit) * digit);
}

std::string hours_text(double life_s) {
  return plain_hours(life_s) + " h";
}

std::string life_text(const std::optional<double>& life_s) {
  return life_s ? hours_text(*life_s) : "endures";
}

std::string life_text(const std::optional<double>& life_s, const LifeCertainty& certainty) {
  const auto text = life_text(life_s);
  if (!certainty.beyond.empty()) return text + ", beyond the S-N curve";
  const auto& range = certainty.range;
  if (!life_s && !range) return text + ", its error not known";
  if (!life_s)
    return range->least_s ? text + "; " + life_text(range->least_s) + " with the stated error" : text;
  if (!range) return text + ", not known well";
  return fmt::format("{} ({} to {})", text, plain_hours(range->least_s.value_or(*life_s)),
                     range->most_s ? plain_hours(*range->most_s) : "ever");
}

std::string safety_text(double safety, double error_share) {
  if (!std::isfinite(safety)) return "-";
  const auto least = least_safety(safety, error_share);
  return fmt::format("{} ({})", fixed(safety, 2), least ? fixed(*least, 2) : "-");
}

summary::Json least_safety_json(double safety, double error_share) {
  const auto least = least_safety(safety, error_share);
  return least ? summary::number_or_none(*least) : summary::Json(nullptr);
}

summary::Json life_range_json(const LifeCertainty& certainty) {
  if (!certainty.range) return nullptr;
  return summary::Json::array({hours_json(certainty.range->least_s), hours_json(certainty.range->most_s)});
}

summary::Json beyond_json(const LifeCertainty& certainty) {
  return certainty.beyond.empty() ? summary::Json(nullptr) : summary::Json(certainty.beyond);
}

summary::Json hours_json(const std::optional<double>& life_s) {
  return life_s ? summary::number(*life_s / seconds_per_hour) : summary::Json(nullptr);
}

std::string life_of_row(const summary::Json& row) {
  LifeCertainty certainty;
  if (const auto beyond = row.find("beyond_sn_curve"); beyond != row.end() && beyond->is_string())
    certainty.beyond = beyond->get<std::string>();
  if (const auto range = row.find("life_range_h"); range != row.end() && range->is_array())
    certainty.range = LifeRange{seconds_in(range->at(0)), seconds_in(range->at(1))};
  return life_text(seconds_in(row.at("life_h")), certainty);
}

std::string safety_of_row(const summary::Json& row, const char* safety, const char* least) {
  const auto text = [&](const char* key) {
    const auto number = row.contains(key) ? number_or_none(row.at(key)) : std::nullopt;
    return number ? fixed(*number, 2) : std::string("-");
  };
  const auto value = text(safety);
  return value == "-" ? value : fmt::format("{} ({})", value, text(least));
}

}  // namespace pipelines
