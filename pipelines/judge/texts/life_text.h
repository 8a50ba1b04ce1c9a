/// Lives and safeties in words, and as summary.json has them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "pipelines/base/fields/field.h"
#include "pipelines/judge/life/life_certainty.h"

namespace pipelines {

inline constexpr double seconds_per_hour = 3600;

/// "20000 h", "3.1 h": two digits, without an exponent below a million hours.
std::string hours_text(double life_s);

/// "endures", "12000 h": of a life in seconds.
std::string life_text(const std::optional<double>& life_s);

/// The same with what the whole error of the stress leaves possible: "5000 h (4000 to 9000)", "endures;
/// 10000 h with the stated error", "endures, its error not known", "5000 h, not known well", "0.01 h, beyond
/// the S-N curve". What endures alone does so with the error added.
std::string life_text(const std::optional<double>& life_s, const LifeCertainty& certainty);

/// "1.20 (1.09)": a factor on all stresses and what their error leaves of it at least; "1.20 (-)" where the
/// error is not known, "-" where nothing changes.
std::string safety_text(double safety, double error_share);

/// The same of a row of summary.json, by life_h, life_range_h and beyond_sn_curve.
std::string life_of_row(const summary::Json& row);

/// The same of a row of summary.json, by its two keys.
std::string safety_of_row(const summary::Json& row, const char* safety, const char* least);

/// A life in seconds as h; null: endures.
summary::Json hours_json(const std::optional<double>& life_s);

/// least_safety for summary.json; null: not known, or nothing changes.
summary::Json least_safety_json(double safety, double error_share);

/// life_range_h: [least, most], null where one endures; null where nothing is known.
summary::Json life_range_json(const LifeCertainty& certainty);

/// beyond_sn_curve: why the curve does not hold; null: it holds.
summary::Json beyond_json(const LifeCertainty& certainty);

/// The fields that every life has: hours, what its error leaves of them, and why there may be none.
/// @param life_s     life of a row; none: it endures
/// @param certainty  certainty of that life
template <typename Row, typename Life, typename Certainty>
FieldTable<Row> life_fields(const Life& life_s, const Certainty& certainty) {
  return {
      FieldOf<Row>("life", quantities::hours, "in operation; empty: endures", "life",
                   [=](const Row& r) { return hours_json(std::invoke(life_s, r)); })
          .shown_as([](const summary::Json& row) { return life_of_row(row); }),
      FieldOf<Row>("life_range", quantities::range_of_hours,
                   "life at all stresses times 1 plus and minus their whole error",
                   [=](const Row& r) { return life_range_json(std::invoke(certainty, r)); })
          .in_column("life"),
      FieldOf<Row>("beyond_sn_curve", quantities::text, "why no S-N curve holds there; empty: it holds",
                   [=](const Row& r) { return beyond_json(std::invoke(certainty, r)); }),
  };
}

}  // namespace pipelines
