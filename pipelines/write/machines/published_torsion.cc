#include "pipelines/write/machines/published_torsion.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "pipelines/base/common/finite.h"
#include "pipelines/base/files/csv.h"

namespace pipelines {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using kinetics::PublishedChain;
using kinetics::PublishedTable;
using kinetics::PublishedTables;
using PublishedJson = nlohmann::ordered_json;

const char* const printed_agreement =
    "Tables 4 and 7 agree with the paper's print in all 58 numbers: modes and angles to the last digit, "
    "frequencies with their fractions cut off";
const char* const other_train =
    "by the paper's procedure for this train, whose data are not the paper's: its print has other numbers";

/// Seven decimals, as printed; zero without a sign.
std::string decimals_of(double value) {
  return fmt::format("{:.7f}", std::abs(value) < 0.5e-7 ? 0 : value);
}

std::string heading_of(const char* name, const PublishedChain& chain) {
  const auto excitation = fmt::format("excitation {:.6g} rad/s, printed there as Hz", chain.excitation_rad_s);
  return chain.shaft.empty() ? fmt::format("{}: every value on its own shaft", name)
                             : fmt::format("{}: reduced to the shaft {}; {}", name, chain.shaft, excitation);
}

void print_chain(std::ostream& out, const char* name, const PublishedChain& chain) {
  out << fmt::format("\n  {}\n    {:<20}{:>14}{:>12}   {:<20}{:>14}\n", heading_of(name, chain), "inertia",
                     "J kg m2", "M N m", "element to the next", "C N m/rad");
  for (std::size_t i = 0; i < chain.inertia.size(); ++i) {
    out << fmt::format("    {:<20}{:>14.7g}{:>12.6g}", chain.inertia[i], chain.inertia_kg_m2[Index(i)],
                       chain.torque_Nm[Index(i)] + 0.0);
    if (i < chain.element.size())
      out << fmt::format("   {:<20}{:>14.8g}", chain.element[i], chain.stiffness_N_m_rad[Index(i)]);
    out << '\n';
  }
}

/// Erratum 3: Table 4 adds w^2 J where it must be taken away.
bool has_wrong_sign(const PublishedTable& table) {
  return (table.forced_angle_rad != table.right_sign_angle_rad).any();
}

void print_results(std::ostream& out, const char* name, const PublishedChain& chain,
                   const PublishedTable& table) {
  const bool has_other = has_wrong_sign(table);
  out << fmt::format(
      "\n  {}: modes of unit length by frequency (rad/s, printed there as Hz), forced angles (rad)\n    "
      "{:<20}",
      name, "inertia");
  for (const double w : table.frequency_rad_s) out << fmt::format("{:>12.2f}", w);
  out << fmt::format("{:>14}{}\n", "forced", has_other ? "    right sign" : "");
  for (std::size_t i = 0; i < chain.inertia.size(); ++i) {
    out << fmt::format("    {:<20}", chain.inertia[i]);
    for (const double x : table.mode.row(Index(i))) out << fmt::format("{:>12}", decimals_of(x));
    out << fmt::format("{:>14}", decimals_of(table.forced_angle_rad[Index(i)]));
    if (has_other) out << fmt::format("{:>14}", decimals_of(table.right_sign_angle_rad[Index(i)]));
    out << '\n';
  }
}

PublishedJson list_of(const ArrayXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

PublishedJson chain_json(const PublishedChain& chain) {
  PublishedJson json;
  if (!chain.shaft.empty()) json["reduced_to"] = chain.shaft;
  for (std::size_t i = 0; i < chain.inertia.size(); ++i)
    json["inertias"].push_back({{"name", chain.inertia[i]},
                                {"inertia_kg_m2", chain.inertia_kg_m2[Index(i)]},
                                {"torque_Nm", chain.torque_Nm[Index(i)]}});
  for (std::size_t e = 0; e < chain.element.size(); ++e)
    json["elements"].push_back(
        {{"name", chain.element[e]}, {"stiffness_N_m_rad", chain.stiffness_N_m_rad[Index(e)]}});
  if (!chain.shaft.empty()) json["excitation_rad_s"] = chain.excitation_rad_s;
  return json;
}

PublishedJson results_json(const PublishedChain& chain, const PublishedTable& table) {
  PublishedJson json{{"inertias", chain.inertia}, {"frequency_rad_s", list_of(table.frequency_rad_s)}};
  for (Index k = 0; k < table.mode.cols(); ++k) json["modes"].push_back(list_of(table.mode.col(k)));
  json["forced_angle_rad"] = list_of(table.forced_angle_rad);
  if (has_wrong_sign(table)) json["right_sign_angle_rad"] = list_of(table.right_sign_angle_rad);
  return json;
}

CsvColumn column_of(const char* name, const char* unit, const ArrayXd& values) {
  return {name, unit, std::vector<double>(values.begin(), values.end())};
}

/// Between the last inertia and the next stands no element: its cells are empty.
void write_chain(const std::filesystem::path& file, const PublishedChain& chain) {
  auto elements = chain.element;
  std::vector<std::string> stiffness;
  for (const double value : chain.stiffness_N_m_rad) stiffness.push_back(shortest(value));
  elements.emplace_back();
  stiffness.emplace_back();
  write_csv(file, {{"inertia", "", chain.inertia},
                   column_of("J", "kg m2", chain.inertia_kg_m2),
                   column_of("M", "N m", chain.torque_Nm),
                   {"element", "", elements},
                   {"C", "N m/rad", stiffness}});
}

void write_modes(const std::filesystem::path& file, const PublishedChain& chain,
                 const PublishedTable& table) {
  std::vector<CsvColumn> columns{column_of("frequency", "rad/s", table.frequency_rad_s)};
  for (std::size_t i = 0; i < chain.inertia.size(); ++i)
    columns.push_back(
        column_of((chain.inertia[i] + ".shape").c_str(), "rad", table.mode.row(Index(i)).transpose()));
  write_csv(file, columns);
}

}  // namespace

void print_published(std::ostream& out, const PublishedTables& tables) {
  out << fmt::format("\n  tables of the paper, errata included: {}\n",
                     tables.is_printed ? printed_agreement : other_train);
  print_chain(out, "Table 1", tables.given);
  print_chain(out, "Tables 2 and 3", tables.motor_side);
  print_results(out, "Table 4", tables.motor_side, tables.table_4);
  print_chain(out, "Tables 5 and 6", tables.working_side);
  print_results(out, "Table 7", tables.working_side, tables.table_7);
}

nlohmann::ordered_json published_json(const PublishedTables& tables) {
  return {{"agrees_with_print", tables.is_printed},
          {"origin", tables.is_printed ? printed_agreement : other_train},
          {"table_1", chain_json(tables.given)},
          {"tables_2_3", chain_json(tables.motor_side)},
          {"table_4", results_json(tables.motor_side, tables.table_4)},
          {"tables_5_6", chain_json(tables.working_side)},
          {"table_7", results_json(tables.working_side, tables.table_7)}};
}

const std::vector<std::string>& published_files() {
  static const std::vector<std::string> names{"table_1.csv",        "tables_2_3.csv", "table_4_modes.csv",
                                              "table_4_forced.csv", "tables_5_6.csv", "table_7_modes.csv",
                                              "table_7_forced.csv"};
  return names;
}

void write_published(const std::filesystem::path& directory, const PublishedTables& tables) {
  const auto forced = [&](const char* name, const PublishedChain& chain, const PublishedTable& table) {
    std::vector<CsvColumn> columns{{"inertia", "", chain.inertia},
                                   column_of("forced_angle", "rad", table.forced_angle_rad)};
    if (has_wrong_sign(table))
      columns.push_back(column_of("right_sign_angle", "rad", table.right_sign_angle_rad));
    write_csv(directory / name, columns);
  };
  write_chain(directory / "table_1.csv", tables.given);
  write_chain(directory / "tables_2_3.csv", tables.motor_side);
  write_modes(directory / "table_4_modes.csv", tables.motor_side, tables.table_4);
  forced("table_4_forced.csv", tables.motor_side, tables.table_4);
  write_chain(directory / "tables_5_6.csv", tables.working_side);
  write_modes(directory / "table_7_modes.csv", tables.working_side, tables.table_7);
  forced("table_7_forced.csv", tables.working_side, tables.table_7);
}

}  // namespace pipelines
