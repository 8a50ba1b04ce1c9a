/// Results of two runs in one directory, as small files.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/write/files/manifest.h"
#include "pipelines/write/files/staged_results.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace staged_samples {

using namespace pipelines;
using results_test::bytes;
namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

inline Files visible_files(const fs::path& directory) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (const auto name = fs::relative(entry.path(), directory).generic_string();
        entry.is_regular_file() && name[0] != '.')
      files[name] = bytes(entry.path());
  return files;
}

inline const std::string first_summary =
    R"({"program": {"name": "millstress"}, "bodies": {"shaft": {}, "drum": {}}, "run": "first"})";

/// Two bodies.
inline void write_first(StagedResults& staged) {
  write_text_file(staged.folder() / "summary.json", first_summary);
  write_text_file(staged.folder() / "report.html", "first");
  write_text_file(staged.folder() / "loads.csv", "first");
  for (const char* name : {"shaft/zones.csv", "shaft/hot_spots.csv", "shaft/cycle_003.vtu", "drum/zones.csv",
                           "drum/unit_responses.h5", "torsion/modes.csv"})
    write_text_file(staged.folder() / name, "first");
}

/// One body, and other files of it.
inline void write_second(StagedResults& staged) {
  write_text_file(staged.folder() / "summary.json",
                  R"({"program": {"name": "millstress"}, "bodies": {"shaft": {}}, "run": "second"})");
  write_text_file(staged.folder() / "report.html", "second");
  write_text_file(staged.folder() / "loads.csv", "second");
  for (const char* name : {"shaft/zones.csv", "shaft/mesh.msh"})
    write_text_file(staged.folder() / name, "second");
}

inline void publish_first(const fs::path& directory) {
  StagedResults staged(directory, run_names({"shaft", "drum"}));
  write_first(staged);
  staged.publish();
  std::ofstream(directory / "shaft/notes.txt") << "mine";
}

inline void publish_second(const fs::path& directory) {
  StagedResults staged(directory, run_names({"shaft"}));
  write_second(staged);
  staged.publish();
}

/// @return why it is refused; empty if it is not
template <typename Error = OptionError>
std::string refusal(const fs::path& directory) {
  try {
    publish_second(directory);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

inline void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nhas no: " << part;
}

/// A manifest whose checksum is right, whatever it lists.
inline void write_list(const fs::path& manifest, const FileList& list) {
  std::ofstream(manifest, std::ios::binary) << manifest_text(list);
}

}  // namespace staged_samples
