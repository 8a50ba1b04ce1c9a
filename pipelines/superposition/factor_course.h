/// Time factors of a cycle at more places than its instants: of the trigonometric polynomial through them,
/// where it is close to the true course.
#pragma once

#include <Eigen/Core>

namespace pipelines {

class FactorCourse {
public:
  /// @param values      channels x n instants, equidistant over one period
  /// @param size        of the stress that one unit of each channel brings at most [Pa]: what does not stress
  ///                    the body does not count
  /// @param per_period  the least number of places in a period of the highest harmonic that counts
  FactorCourse(Eigen::ArrayXXd values, const Eigen::ArrayXd& size, double per_period);

  /// Whether there are places between the instants: the spectrum leaves no more than a hundredth of the
  /// largest channel unresolved (FactorSpectrum::unresolved) and the period is closed. Else the places are
  /// the instants: jumps, kinks at few instants, windows.
  bool is_polynomial() const { return is_polynomial_; }
  /// The polynomial is the course itself, as far as the instants tell.
  bool is_resolved() const { return is_resolved_; }

  /// Factors at the instants, channels x n.
  const Eigen::ArrayXXd& values() const { return values_; }
  /// Factors at the places, channels x (n per_step()); place i per_step() is instant i.
  const Eigen::ArrayXXd& fine() const { return per_step_ == 1 ? values_ : fine_; }
  Eigen::Index per_step() const { return per_step_; }

  /// Weights of the instants for the value between them; of instants alone, of the nearest one.
  /// @param instant  i + share of the step to the next, 0 to n
  Eigen::VectorXd weights_at(double instant) const;

  /// By what factor a sum of the channels may exceed its largest absolute value at the instants, and at the
  /// places: 1 / cos(pi H / n) with the highest order H (Ehlich and Zeller 1964); infinite where H reaches
  /// n / 2, and 1 without a polynomial.
  double most_over_instants() const;
  double most_over_places() const;

  /// Amplitudes of the strongest orders that are not constant, at most `most_orders`, channels x orders.
  const Eigen::ArrayXXcd& strongest() const { return strongest_; }
  const Eigen::ArrayXd& orders() const { return orders_; }
  static constexpr Eigen::Index most_orders = 24;

private:
  void take_places();
  void take_strongest(const Eigen::ArrayXXcd& lines, const Eigen::ArrayXd& line_size);

  Eigen::ArrayXXd values_, fine_;
  Eigen::Index per_step_ = 1, highest_ = 0;
  bool is_polynomial_ = false, is_resolved_ = false;
  Eigen::ArrayXXcd strongest_;
  Eigen::ArrayXd orders_;
};

}  // namespace pipelines
