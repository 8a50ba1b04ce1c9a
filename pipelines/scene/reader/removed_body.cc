#include "pipelines/scene/reader/removed_body.h"

#include <algorithm>
#include <functional>
#include <variant>

#include "pipelines/base/names/name_lists.h"
#include "pipelines/scene/whole/body_reader.h"

namespace pipelines {
namespace {

using Kind = TomlNode::Kind;

std::string text_at(const TomlNode& table, const std::string& key) {
  const auto* entry = table.find(key);
  return entry != nullptr && entry->value.kind == Kind::text ? entry->value.text : "";
}

/// The kind of body that a table describes; null: none of the scene's machine.
const BodyReader* kind_of_table(const TomlNode& root, const std::string& table) {
  const auto* machine = root.find("machine");
  if (machine == nullptr) return nullptr;
  const auto type = text_at(machine->value, "type");
  for (const auto* kind : body_readers())
    if (kind->machine_type() == type && contains(kind->tables(), table)) return kind;
  return nullptr;
}

/// All texts below a node that stand at one of the keys, those of lists too.
std::vector<std::string> texts_below(const TomlNode& node, const std::vector<std::string>& keys) {
  std::vector<std::string> texts;
  const auto add = [&](const TomlNode& inside) {
    const auto more = texts_below(inside, keys);
    texts.insert(texts.end(), more.begin(), more.end());
  };
  for (const auto& item : node.items) add(item);
  for (const auto& entry : node.entries) {
    if (contains(keys, entry.key)) {
      if (entry.value.kind == Kind::text) texts.push_back(entry.value.text);
      for (const auto& item : entry.value.items)
        if (item.kind == Kind::text) texts.push_back(item.text);
    }
    add(entry.value);
  }
  return texts;
}

/// Effects that no other part of the scene knows.
std::vector<std::string> effects_of(const TomlNode& root, const BodyReader& kind, const TomlNode& body) {
  auto effects = texts_below(body, {"effect"});
  for (const auto& own : kind.own_effects()) effects.push_back(own.name);
  return names_without(effects, texts_below(root.find("machine")->value, {"effect", "name"}));
}

/// Forces on the body that a bearing may name.
std::vector<std::string> loads_of(const BodyReader& kind, const TomlNode& body) {
  try {
    return kind.bearing_loads(BodyScene());
  } catch (const std::bad_variant_access&) {  // the kind has them from the body's own table
    return texts_below(body, {"bearings"});
  }
}

/// Removes items of a list.
/// @param what  says what an item is; empty: it stays
/// @return what went
std::vector<std::string> drop_items(TomlNode& list, const std::function<std::string(const TomlNode&)>& what) {
  std::vector<std::string> gone;
  if (list.kind != Kind::array) return gone;
  for (const auto& item : list.items)
    if (const auto text = what(item); !text.empty()) gone.push_back(text);
  if (gone.empty()) return gone;
  auto& items = list.items.own();
  items.erase(std::remove_if(items.begin(), items.end(), [&](const TomlNode& i) { return !what(i).empty(); }),
              items.end());
  return gone;
}

/// The value of a key that can be changed; null: there is none.
TomlNode* own_value(TomlNode& table, const std::string& key) {
  if (table.find(key) == nullptr) return nullptr;
  for (auto& entry : table.entries.own())
    if (entry.key == key) return &entry.value;
  return nullptr;
}

/// Removes effects from a list of their names, or from a table that switches them.
std::vector<std::string> drop_effects(TomlNode& value, const std::vector<std::string>& effects) {
  if (value.kind != Kind::table)
    return drop_items(value, [&](const TomlNode& item) {
      return item.kind == Kind::text && contains(effects, item.text) ? item.text : std::string();
    });
  std::vector<std::string> gone;
  for (const auto& entry : value.entries)
    if (contains(effects, entry.key)) gone.push_back(entry.key);
  auto& entries = value.entries.own();
  entries.erase(
      std::remove_if(entries.begin(), entries.end(), [&](const auto& e) { return contains(gone, e.key); }),
      entries.end());
  return gone;
}

/// Removes effects from the keys that a block of [[duty]] sets, and returns what is gone.
std::vector<std::string> drop_effects_of_block(TomlNode& block, const std::vector<std::string>& effects) {
  std::vector<std::string> gone;
  auto* const set = own_value(block, "set");
  if (set == nullptr || set->kind != Kind::table) return gone;
  if (auto* const listed = own_value(*set, "effects")) gone = drop_effects(*listed, effects);
  std::vector<std::string> quoted;
  for (const auto& effect : effects) quoted.push_back("effects." + effect);
  const auto more = drop_effects(*set, quoted);
  gone.insert(gone.end(), more.begin(), more.end());
  return gone;
}

/// "shaft.material.density" of "shaft.material.density = 7800, 7900".
std::string varied_key(const TomlNode& item) {
  const auto key = item.kind == Kind::text ? item.text.substr(0, item.text.find('=')) : "";
  const auto end = key.find_last_not_of(' ');
  const auto begin = key.find_first_not_of(' ');
  return begin == std::string::npos ? "" : key.substr(begin, end + 1 - begin);
}

}  // namespace

bool is_body_table(const TomlNode& root, const std::string& table) {
  return kind_of_table(root, table) != nullptr;
}

std::vector<std::string> drop_what_needs(TomlNode& root, const std::string& table, const TomlNode& body) {
  std::vector<std::string> told;
  const BodyReader* const kind = kind_of_table(root, table);
  if (kind == nullptr) return told;
  const auto tell = [&](const std::string& what, const std::vector<std::string>& names) {
    for (const auto& name : names)
      told.push_back("[" + table + "] is removed, and with it " + what + " \"" + name + "\", which needs it");
  };
  const auto effects = effects_of(root, *kind, body), loads = loads_of(*kind, body);
  if (auto* const listed = own_value(root, "effects")) tell("the effect", drop_effects(*listed, effects));
  if (auto* const bearings = own_value(root, "bearings"))
    tell("the bearing", drop_items(*bearings, [&](const TomlNode& item) {
           return contains(loads, text_at(item, "load")) ? text_at(item, "name") : std::string();
         }));
  if (auto* const blocks = own_value(root, "duty"); blocks != nullptr && blocks->kind == Kind::array)
    for (auto& block : blocks->items.own())
      tell("in the duty block \"" + text_at(block, "name") + "\" the key",
           drop_effects_of_block(block, effects));
  auto* const sweep = own_value(root, "sweep");
  auto* const vary = sweep == nullptr ? nullptr : own_value(*sweep, "vary");
  if (vary != nullptr)
    tell("what the sweep varies,", drop_items(*vary, [&](const TomlNode& item) {
           const auto key = varied_key(item);
           const bool is_effect = key.rfind("effects.", 0) == 0 && contains(effects, key.substr(8));
           const bool is_within = key.rfind(table, 0) == 0 && key.size() > table.size() &&
                                  (key[table.size()] == '.' || key[table.size()] == '[');
           return is_effect || is_within ? key : std::string();
         }));
  return told;
}

}  // namespace pipelines
