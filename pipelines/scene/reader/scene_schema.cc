#include "pipelines/scene/reader/scene_schema.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

using Json = nlohmann::ordered_json;

/// A key with the keys below it.
struct SchemaNode {
  std::vector<KeyForm> forms{};
  std::map<std::string, SchemaNode> keys{};
  std::shared_ptr<SchemaNode> item{};  ///< of an array of tables
  bool is_closed = false;
};

/// The node of a dotted name.
SchemaNode& node_at(SchemaNode& root, const std::string& name) {
  SchemaNode* node = &root;
  for (std::size_t begin = 0; begin < name.size();) {
    const auto end = std::min(name.find('.', begin), name.size());
    auto part = name.substr(begin, end - begin);
    const bool is_item = part.size() > 2 && part.compare(part.size() - 2, 2, "[]") == 0;
    if (is_item) part.resize(part.size() - 2);
    node = &node->keys[part];
    if (is_item && !node->item) node->item = std::make_shared<SchemaNode>();
    if (is_item) node = node->item.get();
    begin = end + 1;
  }
  return *node;
}

SchemaNode tree_of(const std::vector<KeyForms>& scenes) {
  SchemaNode root;
  for (const auto& scene : scenes) {
    for (const auto& [name, forms] : scene.of_keys) {
      auto& node = node_at(root, name);
      for (const auto& form : forms)
        if (std::find(node.forms.begin(), node.forms.end(), form) == node.forms.end())
          node.forms.push_back(form);
    }
    for (const auto& name : scene.closed) node_at(root, name).is_closed = true;
  }
  return root;
}

Json quantity_schema(const KeyForm& form) {
  Json number{{"type", "number"}};
  if (std::isfinite(form.least)) number[form.without_least ? "exclusiveMinimum" : "minimum"] = form.least;
  if (std::isfinite(form.most)) number["maximum"] = form.most;
  Json schema{{"anyOf", {number, {{"type", "string"}}}}};
  if (form.si_unit != "1") schema["description"] = "a number in " + form.si_unit + ", or a text with a unit";
  return schema;
}

Json table_schema(const SchemaNode& node);

Json form_schema(const KeyForm& form, const SchemaNode& node) {
  switch (form.kind) {
    case KeyForm::Kind::quantity:
      return quantity_schema(form);
    case KeyForm::Kind::quantities:
      return {{"type", "array"}, {"items", quantity_schema(form)}};
    case KeyForm::Kind::count:
      return {
          {"type", "integer"}, {"minimum", std::int64_t(form.least)}, {"maximum", std::int64_t(form.most)}};
    case KeyForm::Kind::flag:
      return {{"type", "boolean"}};
    case KeyForm::Kind::text:
      return {{"type", "string"}};
    case KeyForm::Kind::texts:
      return {{"type", "array"}, {"items", {{"type", "string"}}}};
    case KeyForm::Kind::list:
      return {{"type", "array"}};
    case KeyForm::Kind::table:
      return table_schema(node);
    case KeyForm::Kind::tables:
      return {{"type", "array"}, {"items", node.item ? table_schema(*node.item) : Json{{"type", "object"}}}};
  }
  return true;
}

Json key_schema(const SchemaNode& node) {
  if (node.forms.empty()) return true;
  if (node.forms.size() == 1) return form_schema(node.forms.front(), node);
  auto all = Json::array();
  for (const auto& form : node.forms) all.push_back(form_schema(form, node));
  return {{"anyOf", std::move(all)}};
}

Json table_schema(const SchemaNode& node) {
  Json schema{{"type", "object"}};
  for (const auto& [name, key] : node.keys) schema["properties"][name] = key_schema(key);
  if (node.is_closed) schema["additionalProperties"] = false;
  return schema;
}

}  // namespace

std::string scene_schema(const std::vector<KeyForms>& scenes) {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Millstress scene"}};
  schema.update(table_schema(tree_of(scenes)));
  schema["required"] = {"machine"};
  auto& machine = schema["properties"]["machine"];
  machine["required"] = {"type"};
  auto types = Json::array();
  for (const auto* kind : machine_kinds()) types.push_back(kind->type());
  machine["properties"]["type"] = {{"enum", std::move(types)}};
  return schema.dump(1) + "\n";
}

}  // namespace pipelines
