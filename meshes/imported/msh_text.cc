#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <unordered_set>
#include <vector>

#include "meshes/imported/file_checks.h"
#include "meshes/values/refused.h"

namespace meshes {

namespace {

struct ElementType {
  int number, dimension, n_nodes;
};
/// Element types of gmsh's manual, section "MSH file format".
constexpr ElementType element_types[] = {
    {1, 1, 2},   {2, 2, 3},   {3, 2, 4},   {4, 3, 4},   {5, 3, 8},   {6, 3, 6},   {7, 3, 5},   {8, 1, 3},
    {9, 2, 6},   {10, 2, 9},  {11, 3, 10}, {12, 3, 27}, {13, 3, 18}, {14, 3, 14}, {15, 0, 1},  {16, 2, 8},
    {17, 3, 20}, {18, 3, 15}, {19, 3, 13}, {20, 2, 9},  {21, 2, 10}, {22, 2, 12}, {23, 2, 15}, {24, 2, 15},
    {25, 2, 21}, {26, 1, 4},  {27, 1, 5},  {28, 1, 6},  {29, 3, 20}, {30, 3, 35}, {31, 3, 56}, {36, 2, 16},
    {37, 2, 25}, {38, 2, 36}, {90, 3, 40}, {91, 3, 75}, {92, 3, 64}, {93, 3, 125}};

constexpr std::int64_t largest_number = std::numeric_limits<std::int32_t>::max();

/// Numbers of one section, one after the other.
class MshSection {
public:
  MshSection(const std::string& text, const std::string& name) : text_(text), name_(name) {
    const auto begin = find_line("$" + name), end = find_line("$End" + name);
    if (begin == std::string::npos) refuse_at(text.size(), "there is no section $" + name);
    if (end == std::string::npos || end < begin)
      refuse_at(text.size(), "there is no $End" + name + ": the file is cut off");
    at_ = text.c_str() + begin + name.size() + 1;
    end_ = text.c_str() + end;
  }

  double number(const std::string& what) {
    char* after = nullptr;
    const double value = std::strtod(at_, &after);
    pass(after, what);
    if (!std::isfinite(value)) refuse(what + " is not finite");
    return value;
  }
  std::int64_t integer(const std::string& what) {
    char* after = nullptr;
    const long long value = std::strtoll(at_, &after, 10);
    pass(after, what);
    return value;
  }
  std::int64_t between(std::int64_t least, std::int64_t most, const std::string& what) {
    const auto value = integer(what);
    if (value < least || value > most)
      refuse(what + " is " + std::to_string(value) + ", which must lie between " + std::to_string(least) +
             " and " + std::to_string(most));
    return value;
  }
  /// Reads the count of items that take at least so many numbers each; no more than the section has room for.
  std::size_t count(std::size_t n_numbers, const std::string& what) {
    return std::size_t(between(0, (end_ - at_) / std::int64_t(2 * n_numbers) + 1, what));
  }
  void skip(std::size_t n, const std::string& what) {
    for (std::size_t i = 0; i < n; ++i) number(what);
  }
  void require_end() {
    while (at_ < end_ && std::isspace(static_cast<unsigned char>(*at_))) ++at_;
    if (at_ < end_) refuse("section $" + name_ + " has more than its counts say");
  }
  [[noreturn]] void refuse(const std::string& what) const {
    refuse_at(std::size_t(at_ - text_.c_str()), what);
  }

private:
  /// Place of a line that begins so.
  std::size_t find_line(const std::string& line) const {
    auto at = text_.find(line);
    while (at != std::string::npos && ((at > 0 && text_[at - 1] != '\n') ||
                                       std::isalnum(static_cast<unsigned char>(text_[at + line.size()]))))
      at = text_.find(line, at + 1);
    return at;
  }
  [[noreturn]] void refuse_at(std::size_t place, const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + long(place), '\n');
    throw GeometryRefused("line " + std::to_string(line) + ": " + what + "; write the mesh again");
  }
  void pass(const char* after, const std::string& what) {
    if (after == at_ || after > end_) refuse("a number is missing where " + what + " is wanted");
    at_ = after;
  }

  const std::string& text_;
  std::string name_;
  const char *at_ = nullptr, *end_ = nullptr;
};

/// Numbers of nodes or elements: each once.
class Numbers {
public:
  Numbers(std::string what, std::int64_t least, std::int64_t most)
      : what_(std::move(what)), least_(least), most_(most) {}

  void add(MshSection& in) {
    const auto number = in.between(least_, most_, "the number of " + what_);
    if (!known_.insert(number).second) in.refuse(what_ + " " + std::to_string(number) + " is there twice");
  }
  bool has(std::int64_t number) const { return known_.count(number) > 0; }
  std::size_t size() const { return known_.size(); }

private:
  std::string what_;
  std::int64_t least_, most_;
  std::unordered_set<std::int64_t> known_;
};

const ElementType& type_of(MshSection& in) {
  const auto number = in.integer("an element's type");
  const auto* const found = std::find_if(std::begin(element_types), std::end(element_types),
                                         [&](const auto& type) { return type.number == number; });
  if (found == std::end(element_types))
    in.refuse("elements of gmsh's type " + std::to_string(number) + " are not known here");
  return *found;
}

void check_nodes_of_element(MshSection& in, const ElementType& type, const Numbers& nodes) {
  for (int i = 0; i < type.n_nodes; ++i)
    if (const auto node = in.integer("a node of an element"); !nodes.has(node))
      in.refuse("an element has the node " + std::to_string(node) + ", which the file does not have");
}

/// Begin of a section of version 4.1: numbers of blocks and things, and the range of these.
struct Head {
  std::size_t n_blocks = 0, n = 0;
  std::int64_t least = 0, most = 0;

  Head(MshSection& in, std::size_t n_numbers, const std::string& what) {
    n_blocks = in.count(4, "the number of blocks");
    n = in.count(n_numbers, "the number of " + what);
    least = in.between(n > 0 ? 1 : 0, largest_number, "the smallest number of " + what);
    most = in.between(least, largest_number, "the largest number of " + what);
  }
};

void require_count(MshSection& in, std::size_t found, std::size_t wanted, const std::string& what) {
  if (found != wanted)
    in.refuse("there are " + std::to_string(found) + " " + what + " where the section's head says " +
              std::to_string(wanted));
}

void check_entities_41(const std::string& text) {
  if (text.find("$Entities") == std::string::npos) return;
  MshSection in(text, "Entities");
  std::size_t counts[4];
  for (auto& count : counts) count = in.count(5, "the number of entities");
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      in.between(-largest_number, largest_number, "an entity's number");
      in.skip(dimension == 0 ? 3 : 6, "an entity's place");
      const auto n_groups = in.count(1, "the number of groups");
      for (std::size_t g = 0; g < n_groups; ++g)
        in.between(-largest_number, largest_number, "a group's number");
      const auto n_around = dimension == 0 ? 0 : in.count(1, "the number of entities around");
      for (std::size_t b = 0; b < n_around; ++b)
        in.between(-largest_number, largest_number, "an entity's number");
    }
  in.require_end();
}

Numbers check_nodes_41(const std::string& text) {
  MshSection in(text, "Nodes");
  const Head head(in, 4, "nodes");
  Numbers nodes("a node", head.least, head.most);
  for (std::size_t b = 0; b < head.n_blocks; ++b) {
    const auto dimension = in.between(0, 3, "an entity's dimension");
    in.between(-largest_number, largest_number, "an entity's number");
    const bool parametric = in.between(0, 1, "whether nodes are parametric") != 0;
    const auto n = in.count(4, "the number of nodes of a block");
    for (std::size_t i = 0; i < n; ++i) nodes.add(in);
    in.skip(n * (3 + (parametric ? std::size_t(dimension) : 0)), "a node's coordinate");
  }
  require_count(in, nodes.size(), head.n, "nodes");
  in.require_end();
  return nodes;
}

void check_elements_41(const std::string& text, const Numbers& nodes) {
  MshSection in(text, "Elements");
  const Head head(in, 2, "elements");
  Numbers elements("an element", head.least, head.most);
  for (std::size_t b = 0; b < head.n_blocks; ++b) {
    const auto dimension = in.between(0, 3, "an entity's dimension");
    in.between(-largest_number, largest_number, "an entity's number");
    const ElementType& type = type_of(in);
    if (type.dimension != dimension)
      in.refuse("elements of gmsh's type " + std::to_string(type.number) + " have the dimension " +
                std::to_string(type.dimension) + ", their block " + std::to_string(dimension));
    const auto n = in.count(1 + std::size_t(type.n_nodes), "the number of elements of a block");
    for (std::size_t e = 0; e < n; ++e) {
      elements.add(in);
      check_nodes_of_element(in, type, nodes);
    }
  }
  require_count(in, elements.size(), head.n, "elements");
  in.require_end();
}

Numbers check_nodes_22(const std::string& text) {
  MshSection in(text, "Nodes");
  const auto n = in.count(4, "the number of nodes");
  Numbers nodes("a node", 1, largest_number);
  for (std::size_t i = 0; i < n; ++i) {
    nodes.add(in);
    in.skip(3, "a node's coordinate");
  }
  in.require_end();
  return nodes;
}

void check_elements_22(const std::string& text, const Numbers& nodes) {
  MshSection in(text, "Elements");
  const auto n = in.count(4, "the number of elements");
  Numbers elements("an element", 1, largest_number);
  for (std::size_t e = 0; e < n; ++e) {
    elements.add(in);
    const ElementType& type = type_of(in);
    const auto n_tags = in.count(1, "the number of tags");
    for (std::size_t t = 0; t < n_tags; ++t) in.between(-largest_number, largest_number, "a tag");
    check_nodes_of_element(in, type, nodes);
  }
  in.require_end();
}

void check_group_names(const std::string& text) {
  if (text.find("$PhysicalNames") == std::string::npos) return;
  MshSection in(text, "PhysicalNames");
  const auto n = in.count(2, "the number of groups");
  if (n > 0) {
    in.between(0, 3, "a group's dimension");
    in.between(-largest_number, largest_number, "a group's number");
  }
}

}  // namespace

std::vector<std::string> surface_groups_named(const std::string& text) {
  std::vector<std::string> names;
  const auto end = std::min(text.find("$EndPhysicalNames"), text.size());
  for (auto at = std::min(text.find("$PhysicalNames"), end); at < end; at = text.find('\n', at)) {
    ++at;
    const auto open = text.find('"', at), line = text.find('\n', at);
    if (text.compare(at, 2, "2 ") != 0 || open >= line) continue;
    const auto close = text.rfind('"', line);
    if (close > open && close < end) names.push_back(text.substr(open + 1, close - open - 1));
  }
  return names;
}

void check_msh_text(const std::string& text) {
  MshSection format(text, "MeshFormat");
  const double version = format.number("the version");
  const bool binary = format.between(0, 1, "whether the file is binary") != 0;
  if (binary || (version != 2.2 && version != 4.1)) return;
  check_group_names(text);
  if (version == 2.2) return check_elements_22(text, check_nodes_22(text));
  check_entities_41(text);
  check_elements_41(text, check_nodes_41(text));
}

}  // namespace meshes
