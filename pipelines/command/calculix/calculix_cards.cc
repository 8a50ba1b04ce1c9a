#include "pipelines/command/calculix/calculix_cards.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <set>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/whole_file.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

const std::string about_ends = "); N, N m, s";  // end of the first line

constexpr std::size_t longest_name = 80;  // longest name that CalculiX reads

/// One load of one node set in one degree of freedom.
struct Card {
  std::string name, node_set;
  int degree_of_freedom;
  Eigen::ArrayXd values;
};

std::string card_name(const std::string& text) {
  std::string name;
  for (const char c : text)
    name +=
        std::isalnum(static_cast<unsigned char>(c)) ? char(std::toupper(static_cast<unsigned char>(c))) : '_';
  return name;
}

void add(const std::string& role, const std::string& component, const Eigen::ArrayXd& values,
         std::vector<Card>& cards) {
  if ((values == 0).all()) return;
  const bool is_moment = component == "torque" || component == "mx" || component == "my";
  const int axis = component == "fx" || component == "mx"   ? 1
                   : component == "fy" || component == "my" ? 2
                                                            : 3;
  const std::string set = "N_" + card_name(role) + (is_moment ? "_ROT" : "");
  cards.push_back({"A_" + card_name(role + "." + component), set, axis, values});
}

std::vector<Card> cards_of(const kinetics::LoadHistory& loads) {
  std::vector<Card> cards;
  for (const auto& resultant : loads.resultants) {
    add(resultant.role, "fx", resultant.total.row(0), cards);
    add(resultant.role, "fy", resultant.total.row(1), cards);
    add(resultant.role, "torque", resultant.total.row(2), cards);
  }
  for (const auto& quantity : loads.quantities) {
    const auto dot = quantity.name.rfind('.');
    const std::string component = dot == std::string::npos ? "" : quantity.name.substr(dot + 1);
    if (has_samples(loads) && (component == "fz" || component == "mx" || component == "my"))
      add(quantity.name.substr(0, dot), component, quantity.values, cards);
  }
  std::set<std::string> names;
  for (const auto& card : cards)
    if (card.name.size() > longest_name || !names.insert(card.name).second)
      throw StageRefused("the name " + card.name +
                         " of a card is used twice or longer than 80 characters: rename the port");
  return cards;
}

/// Room for every double, and few enough characters for eight in a line.
std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12E", value);
  return text;
}

std::string amplitude(const Card& card, const kinetics::LoadHistory& loads, bool repeats) {
  const Eigen::Index n = loads.n_instants(), last = repeats ? n : n - 1;
  const double period_s = n > 1 ? loads.time_s[n - 1] + (loads.time_s[1] - loads.time_s[0]) : 1;
  std::string text = "*AMPLITUDE, NAME=" + card.name + "\n";
  for (Eigen::Index i = 0; i <= last; ++i) {
    text += digits(i < n ? loads.time_s[i] : period_s) + "," + digits(card.values[i < n ? i : 0]);
    text += i % 4 == 3 || i == last ? "\n" : ",";
  }
  return text;
}

}  // namespace

CalculixCards calculix_cards(const kinetics::LoadHistory& loads, bool repeats) {
  CalculixCards result;
  std::set<std::string> sets;
  const std::string about = "** " + loads.machine + " (" + loads.convention + about_ends + "\n";
  result.amplitudes = about;
  result.loads = about;
  for (const Card& card : cards_of(loads)) {
    sets.insert(card.node_set);
    result.amplitudes += amplitude(card, loads, repeats);
    result.loads += "*CLOAD, AMPLITUDE=" + card.name + "\n" + card.node_set + "," +
                    std::to_string(card.degree_of_freedom) + ",1.\n";
  }
  result.node_sets.assign(sets.begin(), sets.end());
  return result;
}

std::vector<std::filesystem::path> calculix_card_files(const std::filesystem::path& prefix) {
  if (prefix.empty()) return {};
  return {prefix.string() + "_amplitudes.inp", prefix.string() + "_loads.inp"};
}

bool is_calculix_cards(const std::filesystem::path& file) {
  const std::string line = first_line(file);
  return line.compare(0, 3, "** ") == 0 && line.size() > about_ends.size() &&
         line.compare(line.size() - about_ends.size(), about_ends.size(), about_ends) == 0;
}

void write_calculix_cards(const std::filesystem::path& prefix, const kinetics::LoadHistory& loads,
                          bool repeats) {
  const auto cards = calculix_cards(loads, repeats);
  const auto files = calculix_card_files(prefix);
  write_text_file(files.at(0), cards.amplitudes, is_calculix_cards);
  write_text_file(files.at(1), cards.loads, is_calculix_cards);
}

}  // namespace pipelines
