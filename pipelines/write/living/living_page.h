/// What lets a page put the stress of a run together anew: every body's surface with the modes of its unit
/// fields, the factors over the cycle without each effect, and the loads.
#pragma once

#include <string>
#include <vector>

#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/stage/load_stage.h"

namespace pipelines {

/// The file in which a run keeps it, so that its page can be made again.
inline constexpr const char* living_data_name = "report.data";

struct LivingPage {
  std::string keys;  ///< JSON on one line; README.md of this room has its keys
  std::string data;  ///< bytes: sections of numbers, deflated (packed_block.h)

  bool empty() const { return keys.empty(); }
};

/// The same input gives the same text. Called on all ranks that share a body; empty but on the first.
/// @param loaded    what the analyses were loaded with
/// @param analyses  in the order of the scene's bodies; none: the loads alone
LivingPage living_page(const Loaded& loaded, const std::vector<Judged>& analyses, int n_threads);

/// The elements of a page that hold it, the bytes in base64.
std::string living_elements(const LivingPage& living);

/// The content of the file that keeps it: the line of keys, and the bytes.
std::string living_file(const LivingPage& living);

/// Reads what living_file wrote; empty where there is no line.
LivingPage living_of(const std::string& content);

}  // namespace pipelines
