/// Private precompiled header of the files of fem that need deal.II. The code builds without it too.
#pragma once

#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <string>
#include <vector>
