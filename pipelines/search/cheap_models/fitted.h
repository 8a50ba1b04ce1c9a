/// Constants of this wing that measurements made, each with its source; those of errors that any mesh has
/// stand in judge/estimates/fitted.h, what changes from section to section tell in section_changes.cc. Others
/// stand where they are used, with their reason.
#pragma once

#include <cstddef>

namespace pipelines::fitted {

// ---- Beams ----

/// What a fillet makes of stress that comes from a section going oval, at most. Source: published factors in
/// bending, which end there for fillets of a twentieth of the diameter.
inline constexpr double fillet_of_oval_section = 2;
/// What a shoulder adds to the stress of a cylinder that turns, at most. Source: of 498 random shafts one had
/// 11 %.
inline constexpr double spin_at_shoulders = 1.25;
/// On the tractions of torque and axial force. Source: 1.25 bounds the stress of 155 random shafts with such
/// loads on seats from a twelfth of their diameter on.
inline constexpr double traction_safety = 1.5;

// ---- Harmonics ----

/// Error of torsional stress on one section alone. Source: the largest of 53 twisted shafts was 0.31 %, but
/// for what lies between rings.
inline constexpr double error_of_one_section = 0.02;
/// Tolerances from here down take a third section even where two meet them, unless the second has more
/// unknowns than this. Source: at 1 % two sections stated 6 times the error, in the median of thirteen
/// shafts, three 3.6 times; a third has four times the unknowns of the second, some 12 us each (AMD EPYC,
/// 2026-11-29).
inline constexpr double asks_for_order = 0.01;
inline constexpr std::size_t most_before_order = 150000;
/// Of a node's value inside, where sections keep their points. Source: a seat that is tilted had 6.86 MPa at
/// 16 mm from the axis, where the solid had 7.06 at 15 mm.
inline constexpr double unseen_inside = 0.04;
/// Error of the first section's stresses where they are at least half of the largest. Source: within 2.3 % of
/// the last one's on 30 shafts drawn at random.
inline constexpr double error_of_guide = 0.05;

// ---- Local refinement of hexahedra ----

/// Cells are cut by falling contribution to a goal until this share of the sum is reached (Doerfler 1996).
/// Source: with 0.6 the default chamber took five meshes to 5 %, with 0.8 four of about the same size, with
/// 0.92 four of up to 409 k unknowns. Where less is enough to meet the tolerance, less is cut, but not below
/// the second one: the steps would be too many.
inline constexpr double most_that_is_cut = 0.8, least_that_is_cut = 0.4;
/// What is aimed at, of the error that a place may have, on surfaces and at weld toes. Source: with 0.5 at
/// toes the default chamber took 270 k unknowns to 2 %, not 208 k. And what cells contribute less once they
/// are cut, at least.
inline constexpr double aim = 0.5, aim_at_toes = 0.75, gain_of_cutting = 0.75;
/// The share of the sum of all contributions to a goal that counts as an error. Source: on surfaces the sum
/// was 2 to 5 times the true error of the default shaft; at weld toes, whose two nodes make the dual stress
/// steep, 7 times and more of that of the default chamber.
inline constexpr double share_on_surfaces = 0.5, share_at_toes = 0.25;
/// The order of a fillet's stress beside larger cells. Source: 8 and 16 cells on one that held 152.2 MPa gave
/// 146.9 and 150.2.
inline constexpr double order_of_halving = 1.5;

// ---- Tetrahedra ----

/// Cells with polynomials of degree 2, those on the surface among them. Source: unit test described_bodies.
inline constexpr double unknowns_per_hexahedron = 27, unknowns_per_tetrahedron = 5;
/// CPU seconds of an unknown, but for meshing, and what each unknown more adds to that. Source: runs on one
/// thread (AMD EPYC of 2023, 2026-11-26): blocks with a hole of 45 k and 79 k unknowns 2.3 and 4 s, plates
/// with 40 holes of 197 k, 352 k and 747 k 14, 28 and 85 s, a shaft with a small fillet of 303 k 25 s.
inline constexpr double s_per_dof = 4e-5, s_per_dof_of_factor = 8.5e-8;

}  // namespace pipelines::fitted
