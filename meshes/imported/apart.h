/// Work in a process of its own, for libraries that crash where they should refuse.
///
/// The child is a copy of this process (fork) that ends without returning to the caller. It runs on one
/// thread and touches neither MPI nor the thread pools that the caller may have started; their threads do not
/// exist in the child and are idle while a mesh is made, so that they hold no lock it would need, and the C
/// library keeps its own locks sound over a fork. A program started anew would be one more path to find, also
/// from programs that only link this library.
#pragma once

#include <functional>
#include <string>

namespace meshes {

/// How work that was done apart has ended.
struct EndApart {
  enum class Kind { finished, crashed, too_slow, too_late, too_large };
  Kind kind = Kind::finished;
  int signal = 0;      ///< signal that ended it, if it crashed
  std::string result;  ///< what the work has returned, if it finished
  std::string log;     ///< what it printed
};

/// Limits the seconds of a core that the rest of the work may take; only to be called by the work itself.
/// The clock on the wall may show ten times as much.
void limit_rest_apart(double seconds);

/// While it lives, work done apart ends on the clock on the wall after these seconds, whatever its own
/// limits: what a search has left. One at a time.
class DeadlineApart {
public:
  explicit DeadlineApart(double seconds);
  ~DeadlineApart();
  DeadlineApart(const DeadlineApart&) = delete;
  DeadlineApart& operator=(const DeadlineApart&) = delete;
};

/// Does the work in a child process and waits for it. The child may take as much memory as is free, and
/// prints into the log. An exception must not leave the work.
/// @throws MeshRefused if no process can be started
EndApart run_apart(const std::function<std::string()>& work, double seconds);

}  // namespace meshes
