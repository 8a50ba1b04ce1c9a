/// Reading one table of a scene, key by key, and collecting everything that is wrong on the way.
///
/// The keys that a reader asks for are the keys that the table knows: finish() reports all others. A value
/// that is missing or wrong is reported once and read as NaN (numbers), 0 (counts) or empty (texts, lists),
/// so that comparisons which follow are false and no error brings a second one along. Items of arrays are
/// counted from 1.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/files/toml_tree.h"
#include "pipelines/scene/whole/scene_findings.h"

namespace pipelines {

/// A text of a list, with its place.
struct TextAt {
  std::string text;
  SourcePosition at;
  std::string key, as_written;
};

class SceneTable {
public:
  /// @param key  dotted name of the table; empty for the root
  /// Node and findings must outlive this object.
  SceneTable(const TomlNode& node, std::string key, SceneFindings& findings);

  /// False for the stand-in of a table that is missing (reported already): its values are all "unreadable",
  /// silently.
  bool is_present() const noexcept { return is_present_; }
  bool has(const std::string& name) const;
  bool has_list(const std::string& name) const;  ///< an array stands there
  bool has_table(const std::string& name) const;
  /// The whole number, 1 to 1e9, under that key of a table within this one; 0 if none stands there. Neither
  /// makes a key known nor reports.
  int whole_at(const std::string& table, const std::string& name) const;
  bool has_text(const std::string& name) const;  ///< a text stands there
  /// Whether that very text stands there.
  bool holds(const std::string& name, const std::string& text) const {
    const TomlEntry* const entry = node_->find(name);
    return entry != nullptr && entry->value.kind == TomlNode::Kind::text && entry->value.text == text;
  }
  std::vector<std::string> names() const;  ///< names of all keys, as written
  const std::string& key() const noexcept { return key_; }

  // Required values: an error if they are missing.
  double quantity(const std::string& name, const std::string& si_unit, const Range& range);
  std::vector<double> quantities(const std::string& name, const std::string& si_unit, const Range& range,
                                 std::size_t count);
  /// Reads as many quantities as are written, at least one.
  std::vector<double> list(const std::string& name, const std::string& si_unit, const Range& range);
  std::string text(const std::string& name, const std::string& remedy = "is missing; add it");
  /// A text that names a thing (name_fault).
  std::string name(const std::string& key, const std::string& remedy = "is missing; add it");
  std::vector<TextAt> texts(const std::string& name);
  SceneTable table(const std::string& name);
  std::vector<SceneTable> tables(const std::string& name);
  /// An array of tables that may be missing: then none.
  std::vector<SceneTable> tables_if_any(const std::string& name);
  /// A table that may be missing: then an empty one, whose defaults are recorded.
  SceneTable table_or_empty(const std::string& name);
  /// A ratio: a number, or a text such as "-1/20".
  double ratio(const std::string& name);

  // Values that may be missing. A default that is taken is recorded with its reason.
  std::optional<double> quantity_if_given(const std::string& name, const std::string& si_unit,
                                          const Range& range);
  double quantity_or(const std::string& name, const std::string& si_unit, const Range& range, double value,
                     const std::string& reason);
  int count_or(const std::string& name, int least, int most, int value, const std::string& reason);
  bool flag_or(const std::string& name, bool value, const std::string& reason);
  std::string text_or(const std::string& name, const std::string& value, const std::string& reason);

  /// Makes a key known without reading it.
  void know(const std::string& name);
  /// Makes a key known, which may be missing.
  /// @return whether it is there
  bool is_given(const std::string& name);
  void record_default(const std::string& name, const std::string& value, const std::string& reason);

  /// Reports an error at the value of that key; at the table itself if it has no such key.
  void refuse(const std::string& name, const std::string& remedy);
  /// Reports a missing key at the table; an empty name means the table as a whole.
  void refuse_missing(const std::string& name, const std::string& remedy);

  /// Place where a key's value stands and how it is written, for errors that come to light after reading; the
  /// table's own place if it has no such key.
  TextAt written_at(const std::string& name) const;
  /// "file:line:column: key = value" of every key in the table of that name, for the same; by key.
  std::map<std::string, std::string> places_in(const std::string& name) const;
  /// "file:line:column: key", for errors that come to light after reading.
  std::string origin() const;

  /// Reports the keys that nobody asked for, with the nearest known one, and the required keys that are
  /// missing.
  void finish();

private:
  struct Missing {
    std::string name, remedy;
  };

  /// Notes what may stand under a key.
  void note(const std::string& name, const KeyForm& form) const;
  const TomlEntry* find(const std::string& name);
  const TomlEntry* require(const std::string& name, const std::string& remedy);
  std::string dotted(const std::string& name) const;
  double read_quantity(const TomlNode& node, const std::string& name, const std::string& si_unit,
                       const Range& range);
  void refuse_node(const TomlNode& node, const std::string& name, const std::string& remedy);

  const TomlNode* node_;
  SourcePosition at_;  ///< position of the table, or of the one that encloses it if it is missing
  std::string key_;
  SceneFindings* findings_;
  bool is_present_ = true;
  std::vector<std::string> known_;
  std::vector<Missing> missing_;
};

}  // namespace pipelines
