#include "pipelines/scene/reader/key_settings.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>

#include "meshes/values/utf8.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/scene/reader/removed_body.h"

namespace pipelines {
namespace {

constexpr const char* example = "write KEY=VALUE, such as machine.drive.speed=\"1500 rpm\"";

/// Trees are copied and freed by recursion.
constexpr std::size_t most_parts = 100;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// One part of a key: a name, or the number of an item, from 1.
struct Part {
  std::string name;
  std::size_t item = 0;  ///< 0: a name
};

class Setting {
public:
  Setting(const std::string& text, const std::filesystem::path& file) : file_(file.string()) {
    const auto equals = text.find('=');
    key_ = trimmed(text.substr(0, equals));
    shown_key_ = "--set " + key_;
    if (equals == std::string::npos || key_.empty()) refuse("is no setting; " + std::string(example));
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::any_of(text.begin(), text.end(), is_control))
      refuse("has a control character or more than one line; leave it out");
    if (!meshes::is_utf8(text)) refuse("is not UTF-8; write it so");
    value_ = trimmed(text.substr(equals + 1));
    if (value_.empty()) refuse("has no value; " + std::string(example));
    split();
  }

  /// @param shown_key  key of the value, for errors
  Setting(std::string key, TomlNode value, std::string shown_key, const std::filesystem::path& file)
      : file_(file.string()),
        key_(std::move(key)),
        shown_key_(std::move(shown_key)),
        node_(std::move(value)) {
    value_ = node_->kind == TomlNode::Kind::text      ? node_->text
             : node_->kind == TomlNode::Kind::boolean ? (node_->boolean ? "true" : "false")
                                                      : node_->as_written;
    split();
  }

  const std::string& key() const { return key_; }
  bool removes() const { return value_ == "removed"; }
  /// "shaft" of shaft=removed; empty where the key leads deeper, or to no body.
  std::string removed_body(const TomlNode& root) const {
    return removes() && parts_.size() == 1 && is_body_table(root, key_) ? key_ : "";
  }
  /// The numbers of items on the way, to remove the last ones first.
  std::vector<std::size_t> items() const {
    std::vector<std::size_t> numbers;
    for (const auto& part : parts_) numbers.push_back(part.item);
    return numbers;
  }

  void apply(TomlNode& root) const {
    if (switches_effect(root)) return switch_effect(root);
    TomlNode* node = &root;
    for (std::size_t i = 0; i + 1 < parts_.size(); ++i) node = &step(*node, i, parts_[i + 1].item > 0);
    TomlNode& target = step(*node, parts_.size() - 1, false);
    target = value();
  }

  void remove(TomlNode& root) const {
    TomlNode* node = &root;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      const bool is_last = i + 1 == parts_.size();
      if (part.item > 0) {
        TomlNode& item = step(*node, i, false);
        if (is_last) {
          auto& items = node->items.own();
          items.erase(items.begin() + std::ptrdiff_t(part.item - 1));
          return;
        }
        node = &item;
        continue;
      }
      auto& entries = node->entries.own();
      const auto entry = std::find_if(entries.begin(), entries.end(),
                                      [&](const TomlEntry& e) { return e.key == part.name; });
      if (entry == entries.end()) refuse("cannot be removed: the scene has no " + up_to(i));
      if (is_last) {
        entries.erase(entry);
        return;
      }
      node = &entry->value;
    }
  }

  [[noreturn]] void refuse(const std::string& remedy) const {
    const auto at = node_ ? node_->at : SourcePosition();
    throw SceneError({{file_, at.line, at.column, shown_key_, value_, remedy}});
  }

private:
  /// effects.NAME: one of the list.
  bool switches_effect(const TomlNode& root) const {
    return parts_.size() == 2 && parts_[0].name == "effects" && parts_[1].item == 0 && root.find("effects");
  }

  void switch_effect(TomlNode& root) const {
    auto& entries = root.entries.own();
    const auto entry =
        std::find_if(entries.begin(), entries.end(), [](const TomlEntry& e) { return e.key == "effects"; });
    TomlNode& effects = entry->value;
    if (effects.kind != TomlNode::Kind::array)
      refuse("effects is " + effects.as_written + " in the scene; list them there, or set effects whole");
    const bool on = value_ == "on" || value_ == "true";
    if (!on && value_ != "off" && value_ != "false") refuse("write on or off");
    auto& items = effects.items.own();
    const auto named = std::find_if(items.begin(), items.end(), [&](const TomlNode& item) {
      return item.kind == TomlNode::Kind::text && item.text == parts_[1].name;
    });
    const bool is_on = named != items.end();
    if (on && !is_on) {
      TomlNode effect;
      effect.kind = TomlNode::Kind::text;
      effect.text = parts_[1].name;
      effect.as_written = '"' + effect.text + "\" (by --set)";
      items.push_back(effect);
    } else if (!on) {
      if (!is_on) refuse("effects does not have it; check the name");
      items.erase(named);
    }
  }

  void split() {
    std::string name;
    const auto end_name = [&] {
      if (name.empty()) refuse("has an empty name in its key; " + std::string(example));
      parts_.push_back({name, 0});
      name.clear();
    };
    for (std::size_t i = 0; i < key_.size(); ++i) {
      if (key_[i] == '.') {
        if (!(i > 0 && key_[i - 1] == ']')) end_name();
        if (i + 1 == key_.size()) end_name();
      } else if (key_[i] == '[') {
        if (!(i > 0 && key_[i - 1] == ']')) end_name();
        const auto close = std::min(key_.find(']', i), key_.size());
        Part part;
        const char* const last = key_.data() + close;
        const auto [end, error] = std::from_chars(key_.data() + i + 1, last, part.item);
        const bool goes_on = close + 1 < key_.size() && key_[close + 1] != '.' && key_[close + 1] != '[';
        if (close == key_.size() || error != std::errc() || end != last || part.item == 0 || goes_on)
          refuse("has no number of an item between its brackets; the first is [1]");
        parts_.push_back(part);
        i = close;
      } else {
        name += key_[i];
      }
    }
    if (!name.empty()) end_name();
    if (parts_.size() > most_parts) refuse("has a key of more than " + std::to_string(most_parts) + " parts");
  }

  /// The key up to a part.
  std::string up_to(std::size_t i) const {
    std::string text;
    for (std::size_t k = 0; k <= i; ++k)
      text += parts_[k].item > 0 ? "[" + std::to_string(parts_[k].item) + "]"
                                 : (k > 0 ? "." : "") + parts_[k].name;
    return text;
  }

  TomlNode& step(TomlNode& node, std::size_t i, bool to_array) const {
    const Part& part = parts_[i];
    if (part.item > 0) {
      if (node.kind != TomlNode::Kind::array)
        refuse(up_to(i - 1) + " is " + describe(node.kind) + ", not an array");
      if (part.item > node.items.size())
        refuse(up_to(i - 1) + " has " + std::to_string(node.items.size()) + " items, counted from 1");
      return node.items.own()[part.item - 1];
    }
    if (node.kind != TomlNode::Kind::table)
      refuse(up_to(i - 1) + " is " + describe(node.kind) + " and has no keys; check the key");
    auto& entries = node.entries.own();
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const TomlEntry& entry) { return entry.key == part.name; });
    if (found != entries.end()) return found->value;
    if (to_array) refuse("the scene has no " + up_to(i) + "; write the array in the scene, or set it whole");
    entries.push_back({part.name, node_ ? node_->at : SourcePosition(), {}, true});
    return entries.back().value;
  }

  /// "1450 rpm". Behind a number and a space TOML has digits (of a time), a comment or an end, but no
  /// letter: such a text need not be given to the parser, whose refusal takes longer than all other settings.
  bool is_number_with_unit() const {
    const auto space = value_.find(' ');
    if (value_.find_first_of("+-0123456789") != 0 || space == std::string::npos) return false;
    const auto behind = value_.find_first_not_of(' ', space);
    return std::isalpha(static_cast<unsigned char>(value_[behind])) != 0;
  }

  /// The value as TOML; none where it is no TOML.
  std::optional<TomlNode> toml_value() const {
    if (is_number_with_unit()) return std::nullopt;
    try {
      const auto tree = parse_toml("value = " + value_);
      if (tree.entries.size() == 1) return by_command_line(tree.entries.front().value);
    } catch (const TomlSyntaxError&) {  // a text without quotes
    }
    return std::nullopt;
  }

  TomlNode value() const {
    if (node_) return *node_;
    if (auto node = toml_value()) return std::move(*node);
    TomlNode text;
    text.kind = TomlNode::Kind::text;
    text.text = value_;
    text.as_written = '"' + value_ + "\" (by --set)";
    return text;
  }

  static TomlNode by_command_line(TomlNode node) {
    node.at = {};
    if (!node.as_written.empty()) node.as_written += " (by --set)";
    for (auto& item : node.items.own()) item = by_command_line(std::move(item));
    for (auto& entry : node.entries.own()) entry = {entry.key, {}, by_command_line(std::move(entry.value))};
    return node;
  }

  std::string file_, key_, shown_key_, value_;
  std::optional<TomlNode> node_;  ///< value from the scene; none: value_ is the command line's
  std::vector<Part> parts_;
};

/// The values below a table, each with its whole key.
void collect(const TomlNode& table, const std::string& prefix, const std::string& shown_prefix,
             const std::filesystem::path& file, std::vector<Setting>& settings) {
  for (const auto& entry : table.entries) {
    const auto key = prefix.empty() ? entry.key : prefix + "." + entry.key;
    if (entry.value.kind == TomlNode::Kind::table)
      collect(entry.value, key, shown_prefix, file, settings);
    else
      settings.emplace_back(key, entry.value, shown_prefix + "." + key, file);
  }
}

/// Applies all settings. From one array the last item is removed first: numbers are those of the file.
/// @return what went with bodies that were removed
std::vector<std::string> apply_all(const std::vector<Setting>& settings, TomlNode& root) {
  std::set<std::string> keys;
  std::vector<Setting> removals;
  for (const auto& setting : settings) {
    if (!keys.insert(setting.key()).second) setting.refuse("sets the key again; set it once");
    if (setting.removes())
      removals.push_back(setting);
    else
      setting.apply(root);
  }
  std::stable_sort(removals.begin(), removals.end(),
                   [](const Setting& a, const Setting& b) { return a.items() > b.items(); });
  std::vector<std::string> told;
  for (const auto& removal : removals) {
    const auto body = removal.removed_body(root);
    const auto* const entry = body.empty() ? nullptr : root.find(body);
    const TomlNode table = entry == nullptr ? TomlNode() : entry->value;
    removal.remove(root);
    if (body.empty()) continue;
    const auto more = drop_what_needs(root, body, table);
    told.insert(told.end(), more.begin(), more.end());
  }
  return told;
}

/// A plain value, or a list of them.
std::string text_of_value(const TomlNode& node) {
  switch (node.kind) {
    case TomlNode::Kind::text:
      return node.text;
    case TomlNode::Kind::integer:
      return std::to_string(node.integer);
    case TomlNode::Kind::number:
      return shortest(node.number);
    case TomlNode::Kind::boolean:
      return node.boolean ? "true" : "false";
    case TomlNode::Kind::array: {
      std::string texts;
      for (const auto& item : node.items) texts += (texts.empty() ? "" : ", ") + text_of_value(item);
      return texts;
    }
    case TomlNode::Kind::date:
    case TomlNode::Kind::table:
      return node.as_written;
  }
  return "";
}

}  // namespace

std::vector<std::string> set_keys(TomlNode& root, const std::vector<std::string>& settings,
                                  const std::filesystem::path& file) {
  std::vector<Setting> all;
  for (const auto& text : settings) all.emplace_back(text, file);
  return apply_all(all, root);
}

void set_entries(TomlNode& root, const TomlNode& table, const std::string& key,
                 const std::filesystem::path& file) {
  std::vector<Setting> all;
  collect(table, "", key, file, all);
  apply_all(all, root);
}

void for_each_value(const TomlNode& node, const ValueListener& listener, const std::string& key) {
  const auto has_parts = [](const TomlNode& item) {
    return item.kind == TomlNode::Kind::table || item.kind == TomlNode::Kind::array;
  };
  if (node.kind == TomlNode::Kind::table) {
    for (const auto& entry : node.entries)
      for_each_value(entry.value, listener, key.empty() ? entry.key : key + "." + entry.key);
  } else if (node.kind == TomlNode::Kind::array &&
             std::any_of(node.items.begin(), node.items.end(), has_parts)) {
    std::size_t number = 0;
    for (const auto& item : node.items)
      for_each_value(item, listener, key + "[" + std::to_string(++number) + "]");
  } else {
    listener(key, node);
  }
}

std::map<std::string, std::string> texts_by_key(const TomlNode& root) {
  std::map<std::string, std::string> texts;
  for_each_value(root,
                 [&](const std::string& key, const TomlNode& value) { texts[key] = text_of_value(value); });
  return texts;
}

}  // namespace pipelines
