/// Constants of this wing that measurements made, each with its source. Others stand where they are used,
/// with their reason; those of the solvers' seconds in fem/base/values/cost_constants.h,
/// discretisation_safety, which every entry of a budget has, in error_budget.h.
#pragma once

namespace pipelines::fitted {

// ---- Cells ----

/// A bored shaft may have a single cell through its wall: times discretisation_safety. Source: a disc that
/// spins, whose outer radius is four times the inner: the stress at the bore was off by 4.4 times what single
/// cells differ by.
inline constexpr double safety_of_few_rows = 1.5;

/// With fewer cells on its quarter a fillet's stress does not converge with its order yet. Source: two meshes
/// agreed that were both wrong (a stress of 152 MPa was 130 with two cells and 132 with four), and 3 of 12
/// shafts halved from 4 to 8 cells were off by up to 1.4 times what second order made of the change.
inline constexpr int cells_that_converge = 6;

/// Relative error of a fillet's stress with fewer than 4 cells on its quarter, with fewer than 6, with fewer
/// than 6 that were cut amid larger ones, and with more. Source of the third: four of them were up to 21 %
/// off.
inline constexpr double below_4_cells = 0.5, below_6_cells = 0.15, below_6_cells_refined = 0.25,
                        from_6_cells = 0.04;

/// Multiplies the differences of cells between a straight and a curved stress. Source: harmonics had zones of
/// 2036 and 2070 mm3 where finer solids come to 2116.
inline constexpr double safety_between_nodes = 1.5;

// ---- Beside sharp edges ----

/// Relative error on the border of what is left out around a sharp edge, with n cells to it: of_one /
/// n^order. Source: shoulders of blocks, where solids were 17 % too high with one cell, 5.5 % with 2.5, 1.2 %
/// with 5. With tetrahedra, within one cell of the edge the stress is as steep as the interpolant of r^0.54,
/// 34 % too high, so that a quarter of it is not there
/// (tests/unit/fem/stress/recovery/sharp_edges_have_two_sides.cc); from one cell on it falls as beside
/// blocks, 3 to 4 % with two (tests/verification/sharp_edges).
inline constexpr double border_order = 1.25, border_of_one_block = 0.2, border_of_one_tetrahedron = 0.12,
                        border_within_first_tetrahedron = 0.25;

// ---- Tetrahedra ----

/// error / stress = max(factor d^exponent, least_share d), tetrahedra_estimate.h. Source:
/// tests/benchmarks/run step_parts, five shafts with 8 to 26 cells around a circle.
inline constexpr double tetrahedra_factor = 12, tetrahedra_exponent = 1.5, tetrahedra_least_share = 0.5;

/// What cells around tell of a place that a submodel should have looked at: the estimate is calibrated on the
/// largest places of shafts, and cells around one node agree by chance.
inline constexpr double unasked_safety = 2;

// ---- Weld toes ----

/// Error that toes may have that are not resolved: less than their own cells tell, which end at the toe.
/// Source: submodels move the stress of toes by 3 to 22 % on meshes of a search.
inline constexpr double largest_error_of_toes = 0.5;
/// Longest face at the toe for which that holds, in plate thicknesses. Source: toes of the default chamber,
/// which show down to two fifths of their stress with faces of 0.8, an eighth with 1.6.
inline constexpr double longest_face_walls = 0.5;

// ---- Harmonics ----

/// Where a fillet of an eccentric segment has its largest stress, the offset of the axis is at its most; on
/// the side of the lower step harmonics are further off by this. Source: 162 and 76 MPa where solids have 121
/// and 59, and the shares of the largest stress are 20 and 9 MPa.
inline constexpr double times_elsewhere_on_fillet = 2.5;

// ---- Nearly incompressible material ----

/// Share of the stress that quadratic hexahedra miss from Poisson's ratio `locking_from` on, by locking:
/// locking_most / (1 + (1 - 2 nu) / locking_half_way). Source: tests/cases/program/stepped_shaft.h, 4 to 8
/// cells on a quarter, against axisymmetric harmonics of degree 3, which the same material changes by 0.2 %:
/// beyond what nu = 0.3 shows, 1, 3, 12 and 27 % are missing at nu = 0.49, 0.495, 0.499 and 0.4999; twice the
/// curve through these.
inline constexpr double locking_from = 0.45, locking_most = 0.6, locking_half_way = 1.5e-3;

}  // namespace pipelines::fitted
