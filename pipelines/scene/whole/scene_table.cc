#include "pipelines/scene/whole/scene_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipelines/base/names/name_fault.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/base/names/units.h"

namespace pipelines {
namespace {

/// Squares of what is larger, and what is divided by them, stay within the range of numbers.
constexpr double least_magnitude = 1e-152;

constexpr double unreadable = std::numeric_limits<double>::quiet_NaN();

const TomlNode& empty_table() {
  static const TomlNode node;
  return node;
}

/// Titles and paths may begin as they like: they head no column and no row of a table.
std::string text_fault(const std::string& key, const std::string& text) {
  constexpr std::size_t longest_title = 200;  // bytes; a picture's first line has room for half of them
  if (key == "title" && text.size() > longest_title)
    return "is longer than a line; write " + std::to_string(longest_title) + " characters at most";
  return key == "title" || key == "file" ? control_character_in(text) : cell_fault(text);
}

/// A dotted name without the numbers of items.
std::string without_numbers(const std::string& name) {
  std::string result;
  for (const char c : name)
    if (result.empty() || result.back() != '[' || c < '0' || c > '9') result += c;
  return result;
}

KeyForm form_of(KeyForm::Kind kind, const std::string& si_unit, const Range& range) {
  return {kind, si_unit, range.least, range.most, range.without_least};
}

std::string item_of(const std::string& name, std::size_t index) {
  return name + "[" + std::to_string(index + 1) + "]";
}

}  // namespace

SceneTable::SceneTable(const TomlNode& node, std::string key, SceneFindings& findings)
    : node_(&node), at_(node.at), key_(std::move(key)), findings_(&findings) {}

std::string SceneTable::dotted(const std::string& name) const {
  return key_.empty() || name.empty() ? key_ + name : key_ + "." + name;
}

void SceneTable::know(const std::string& name) {
  if (std::find(known_.begin(), known_.end(), name) != known_.end()) return;
  known_.push_back(name);
  if (!findings_->are_noted) return;
  findings_->keys.insert(dotted(name));
  findings_->forms.of_keys[without_numbers(dotted(name))];
}

bool SceneTable::is_given(const std::string& name) {
  know(name);
  return has(name);
}

void SceneTable::note(const std::string& name, const KeyForm& form) const {
  if (!findings_->are_noted) return;
  auto& forms = findings_->forms.of_keys[without_numbers(dotted(name))];
  if (std::find(forms.begin(), forms.end(), form) == forms.end()) forms.push_back(form);
}

bool SceneTable::has(const std::string& name) const {
  return node_->find(name) != nullptr;
}

bool SceneTable::has_list(const std::string& name) const {
  note(name, {KeyForm::Kind::list});
  const TomlEntry* const entry = node_->find(name);
  return entry != nullptr && entry->value.kind == TomlNode::Kind::array;
}

bool SceneTable::has_text(const std::string& name) const {
  note(name, {KeyForm::Kind::text});
  const TomlEntry* const entry = node_->find(name);
  return entry != nullptr && entry->value.kind == TomlNode::Kind::text;
}

bool SceneTable::has_table(const std::string& name) const {
  note(name, {KeyForm::Kind::table});
  const TomlEntry* const entry = node_->find(name);
  return entry != nullptr && entry->value.kind == TomlNode::Kind::table;
}

int SceneTable::whole_at(const std::string& table, const std::string& name) const {
  constexpr std::int64_t most = 1'000'000'000;
  const TomlEntry* const outer = node_->find(table);
  const TomlEntry* const entry = outer == nullptr ? nullptr : outer->value.find(name);
  const bool is_whole = entry != nullptr && entry->value.kind == TomlNode::Kind::integer;
  return is_whole && entry->value.integer >= 1 && entry->value.integer <= most ? int(entry->value.integer)
                                                                               : 0;
}

std::vector<std::string> SceneTable::names() const {
  std::vector<std::string> names;
  for (const auto& entry : node_->entries) names.push_back(entry.key);
  return names;
}

const TomlEntry* SceneTable::find(const std::string& name) {
  know(name);
  return node_->find(name);
}

const TomlEntry* SceneTable::require(const std::string& name, const std::string& remedy) {
  const TomlEntry* const entry = find(name);
  if (entry == nullptr && is_present_) missing_.push_back({name, remedy});
  return entry;
}

void SceneTable::refuse_node(const TomlNode& node, const std::string& name, const std::string& remedy) {
  findings_->errors.push_back(
      {findings_->file, node.at.line, node.at.column, dotted(name), node.as_written, remedy});
}

void SceneTable::refuse(const std::string& name, const std::string& remedy) {
  if (const TomlEntry* const entry = node_->find(name); entry != nullptr)
    refuse_node(entry->value, name, remedy);
  else
    refuse_missing(name, remedy);
}

void SceneTable::refuse_missing(const std::string& name, const std::string& remedy) {
  if (!is_present_) return;
  findings_->errors.push_back({findings_->file, at_.line, at_.column, dotted(name), "", remedy});
}

void SceneTable::record_default(const std::string& name, const std::string& value,
                                const std::string& reason) {
  if (is_present_ && findings_->are_noted) findings_->defaults.push_back({dotted(name), value, reason});
}

double SceneTable::read_quantity(const TomlNode& node, const std::string& name, const std::string& si_unit,
                                 const Range& range) {
  const bool bare = node.kind == TomlNode::Kind::integer || node.kind == TomlNode::Kind::number;
  double value = node.number;
  if (node.kind == TomlNode::Kind::text) {
    try {
      value = to_si(node.text, si_unit);
    } catch (const UnitError& error) {
      refuse_node(node, name, error.what());
      return unreadable;
    }
  } else if (!bare) {
    refuse_node(node, name,
                describe(node.kind) + " where a quantity is wanted; write a number in " + si_unit +
                    " or a text with a unit");
    return unreadable;
  }
  if (!std::isfinite(value)) {
    refuse_node(node, name,
                "is not a finite number; write one" +
                    (si_unit == "1" ? std::string() : " in " + si_unit + ", or a text with a unit"));
    return unreadable;
  }
  if (!range.contains(value)) {
    const bool unit_may_be_missing = bare && si_unit != "1";
    refuse_node(node, name,
                range.rule(value, si_unit) +
                    (unit_may_be_missing ? "; a number without a unit is in " + si_unit
                                         : "; check the number" + std::string(bare ? "" : " and its unit")));
    return unreadable;
  }
  if (value != 0 && std::abs(value) < least_magnitude) {
    refuse_node(node, name,
                "is nearer to zero than " + shown(least_magnitude) + (si_unit == "1" ? "" : " " + si_unit) +
                    ": its square is lost; check the exponent, or write 0");
    return unreadable;
  }
  return value;
}

double SceneTable::quantity(const std::string& name, const std::string& si_unit, const Range& range) {
  note(name, form_of(KeyForm::Kind::quantity, si_unit, range));
  const TomlEntry* const entry = require(
      name, "is missing; add it" +
                (si_unit == "1" ? std::string() : ", as a number in " + si_unit + " or a text with a unit"));
  return entry == nullptr ? unreadable : read_quantity(entry->value, name, si_unit, range);
}

std::optional<double> SceneTable::quantity_if_given(const std::string& name, const std::string& si_unit,
                                                    const Range& range) {
  if (!is_given(name)) return std::nullopt;
  return quantity(name, si_unit, range);
}

double SceneTable::quantity_or(const std::string& name, const std::string& si_unit, const Range& range,
                               double value, const std::string& reason) {
  note(name, form_of(KeyForm::Kind::quantity, si_unit, range));
  if (const TomlEntry* const entry = find(name); entry != nullptr)
    return read_quantity(entry->value, name, si_unit, range);
  record_default(name, shown(value) + (si_unit == "1" ? "" : " " + si_unit), reason);
  return value;
}

std::vector<double> SceneTable::quantities(const std::string& name, const std::string& si_unit,
                                           const Range& range, std::size_t count) {
  note(name, form_of(KeyForm::Kind::quantities, si_unit, range));
  std::vector<double> values(count, unreadable);
  const std::string wanted =
      "an array of " + std::to_string(count) + " quantities" + (si_unit == "1" ? "" : " in " + si_unit);
  const TomlEntry* const entry = require(name, "is missing; add " + wanted);
  if (entry == nullptr) return values;
  const TomlNode& node = entry->value;
  if (node.kind != TomlNode::Kind::array)
    refuse_node(node, name, describe(node.kind) + " where " + wanted + " is wanted");
  else if (node.items.size() != count)
    refuse_node(node, name, "has " + std::to_string(node.items.size()) + " items; write " + wanted);
  else
    for (std::size_t i = 0; i < count; ++i)
      values[i] = read_quantity(node.items[i], item_of(name, i), si_unit, range);
  return values;
}

std::vector<double> SceneTable::list(const std::string& name, const std::string& si_unit,
                                     const Range& range) {
  note(name, form_of(KeyForm::Kind::quantities, si_unit, range));
  const TomlEntry* const entry = require(name, "is missing; add an array of quantities");
  if (entry == nullptr) return {};
  const bool is_list = entry->value.kind == TomlNode::Kind::array && !entry->value.items.empty();
  if (!is_list) refuse_node(entry->value, name, "is no array with at least one quantity; write [..., ...]");
  return is_list ? quantities(name, si_unit, range, entry->value.items.size()) : std::vector<double>{};
}

double SceneTable::ratio(const std::string& name) {
  note(name, {KeyForm::Kind::quantity, "1"});
  const std::string wanted = "a number, or a fraction such as \"-1/20\"";
  const TomlEntry* const entry = require(name, "is missing; add " + wanted);
  if (entry == nullptr) return unreadable;
  const TomlNode& node = entry->value;
  if (node.kind != TomlNode::Kind::text) return read_quantity(node, name, "1", {});
  try {
    return parse_ratio(node.text);
  } catch (const UnitError& error) {
    refuse_node(node, name, error.what());
    return unreadable;
  }
}

int SceneTable::count_or(const std::string& name, int least, int most, int value, const std::string& reason) {
  note(name, {KeyForm::Kind::count, "", double(least), double(most)});
  const TomlEntry* const entry = find(name);
  if (entry == nullptr) {
    record_default(name, std::to_string(value), reason);
    return value;
  }
  const TomlNode& node = entry->value;
  const std::string rule =
      "a whole number from " + std::to_string(least) + " to " + std::to_string(most) + " is wanted";
  if (node.kind != TomlNode::Kind::integer) {
    refuse_node(node, name, describe(node.kind) + " where " + rule);
    return 0;
  }
  if (node.integer < least || node.integer > most) {
    refuse_node(node, name, "is out of range: " + rule);
    return 0;
  }
  return static_cast<int>(node.integer);
}

bool SceneTable::flag_or(const std::string& name, bool value, const std::string& reason) {
  note(name, {KeyForm::Kind::flag});
  const TomlEntry* const entry = find(name);
  if (entry == nullptr) {
    record_default(name, value ? "true" : "false", reason);
    return value;
  }
  if (entry->value.kind != TomlNode::Kind::boolean)
    refuse_node(entry->value, name, describe(entry->value.kind) + " where true or false is wanted");
  return entry->value.boolean;
}

std::string SceneTable::text(const std::string& name, const std::string& remedy) {
  note(name, {KeyForm::Kind::text});
  const TomlEntry* const entry = require(name, remedy);
  if (entry == nullptr) return {};
  if (entry->value.kind != TomlNode::Kind::text)
    refuse_node(entry->value, name, describe(entry->value.kind) + " where a text in quotes is wanted");
  else if (entry->value.text.empty())
    refuse_node(entry->value, name, "is empty; write a text, or leave out the key if it may be missing");
  else if (const std::string fault = text_fault(name, entry->value.text); !fault.empty())
    refuse_node(entry->value, name, fault);
  return entry->value.text;
}

std::string SceneTable::name(const std::string& key, const std::string& remedy) {
  const std::string name = text(key, remedy);
  if (const std::string fault = name_fault(name); !fault.empty() && cell_fault(name).empty())
    refuse(key, fault);
  return name;
}

std::string SceneTable::text_or(const std::string& name, const std::string& value,
                                const std::string& reason) {
  if (has(name)) return text(name);
  note(name, {KeyForm::Kind::text});
  know(name);
  record_default(name, "\"" + value + "\"", reason);
  return value;
}

std::vector<TextAt> SceneTable::texts(const std::string& name) {
  note(name, {KeyForm::Kind::texts});
  std::vector<TextAt> texts;
  const TomlEntry* const entry = require(name, "is missing; add an array of texts");
  if (entry == nullptr) return texts;
  if (entry->value.kind != TomlNode::Kind::array) {
    refuse_node(entry->value, name, describe(entry->value.kind) + " where an array of texts is wanted");
    return texts;
  }
  for (std::size_t i = 0; i < entry->value.items.size(); ++i) {
    const TomlNode& item = entry->value.items[i];
    const std::string fault = item.kind == TomlNode::Kind::text ? text_fault(name, item.text) : "";
    if (!fault.empty()) refuse_node(item, item_of(name, i), fault);
    if (item.kind == TomlNode::Kind::text)
      texts.push_back({item.text, item.at, dotted(item_of(name, i)), item.as_written});
    else
      refuse_node(item, item_of(name, i), describe(item.kind) + " where a text in quotes is wanted");
  }
  return texts;
}

SceneTable SceneTable::table(const std::string& name) {
  note(name, {KeyForm::Kind::table});
  const TomlEntry* const entry = require(name, "is missing; add the table [" + dotted(name) + "]");
  const bool is_table = entry != nullptr && entry->value.kind == TomlNode::Kind::table;
  if (entry != nullptr && !is_table)
    refuse_node(entry->value, name,
                describe(entry->value.kind) + " where a table is wanted; write [" + dotted(name) + "]");
  SceneTable result(is_table ? entry->value : empty_table(), dotted(name), *findings_);
  result.is_present_ = is_table;
  return result;
}

SceneTable SceneTable::table_or_empty(const std::string& name) {
  if (has(name)) return table(name);
  note(name, {KeyForm::Kind::table});
  know(name);
  SceneTable result(empty_table(), dotted(name), *findings_);
  result.is_present_ = is_present_;
  result.at_ = at_;
  return result;
}

std::vector<SceneTable> SceneTable::tables_if_any(const std::string& name) {
  return is_given(name) ? tables(name) : std::vector<SceneTable>();
}

std::vector<SceneTable> SceneTable::tables(const std::string& name) {
  note(name, {KeyForm::Kind::tables});
  std::vector<SceneTable> result;
  const TomlEntry* const entry = require(name, "is missing; add it as an array of tables");
  if (entry == nullptr) return result;
  if (entry->value.kind != TomlNode::Kind::array) {
    refuse_node(entry->value, name, describe(entry->value.kind) + " where an array of tables is wanted");
    return result;
  }
  for (std::size_t i = 0; i < entry->value.items.size(); ++i) {
    const TomlNode& item = entry->value.items[i];
    if (item.kind == TomlNode::Kind::table)
      result.emplace_back(item, dotted(item_of(name, i)), *findings_);
    else
      refuse_node(item, item_of(name, i), describe(item.kind) + " where a table is wanted");
  }
  return result;
}

TextAt SceneTable::written_at(const std::string& name) const {
  const TomlEntry* const entry = node_->find(name);
  return entry == nullptr ? TextAt{"", at_, dotted(name), ""}
                          : TextAt{"", entry->value.at, dotted(name), entry->value.as_written};
}

std::map<std::string, std::string> SceneTable::places_in(const std::string& name) const {
  std::map<std::string, std::string> places;
  const TomlEntry* const table = node_->find(name);
  if (table == nullptr) return places;
  for (const TomlEntry& entry : table->value.entries) {
    const TomlNode& value = entry.value;
    const SceneFinding at{findings_->file,  value.at.line,
                          value.at.column,  dotted(name + "." + entry.key),
                          value.as_written, ""};
    const std::string text = at.text();
    places[entry.key] = text.substr(0, text.size() - 2);  // without the colon before the remedy
  }
  return places;
}

std::string SceneTable::origin() const {
  return findings_->file + ":" + std::to_string(at_.line) + ":" + std::to_string(at_.column) + ": " + key_;
}

void SceneTable::finish() {
  if (findings_->are_noted) findings_->forms.closed.insert(without_numbers(key_));
  std::vector<std::string> free;  // a key in use is not what was meant
  for (const std::string& name : known_)
    if (!has(name)) free.push_back(name);
  for (const TomlEntry& entry : node_->entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    // Who sets a key may well mean one that the file has.
    const std::string nearest = nearest_name(entry.key, entry.is_set ? known_ : free);
    std::string remedy = "unknown key; known here: " + listed(known_);
    if (!nearest.empty()) {
      remedy = "unknown key; did you mean \"" + nearest + "\"?";
      const auto is_meant = [&](const Missing& missing) { return missing.name == nearest; };
      missing_.erase(std::remove_if(missing_.begin(), missing_.end(), is_meant), missing_.end());
    }
    findings_->errors.push_back(
        {findings_->file, entry.at.line, entry.at.column, dotted(entry.key), entry.value.as_written, remedy});
  }
  for (const Missing& missing : missing_) refuse_missing(missing.name, missing.remedy);
}

}  // namespace pipelines
