#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace halfstep {

/// How a worker ended: `status` when it exited, else −1 and the signal that killed it.
struct WorkerEnd {
  int status = -1;    ///< of exit()
  int signal = 0;     ///< 0: it exited
  double wall = 0.0;  ///< [s]
};

/// Runs this program once for each list of arguments, at most `jobs` at a time, and calls `ended`
/// for each in the order in which they end; once it returns false, no more are started. A stop
/// request is passed on to the workers as SIGTERM; Ctrl-C of a terminal does not reach them by
/// itself, and they die with this process. Returns when none runs any more; `waiting` is called
/// some hundred times a second until then. Throws std::runtime_error when no process can be made.
void RunWorkers(const std::vector<std::vector<std::string>>& arguments, int jobs,
                const std::function<bool(size_t, const WorkerEnd&)>& ended,
                const std::function<void()>& waiting, std::stop_token stop);

}  // namespace halfstep
