/// Sound files that cases damage.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fuzz {

struct Samples {
  std::vector<std::string> scenes;         ///< one for each machine and body; they name belt_pull.csv
  std::vector<std::string> beam_scenes;    ///< with a shaft, short to run by the beam model
  std::string table_scene;                 ///< without a body, on belt_pull.csv
  std::vector<std::string> tables;         ///< that may stand for belt_pull.csv
  std::string sound_table;                 ///< belt_pull.csv as shipped
  std::vector<std::string> steps, meshes;  ///< of the same block with a hole, in mm
  std::string responses;                   ///< kept under `kept_key`
  std::vector<std::map<std::string, std::string>> results;  ///< files of result directories
};

inline const std::string kept_key = "key";

/// @param directory  to work in, empty
/// @param program    millstress: makes the results
/// @throws std::runtime_error if a sample is not accepted
Samples make_samples(const std::filesystem::path& directory, const std::filesystem::path& program);

}  // namespace fuzz
