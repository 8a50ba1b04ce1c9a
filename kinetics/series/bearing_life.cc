#include "kinetics/series/bearing_life.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "kinetics/values/constants.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

void require_positive(const std::string& parameter, double value) {
  require_finite(parameter, value);
  if (value <= 0) refuse(parameter, value, "must be positive");
}

void require_not_negative(const std::string& parameter, double value) {
  require_finite(parameter, value);
  if (value < 0) refuse(parameter, value, "must not be negative");
}

void check_law(const WeibullLife& law) {
  require_not_negative("weibull.guaranteed", law.guaranteed);
  require_positive("weibull.scale", law.scale);
  require_positive("weibull.shape", law.shape);
  require_positive("weibull.life_exponent", law.life_exponent);
}

}  // namespace

double life_exponent(RollingElement element) {
  return element == RollingElement::ball ? 3.0 : 10.0 / 3.0;
}

double equivalent_load_N(const Eigen::ArrayXd& force_N, RollingElement element) {
  return equivalent_load_N(force_N, Eigen::ArrayXd::Ones(force_N.size()), element);
}

double equivalent_load_N(const Eigen::ArrayXd& force_N, const Eigen::ArrayXd& revolutions,
                         RollingElement element) {
  if (force_N.size() == 0) throw std::invalid_argument("force_N: holds no values; give at least one instant");
  if (revolutions.size() != force_N.size())
    refuse("number of revolutions", double(revolutions.size()),
           "must be one for each of the " + number(double(force_N.size())) + " forces");
  for (Eigen::Index i = 0; i < force_N.size(); ++i) {
    require_finite("force_N[" + std::to_string(i) + "]", force_N[i]);
    require_not_negative("revolutions[" + std::to_string(i) + "]", revolutions[i]);
  }
  require_positive("sum of revolutions", revolutions.sum());
  const double largest_N = force_N.abs().maxCoeff();  // taken out, so that no power overflows
  if (largest_N == 0) return 0;
  const double p = life_exponent(element);
  const double mean = ((force_N / largest_N).abs().pow(p) * revolutions).sum() / revolutions.sum();
  return largest_N * std::pow(mean, 1 / p);
}

std::optional<RatingLife> rating_life(double dynamic_rating_N, double equivalent_load_N,
                                      RollingElement element, double speed_rad_s) {
  require_positive("dynamic_rating_N", dynamic_rating_N);
  require_not_negative("equivalent_load_N", equivalent_load_N);
  require_positive("speed_rad_s", speed_rad_s);
  if (equivalent_load_N == 0) return std::nullopt;
  const double L10 = std::pow(dynamic_rating_N / equivalent_load_N, life_exponent(element));
  const double hours = L10 * 1e6 * 2 * pi / (speed_rad_s * 3600);
  if (!std::isfinite(L10) || !std::isfinite(hours)) return std::nullopt;
  return RatingLife{L10, hours};
}

double life_factor(double reliability) {
  require_finite("reliability", reliability);
  if (reliability < 0.9 || reliability > 0.9995)
    refuse("reliability", reliability, "must lie between 0.9 and 0.9995, where ISO 281 has its factor a1");
  // 90 % is the catalogues' own: no rounding there.
  if (reliability == 0.9) return 1;
  return 0.95 * std::pow(std::log(reliability) / std::log(0.9), 2.0 / 3) + 0.05;
}

double life_modification_factor(const Lubrication& lubrication, double equivalent_load_N,
                                RollingElement element) {
  const auto& [given_kappa, contamination, limit_N] = lubrication;
  require_finite("viscosity_ratio", given_kappa);
  if (given_kappa < 0.1)
    refuse("viscosity_ratio", given_kappa, "must be 0.1 at least: below, ISO 281 gives no life");
  require_positive("contamination_factor", contamination);
  if (contamination > 1) refuse("contamination_factor", contamination, "must not exceed 1, which is clean");
  require_positive("fatigue_load_limit_N", limit_N);
  require_positive("equivalent_load_N", equivalent_load_N);
  constexpr double most_kappa = 4, most = 50;
  const double kappa = std::min(given_kappa, most_kappa);
  const bool is_ball = element == RollingElement::ball;
  // Constant of the film, its factor at little, middle and full viscosity, and the powers.
  const double constant = is_ball ? 2.5671 : 1.5859;
  const double film = kappa < 0.4
                          ? (is_ball ? 2.2649 : 1.3993) / std::pow(kappa, 0.054381)
                          : (is_ball ? 1.9987 : 1.2348) / std::pow(kappa, kappa < 1 ? 0.19087 : 0.071739);
  const double of_film = is_ball ? std::pow(constant - film, 0.83) : constant - film;
  const double of_load = std::pow(contamination * limit_N / equivalent_load_N, is_ball ? 1.0 / 3 : 0.4);
  const double left = 1 - of_film * of_load;
  if (left <= 0) return most;
  return std::min(most, 0.1 * std::pow(left, is_ball ? -9.3 : -9.185));
}

double required_million_revolutions(double hours, double speed_rad_s) {
  require_positive("hours", hours);
  require_positive("speed_rad_s", speed_rad_s);
  return hours * 3600 * speed_rad_s / (2 * pi) / 1e6;
}

double required_rating_N(double load_N, double million_revolutions, double reliability,
                         const WeibullLife& law) {
  check_law(law);
  require_not_negative("load_N", load_N);
  require_positive("million_revolutions", million_revolutions);
  require_finite("reliability", reliability);
  if (reliability <= 0 || reliability > 1)
    refuse("reliability", reliability, "must lie above 0 and not above 1; 0.9 is the catalogues' own");
  const double reached = law.guaranteed + law.scale * std::pow(-std::log(reliability), 1 / law.shape);
  if (reached <= 0)
    refuse("reliability", reliability,
           "no bearing is certain to last where weibull.guaranteed = 0; ask for less than 1");
  return load_N * std::pow(million_revolutions / reached, 1 / law.life_exponent);
}

double reliability(double load_N, double million_revolutions, double rating_N, const WeibullLife& law) {
  check_law(law);
  require_not_negative("load_N", load_N);
  require_positive("million_revolutions", million_revolutions);
  require_positive("rating_N", rating_N);
  const double x = million_revolutions * std::pow(load_N / rating_N, law.life_exponent);
  if (x <= law.guaranteed) return 1;
  return std::exp(-std::pow((x - law.guaranteed) / law.scale, law.shape));
}

}  // namespace kinetics
