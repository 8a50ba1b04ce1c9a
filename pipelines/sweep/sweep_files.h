/// What a sweep leaves: one table of all points, and a journal from which an interrupted sweep goes on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/sweep/sweep_points.h"
#include "pipelines/sweep/sweep_row.h"

namespace pipelines {

/// A row per point: its number, from 1, the varied keys with their values, why it was refused, then every
/// figure that any point has ("nan" where this one has none) and every text.
void write_sweep_csv(const std::filesystem::path& file, const SweepPlan& plan,
                     const std::vector<SweepRow>& rows);

/// The same as datasets of one value per point: /keys/<key>, /figures/<figure> with the unit as attribute,
/// /texts/<name>, /refused. In names a dash stands for a slash.
void write_sweep_h5(const std::filesystem::path& file, const SweepPlan& plan,
                    const std::vector<SweepRow>& rows, const std::string& title);

std::string sweep_json(const SweepPlan& plan, const std::vector<SweepRow>& rows);

/// Rows as they were computed, one line each with a checksum of its own: a line that a kill has cut, or that
/// is damaged, is computed again.
class SweepJournal {
public:
  /// @param key  of all that the rows depend on beside their settings
  SweepJournal(std::filesystem::path file, std::string key);

  /// @throws OptionError if a file of that name is there that no sweep has written
  void require_own() const;

  /// Rows of an earlier sweep with the same key, by point, those that were computed; none if there is no such
  /// journal.
  std::vector<std::optional<SweepRow>> known(const SweepPlan& plan) const;
  /// Begins the journal anew with the rows that are known.
  void begin(const SweepPlan& plan, const std::vector<std::optional<SweepRow>>& known);
  /// @throws FileError if it cannot be written
  void append(const SweepPoint& point, const SweepRow& row);
  /// Brings what was appended to the disk.
  void flush();

private:
  std::filesystem::path file_;
  std::string key_, pending_;
};

}  // namespace pipelines
