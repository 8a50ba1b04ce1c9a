/// Whether a mesh of so many cells can be held at all.
#pragma once

#include <string>

namespace meshes {

/// Memory that a mesh takes until its body is ready to be solved: gmsh's, ours and the solver's cells. From
/// the largest memory of `check`, less the program's 0.2 GB: 2.8 kB per hexahedron (277 000 of them); 7 kB
/// per tetrahedron (78 000), with the analysis of a factor that larger meshes do without. The least that can
/// be meant is taken, so that nothing is refused that might be solved.
constexpr double bytes_per_hexahedron = 3000, bytes_per_tetrahedron = 2000;

/// Memory of the machine, bytes.
double machine_memory_bytes();

/// @param control  the field that asks for the cells, as in TooManyCells
/// @throws TooManyCells with the estimate, the memory it takes and what the machine has, and the remedy
void require_affordable(double n_cells, double bytes_per_cell, const std::string& control,
                        const std::string& remedy);

}  // namespace meshes
