/// Tables 1 to 7 of the paper on the root peeler MOK-150, from a train: its own, or another one by its
/// procedure.
///
/// Source: I. N. Zapletnikov, D. G. Popov, "Dynamic model of machines of cleaning of root crops on turning
/// vibrations" (2016). Errata, which the tables hold on purpose: kinetics/README.md.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "kinetics/drive_train.h"

namespace kinetics {

/// A chain of inertias as a table lists it: inertia i, then the element that joins it with inertia i + 1.
struct PublishedChain {
  std::vector<std::string> inertia, element;  ///< names, in the order of the table
  Eigen::ArrayXd inertia_kg_m2;
  Eigen::ArrayXd stiffness_N_m_rad;
  Eigen::ArrayXd torque_Nm;     ///< M of (16), one of each inertia; real, not reduced (erratum 6)
  double excitation_rad_s = 0;  ///< w of (17): the number of Hz taken as rad/s (erratum 2)
  std::string shaft;            ///< the shaft line that it is reduced to; empty: nothing is reduced
};

struct PublishedTables {
  PublishedChain given;         ///< Table 1: every value on its own shaft
  PublishedChain motor_side;    ///< Tables 2 and 3: reduced to the first shaft, (3)-(7)
  PublishedTable table_4;       ///< modes and forced angles of it, (9)-(18)
  PublishedChain working_side;  ///< Tables 5 and 6: reduced to the last shaft, in reverse order
  PublishedTable table_7;       ///< modes and forced angles of it
  /// Tables 4 and 7 agree with the paper's print in all 58 numbers: 40 of modes and 10 of forced angles to
  /// half a unit of the seventh decimal, 8 frequencies with their fractions cut off. True of the paper's own
  /// data only.
  bool is_printed = false;
};

/// The tables of a chain that is given from the motor on. Columns of modes have unit length. Where
/// is_printed, their signs are the print's; else the largest entry of each is positive.
/// @throws MachineRefused as published_table_4
PublishedTables published_tables(const DriveTrain& train);

}  // namespace kinetics
