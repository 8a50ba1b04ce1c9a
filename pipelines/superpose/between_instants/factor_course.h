/// Time factors of a cycle at more places than its instants: of the trigonometric polynomial through them,
/// where it is close to the true course.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace pipelines {

class FactorCourse {
public:
  /// @param values      channels x n instants, equidistant over one period
  /// @param size        size of the stress that one unit of each channel brings at most [Pa]: what does not
  ///                    stress the body does not count
  /// @param per_period  places in a period of a single harmonic, at least; with several so many that crests
  ///                    are missed by no more of the largest channel
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

  /// The instant that has all the weight there; none between instants of a polynomial.
  std::optional<Eigen::Index> instant_alone(double instant) const;

  /// A sum over the places as one over the instants: of weights of places those of the instants, so that
  /// sum w(p) fine(p) = sum result(i) values(i).
  /// @param by_place  rows x (n per_step())
  Eigen::MatrixXd by_instant(const Eigen::MatrixXd& by_place) const;

  /// Part of a crest by which each channel may exceed what the instants, or the places, tell: the sum over
  /// its lines of size min(2, (pi h / n)^2 / 2) (factor_spectrum.h, instants_for). A crest of a sum of
  /// channels is missed by the sum of these at most. Zeros without a polynomial.
  Eigen::ArrayXd missed_by_instants() const { return missed_by(double(values_.cols())); }
  Eigen::ArrayXd missed_by_places() const { return missed_by(double(values_.cols() * per_step_)); }

  /// Amplitudes of the strongest orders that are not constant, at most `most_orders`, channels x orders.
  const Eigen::ArrayXXcd& strongest() const { return strongest_; }
  const Eigen::ArrayXd& orders() const { return orders_; }
  static constexpr Eigen::Index most_orders = 24;

private:
  Eigen::ArrayXd missed_by(double n) const;
  void take_places();
  void take_angles();
  void take_strongest(const Eigen::ArrayXXcd& lines, const Eigen::ArrayXd& line_size);

  Eigen::ArrayXXd values_, fine_;
  Eigen::ArrayXXd line_sizes_;      // channels x orders
  Eigen::ArrayXd cosines_, sines_;  // cosines and sines of pi j / n
  Eigen::Index per_step_ = 1;
  bool is_polynomial_ = false, is_resolved_ = false;
  Eigen::ArrayXXcd strongest_;
  Eigen::ArrayXd orders_;
};

}  // namespace pipelines
