/// A stress and what it may be wrong by, in words for terminal and report.
#pragma once

#include <string>

#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/estimates/search_record.h"

namespace pipelines {

/// With that many decimals; numbers that no column holds, or that would show as zero, with an exponent.
std::string fixed(double value, int decimals);

/// With one decimal, or as many as a small error has: else rounding would put the number outside of what is
/// stated for it. A stress below 1 MPa has at least three digits.
/// @param error_Pa  stated beside it; 0: none
std::string stress_in_MPa(double value_Pa, double error_Pa);

/// "105.2 +- 3.4": four digits at most; the error is rounded up to the last of them, so that what is shown is
/// never narrower than what is stated. "105.2 +- ?" where the error is not known (infinite).
/// @param unit  of what is shown over SI: 1e6 for MPa
std::string with_error(double value, double error, double unit = 1e6);

/// "105.2 +- 3.4 MPa, 2.1 of it from load patches": the whole error, and its sources that no mesh lowers.
std::string value_with_shares(double value_Pa, const ErrorBudget& errors);

/// "105.2 MPa +- 1.3 (numerical) and +- 2.1 from load patches, which no mesh lowers". The numerical part is
/// what a tolerance is compared with. Sources of the model below a thousandth of the stress are left out.
std::string value_with_errors(double value_Pa, const ErrorBudget& errors);

/// "bore cover_1/shell (9.2 mm), bore shell/cover_2 (9.2 mm)": the sharp corners of the model and within
/// which distance they are left out, the first four. Empty where there are none, and of bodies whose corners
/// are weld toes.
std::string corners_left_out(const Judged& analysis);

/// "30.8 MPa +- 12.8 MPa (42 %): discretisation; remedy: --tolerance "5 %"" where the whole error exceeds
/// largest_plain_error, with the largest source; else empty.
/// @param search  how the mesh was found; its steps are empty if it was the scene's own
std::string not_known_well(const GoverningStress& stress, const Search& search);

/// "discretisation; remedy: --tolerance "5 %"": the largest source of an error, and what lowers it.
/// @param search  likewise
std::string remedy_of_error(const ErrorBudget& errors, const Search& search);

/// "the stress rises towards the sharp inner edge a/b, of which 1.8 mm are left out, ...": where the peak
/// leads and lies at the border of what is left out; else empty. With what would give a stress to judge.
std::string rises_towards_edge(const Judged& analysis);

/// "shaft, step 2: 86865 unknowns, 104.9 MPa known to 2.5 %, 4.3 s": the last step, as it is told meanwhile.
std::string text_of_step(const std::string& body, const Search& search);

/// Relative. A stress that is known no better is stated as such, first, with what would help.
inline constexpr double largest_plain_error = 0.2;

}  // namespace pipelines
