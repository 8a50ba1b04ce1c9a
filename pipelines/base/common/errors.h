/// What goes wrong, by name. Users' mistakes end with exit code 2, meshes and solves that fail with 3;
/// whatever has no name here, in kinetics/values/machine_refused.h, meshes/values/refused.h or
/// fem/base/values/errors.h is a mistake of the program (failure.h).
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace pipelines {

/// One thing that is wrong with a scene.
struct SceneFinding {
  std::string file;
  int line = 0, column = 0;  ///< 1-based; 0 where the file as a whole is meant
  std::string key;           ///< dotted, items counted from 1, e.g. "shaft.contour[3].diameter"; may be empty
  std::string value;         ///< as written; empty if missing
  std::string remedy;        ///< a sentence: what is wrong and what to do

  /// "file:line:column: key = value: remedy"
  std::string text() const;
};

/// Holds all that is wrong with a scene, at once; the message tells the first twenty and how many more there
/// are.
class SceneError : public std::runtime_error {
public:
  explicit SceneError(std::vector<SceneFinding> findings);
  const std::vector<SceneFinding>& findings() const noexcept { return findings_; }

private:
  std::vector<SceneFinding> findings_;
};

/// An option of the command line with a value that it cannot have; the message names both and the remedy.
class OptionError : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

/// What a stage finds wrong with a scene that reads well: loads on a port that the mesh does not have, masses
/// that disagree, a command that the machine has no use for. A user's mistake.
class StageRefused : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

/// Loads of a body that leave a resultant which nothing carries.
class LoadsDoNotClose : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A number that a stage must not pass on (finite.h).
class NotFinite : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A file, directory or database that cannot be read or written; the message names it.
class FileError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

}  // namespace pipelines
