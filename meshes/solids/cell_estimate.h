/// How many tetrahedra a mesh control asks for, told from volumes and areas before anything is meshed.
#pragma once

#include <map>
#include <string>

#include "meshes/solids/solid_control.h"

namespace meshes {

/// Number of cells that gmsh's current model needs, as built or imported by OpenCASCADE: regular tetrahedra
/// in the volumes, and three for each triangle of a surface whose curvature asks for shorter edges. Within a
/// factor of 3 of gmsh's meshes (unit test cell_estimates).
/// @param unit_m  length of the model's unit
double estimated_cells(const SolidControl& control, double unit_m);

/// The field that most of the cells are owed to where there are too many.
std::string control_of_cells(const SolidControl& control);

/// The shortest edge that curvature may ask for in gmsh's current model, in its unit: smallest_size_m, or if
/// that is not given a quarter of the shortest one that curvature within the surfaces asks for, and no longer
/// than the shortest curve and the edges in fine spots. At the tip of a cone curvature has no bound, and
/// cells would become ever smaller.
/// @param unit_m  length of the model's unit
double smallest_edge(const SolidControl& control, double unit_m);

/// Length of a curve, area of a surface or volume of gmsh's current model, by OpenCASCADE; 0 where not known.
double measure_of(int dimension, int tag);

/// The largest edges of cells along the curves of narrow surfaces, as chamfers and steps of a hair: cells
/// that are longer than some ten widths are as good as flat. A surface that would take thousands of them is
/// refused, or left alone where cells are small enough for it.
/// @return by the number of the curve, in the model's unit
/// @throws GeometryRefused naming the surface
std::map<int, double> sizes_along_narrow_surfaces(double smallest, double largest);

/// Refuses a tip that is more slender than 23 degrees in all: around it gmsh finds no triangles, whatever
/// their size.
/// @throws GeometryRefused naming the surface of gmsh's current model, its place and what helps
void refuse_slender_tips();

}  // namespace meshes
