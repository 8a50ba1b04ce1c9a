/// The journal of a sweep, from which an interrupted one goes on.
///
/// Text, a line each with a checksum of its own, so that a line that a kill has cut, or that is damaged, is
/// computed again, and no other:
///   HASH KEY                          the first line: a hash of all that the rows depend on
///   HASH {"columns": N, "figures": [[NAME, UNIT], ...]}
///                                     what the rows below have that refer to it by its number
///   HASH N VALUES [SETTINGS, TEXTS, ZONE, ...]
///                                     a row: its figures, then lists
/// Between processes also
///   HASH [SETTINGS, REASON]           a row that was refused
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/study/sweep/sweep_row.h"
#include "pipelines/study/variations/sweep_options.h"
#include "pipelines/study/variations/sweep_points.h"

namespace pipelines {

/// All that rows depend on beside their settings, once a point was read: the program, the files that were
/// read, the settings of all points, and what is asked for.
/// @param kind  of what keeps the journal: "sweep"
std::string journal_key(const std::string& kind, const SweepOptions& options);

class SweepJournal {
public:
  /// @param key  key of all that the rows depend on beside their settings
  SweepJournal(std::filesystem::path file, std::string key);

  /// Whether a sweep has written a file.
  static bool is_journal(const std::filesystem::path& file);

  /// Rows of an earlier sweep with the same key, by point; none if there is no such journal, or one of
  /// another form.
  std::vector<std::optional<SweepRow>> known(const SweepPlan& plan) const;
  /// Begins the journal anew with the rows that are known.
  void begin(const SweepPlan& plan, const std::vector<std::optional<SweepRow>>& known);
  /// Keeps a row unless it was refused: what refused it may be gone next time (memory, a file).
  void append(const SweepPoint& point, const SweepRow& row);
  /// Brings what was appended to the disk.
  /// @throws FileError if it cannot be written
  void flush();

  /// Rows as lines that another process can read, refused ones too.
  static std::string lines_of(const SweepPlan& plan, const std::vector<std::size_t>& points,
                              const std::vector<SweepRow>& rows);
  /// @return the rows of such lines, by point
  static std::vector<std::optional<SweepRow>> rows_of(const std::string& lines, const SweepPlan& plan);

private:
  static std::vector<std::optional<SweepRow>> read_rows(std::istream& in, const SweepPlan& plan);
  /// The number of a row's figures, from 1; notes those that are new.
  std::size_t number_of_columns(const SweepFigures& figures);

  std::filesystem::path file_;
  std::string key_, pending_;
  std::map<std::string, std::size_t> columns_;  ///< noted in the file, names and units as JSON
  SweepFigures latest_;                         ///< of a row of `latest_number_`: most rows share its names
  std::size_t latest_number_ = 0;
};

}  // namespace pipelines
