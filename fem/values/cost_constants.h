/// The fitted constants of what solving costs, in one table. Formulas: solvers/solver_prediction.h.
///
///   machine  AMD EPYC of 2023 (AVX2, AVX-512), two threads, nothing else running; seconds are half the CPU
///            seconds of both threads, or those of one where a factor stays on it
///   date     2026-11-21, the analysed factor 2026-11-22
///   refit    tests/benchmarks/run solvers fit 4.1e6    prints what it measured, and each constant anew
///
/// On another machine all seconds change alike, within a factor of three: a refit is due when a solver
/// changes. What superposition takes is in pipelines/study/accuracy/cost_forecast.cc.
#pragma once

namespace fem::cost {

// The direct solver by unknowns alone, N = unknowns / 2e5; shafts and rods, 50 k to 700 k unknowns.
inline constexpr double direct_unit = 2e5;
inline constexpr double direct_s_linear = 10.8, direct_s_square = 12.6;  // of N, of N^2
inline constexpr double direct_s_per_load = 0.03;                        // of N^1.3
inline constexpr double direct_bytes = 3.4e9, direct_exponent = 1.3;     // of N^1.3

// The direct solver by its analysed factor, with recovery; shafts, drums, chambers, 67 k to 335 k unknowns.
inline constexpr double factor_s_per_dof = 1.4e-5;
inline constexpr double factor_s_per_flop_alone = 6e-11, factor_s_per_flop_shared = 3.5e-11;
inline constexpr double factor_s_per_entry = 2.3e-10, factor_s_per_response = 2.4e-7;  // for each load

// The iterative solver; shafts and rods, aspect 2.7 to 7, 50 k to 4 M unknowns.
inline constexpr double iterations_first = 8, iterations_per_aspect = 2.3;
inline constexpr double iteration_s_per_dof = 8e-8;  // and load
inline constexpr double iterative_setup_s_per_dof = 2e-6;
inline constexpr double iterative_bytes_per_dof = 215, iterative_bytes_per_lane = 48;

// Its trilinear level of m unknowns as a factor: c = coarse_factor_s (m / 2e5)^1.75 seconds.
inline constexpr double coarse_factor_s = 7, coarse_factor_exponent = 1.75;
inline constexpr double coarse_factor_setups = 3, coarse_factor_solves = 0.25;  // of c: once, each iteration
// The same by aggregation.
inline constexpr double aggregates_more_iterations = 1.1;
inline constexpr double aggregates_setup_s_per_dof = 8e-6, aggregates_bytes_per_dof = 1100;

// Of a run beside the solver: the program; for each unknown the mesh, and for each load its vectors.
inline constexpr double program_bytes = 2e8, grid_bytes_per_dof = 40, load_bytes_per_dof = 16;

// Harmonics around the axis: of one unknown of one harmonic, on shafts.
inline constexpr double harmonic_s_per_dof = 2e-5;

// A few natural frequencies, on shafts, drums and parts of 63 k to 282 k unknowns; three submodels of a weld
// toe under 29 loads, on a chamber of hexahedra. Mostly one thread; 2026-11-27, within a half.
inline constexpr double frequencies_s_per_dof = 1.2e-4;
inline constexpr double submodels_s_per_toe = 4.5;

}  // namespace fem::cost
