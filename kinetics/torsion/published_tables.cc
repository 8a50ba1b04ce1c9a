#include "kinetics/published_tables.h"

#include <cmath>

#include "kinetics/torsion_chain/published_chain.h"
#include "kinetics/torsion_chain/reduced.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

constexpr Index n_masses = 5, n_modes = 4;

/// What the paper prints in a table of results.
struct PrintedTable {
  double frequency[n_modes];  ///< fractions cut off
  double mode[n_modes][n_masses];
  double forced_angle_rad[n_masses];
};

constexpr PrintedTable printed_table_4{{164231, 8536, 4747, 1466},
                                       {{0.0, -0.0000006, 0.0014338, -0.999999, 0.0001678},
                                        {0.2446928, -0.9692876, 0.0221572, 0.0107518, -0.0007118},
                                        {-0.1368408, 0.0731377, 0.8980491, 0.3992232, -0.1002703},
                                        {-0.7597271, -0.6485278, 0.0020699, 0.0219065, 0.0417396}},
                                       {0.0663366, 0.0665436, 0.0675259, 0.0675604, 0.0675949}};

constexpr PrintedTable printed_table_7{{164231, 8084, 4659, 591},
                                       {{0.0001678, -0.999999, 0.0014337, -0.0000001, 0.0},
                                        {0.000127, -0.0017083, -0.0035354, 0.9604696, -0.2783571},
                                        {-0.1058473, 0.4019974, 0.9091945, 0.0102029, -0.0213482},
                                        {0.036954, 0.034096, 0.0312372, -0.6973069, -0.7143242}},
                                       {-0.0674786, -0.0674834, -0.0674883, -0.0684727, -0.0685019}};

/// Half a unit of the seventh decimal, and what the decimal numbers above miss of it.
constexpr double half_digit = 0.5000001e-7;

/// The sign of an eigenvector is free: the one with the largest entry positive.
void turn_largest_positive(PublishedTable& table) {
  for (Index k = 0; k < table.mode.cols(); ++k) {
    Index largest = 0;
    table.mode.col(k).abs().maxCoeff(&largest);
    if (table.mode(largest, k) < 0) table.mode.col(k) = -table.mode.col(k);
  }
}

/// Whether a table is the printed one; its modes then get the signs of the print.
bool turn_as_printed(PublishedTable& table, const PrintedTable& printed) {
  if (table.mode.rows() != n_masses || table.mode.cols() != n_modes) return false;
  ArrayXXd mode = table.mode;
  for (Index k = 0; k < n_modes; ++k) {
    const Eigen::Map<const ArrayXd> wanted(printed.mode[k], n_masses);
    if ((mode.col(k) * wanted).sum() < 0) mode.col(k) = -mode.col(k);
    if ((mode.col(k) - wanted).abs().maxCoeff() > half_digit) return false;
    if (std::floor(table.frequency_rad_s[k]) != printed.frequency[k]) return false;
  }
  const Eigen::Map<const ArrayXd> angle_rad(printed.forced_angle_rad, n_masses);
  if ((table.forced_angle_rad - angle_rad).abs().maxCoeff() > half_digit) return false;
  table.mode = mode;
  return true;
}

}  // namespace

PublishedTables published_tables(const DriveTrain& train) {
  PublishedTables tables;
  tables.motor_side = torsion::chain_of_motor(train);
  tables.working_side = torsion::chain_of_working_shaft(train);
  tables.table_4 = torsion::table_4_of(tables.motor_side);
  tables.table_7 = torsion::table_7_of(tables.working_side);
  tables.given = tables.motor_side;
  tables.given.shaft.clear();
  for (std::size_t i = 0; i < train.inertias.size(); ++i)
    tables.given.inertia_kg_m2[Index(i)] = train.inertias[i].inertia_kg_m2;
  for (std::size_t e = 0; e < train.elements.size(); ++e)
    tables.given.stiffness_N_m_rad[Index(e)] = torsion::stiffness_N_m_rad(train.elements[e]);
  for (PublishedTable* table : {&tables.table_4, &tables.table_7}) turn_largest_positive(*table);
  PublishedTable turned_4 = tables.table_4, turned_7 = tables.table_7;
  tables.is_printed =
      turn_as_printed(turned_4, printed_table_4) && turn_as_printed(turned_7, printed_table_7);
  if (tables.is_printed) tables.table_4 = turned_4, tables.table_7 = turned_7;
  return tables;
}

}  // namespace kinetics
