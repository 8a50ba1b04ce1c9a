#include "fem/solvers/solve_on_ranks.h"

#include <optional>
#include <string>
#include <utility>

#include "fem/common/memory.h"
#include "fem/mesh/cell_order.h"
#include "fem/ranks/ranks.h"
#include "fem/solvers/direct_on_ranks.h"
#include "fem/solvers/iterative_on_ranks.h"
#include "fem/solvers/solver_prediction.h"
#include "fem/values/errors.h"

namespace fem {

namespace {

enum class Factor { solved, too_expensive, does_not_fit };

/// What rank 0 tells of its solution, beside displacements.
struct Told {
  Factor outcome = Factor::solved;
  double residual = 0, rounding = 0, support_reaction = 0, factor_gigabytes = 0, bytes = 0;
  FactorSize factor{};
  bool is_even = false;
};

class Solving {
public:
  Solving(const BodyOfRanks& body, const std::function<BalancedLoads(const RankPart&)>& loads,
          const StepReport& progress, SolverReport& report)
      : body_(body), loads_(loads), progress_(progress), report_(report) {}

  /// Nothing if it gives up, which the report then tells.
  std::optional<PartSolution> iterate(const SolverChoice& choice) const {
    std::string failure;
    try {
      const double modulus_Pa = body_.materials.largest_modulus_Pa();
      PartSolution found{part(weights_of_iteration(n_ranks(body_.communicator)), modulus_Pa), {}};
      const auto loads = loads_(found.part);
      if (auto solution = solve_iteratively_on_ranks(body_.grid, body_.cells, body_.materials, found.part,
                                                     loads, choice, progress_, failure, body_.communicator)) {
        found.solution = std::move(*solution);
        return found;
      }
    } catch (const FailedTogether& error) {
      failure = error.what();
    }
    turn_to_factor(failure, report_);
    return std::nullopt;
  }

  PartSolution factorise() const {
    PartSolution found{even_part(), {}};
    found.solution = solve_directly_on_ranks(body_.grid, body_.cells, found.part, loads_(found.part),
                                             progress_, body_.communicator);
    return found;
  }

  /// On rank 0.
  /// @param limited  not if it turns out too expensive
  std::optional<PartSolution> factorise_halves(bool limited, std::shared_ptr<const FactorisedBody>* kept,
                                               Factor& outcome) const {
    PartSolution found{even_part(), {}};
    auto loads = loads_(found.part);
    const auto n_loads = loads.force.cols();
    loads.force = on_first(body_.grid, found.part, loads.force, body_.communicator);
    Told told;
    std::optional<Solution> whole;
    on_first_rank(body_.communicator, [&] {
      DirectSolveOptions options;
      options.kept = kept;
      if (limited)
        options.is_too_expensive = [&](const FactorSize& factor) {
          return is_too_expensive(factor, report_, std::size_t(n_loads));
        };
      try {
        whole = solve_by_halves(*body_.half(), body_.materials, loads, progress_, std::move(options));
        told.outcome = whole ? Factor::solved : Factor::too_expensive;
      } catch (const DoesNotFit&) {
        told.outcome = Factor::does_not_fit;
      }
      if (whole)
        told = {
            told.outcome, whole->residual, whole->rounding, whole->support_reaction, whole->factor_gigabytes,
            whole->bytes, whole->factor,   whole->is_even};
    });
    take_from_first(body_.communicator, &told, sizeof told);
    outcome = told.outcome;
    if (outcome != Factor::solved) return std::nullopt;
    auto& solution = found.solution;
    solution.residual = told.residual;
    solution.rounding = told.rounding;
    solution.support_reaction = told.support_reaction;
    solution.factor_gigabytes = told.factor_gigabytes;
    solution.bytes = told.bytes;
    solution.factor = told.factor;
    solution.is_even = told.is_even;
    solution.displacement = from_first(
        body_.grid, found.part, whole ? whole->displacement : Eigen::MatrixXd(), n_loads, body_.communicator);
    return found;
  }

  /// As rank 0 finds it: free memory differs.
  bool may_be_iterated(const SolverChoice& choice) const {
    char may = fem::may_be_iterated(body_.grid, body_.materials, choice, report_, free_memory()) ? 1 : 0;
    take_from_first(body_.communicator, &may, 1);
    return may != 0;
  }

private:
  RankPart part(const std::vector<double>& weights, double modulus_Pa) const {
    return {body_.grid, body_.cells, body_.materials.elastic(modulus_Pa), this_rank(body_.communicator),
            weights};
  }
  RankPart even_part() const { return part(even_weights(n_ranks(body_.communicator)), 1); }

  const BodyOfRanks& body_;
  const std::function<BalancedLoads(const RankPart&)>& loads_;
  const StepReport& progress_;
  SolverReport& report_;
};

}  // namespace

PartSolution solve_on_ranks(const BodyOfRanks& body,
                            const std::function<BalancedLoads(const RankPart&)>& loads, SolverChoice choice,
                            const StepReport& progress, SolverReport& report,
                            std::shared_ptr<const FactorisedBody>* kept) {
  const Solving solving(body, loads, progress, report);
  choice.coarse_level = report.coarse_level;
  if (report.used == Solver::iterative)
    if (auto found = solving.iterate(choice)) return std::move(*found);
  if (body.half() == nullptr) return solving.factorise();
  Factor outcome{};
  if (auto found = solving.factorise_halves(true, kept, outcome)) return std::move(*found);
  if (outcome == Factor::does_not_fit && !solving.may_be_iterated(choice)) return solving.factorise();
  report.used = Solver::iterative;
  report.reason += outcome == Factor::does_not_fit ? ", but the factor does not fit into memory"
                                                   : ", but the factor is expensive";
  if (outcome == Factor::does_not_fit) choice.max_iterations *= patience;
  if (auto found = solving.iterate(choice)) return std::move(*found);
  if (outcome == Factor::does_not_fit) return solving.factorise();
  if (auto found = solving.factorise_halves(false, kept, outcome)) return std::move(*found);
  return solving.factorise();
}

}  // namespace fem
