/// Work on many points: what ends one of them and what ends the sweep.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/common/failure.h"

namespace pipelines {

/// What a point's own numbers may be refused for becomes its row; a disk that is full and errors of the
/// program end the sweep.
/// @return why work() was refused; empty if it was not
template <typename Work>
std::string point_refusal(const Work& work) {
  try {
    work();
    return {};
  } catch (const FileError&) {
    throw;
  } catch (const std::filesystem::filesystem_error&) {
    throw;
  } catch (...) {
    auto failure = failure_in_flight();
    if (failure.message.find("internal error") != std::string::npos) throw;
    return std::move(failure.message);
  }
}

}  // namespace pipelines
