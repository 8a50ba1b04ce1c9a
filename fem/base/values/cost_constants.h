/// The fitted constants of what solving costs, in one table. Formulas: solve/solvers/solver_prediction.h.
///
///   machine  AMD EPYC of 2023 (AVX2, AVX-512), two threads, nothing else running; seconds are half the CPU
///            seconds of both threads, or those of one where a factor stays on it
///   date     2026-11-21, the analysed factor 2026-11-22
///
/// On another machine all seconds change alike, within a factor of three. A refit is due when a solver
/// changes: `tests/benchmarks/run solvers` prints seconds and bytes beside what is predicted. What
/// superposition takes is in pipelines/study/accuracy/cost_forecast.cc.
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

// The iterative solver: PETSc 3.18 with the same options on the mill's shaft and chamber, STEP parts and the
// benchmark shaft, 61 k to 1.26 M unknowns, aspect up to 66; 2026-11-27, CPU seconds of one thread beside
// other work, within a third. `tests/benchmarks/run solvers` prints them beside what it measures.
inline constexpr double iteration_steps = 10, iteration_steps_per_aspect = 0.5;
inline constexpr double iteration_s_per_dof = 3.3e-6;  // of each step and load
inline constexpr double iteration_setup_s_per_dof = 3e-5, iteration_bytes_per_dof = 5700;
// MUMPS' factor of the lower level, of unknowns of the upper one to 4/3: 2.39 GB of 1.5 M on the benchmark
// shaft, 2026-11-29, `-fem_ksp_view`.
inline constexpr double lower_factor_bytes = 14;

// A run beside the solver: the program; for each unknown the mesh, and for each load its vectors.
inline constexpr double program_bytes = 2e8, grid_bytes_per_dof = 40, load_bytes_per_dof = 16;

// Harmonics around the axis: of one unknown of one harmonic, on shafts.
inline constexpr double harmonic_s_per_dof = 2e-5;

// A few natural frequencies, on shafts, drums and parts of 63 k to 282 k unknowns; three submodels of a weld
// toe under 29 loads, on a chamber of hexahedra. Mostly one thread; 2026-11-27, within a half.
inline constexpr double frequencies_s_per_dof = 1.2e-4;
inline constexpr double submodels_s_per_toe = 4.5;

}  // namespace fem::cost
