#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <stop_token>
#include <string>

namespace halfstep::python {

/// What a long call hands to the work that it runs.
struct LongCallHooks {
  std::stop_token stop;  ///< requested by Ctrl-C, or when the user's progress function raises
  std::function<void(const std::string& what, double done)> progress;  ///< from any thread
};

/// What becomes of an exception that a function of the user's raises within a long call.
enum class RaisedBySearch {
  kEndsTheCall,       ///< it is raised when the call ends
  kEndsTheMethodOnly  ///< it is the method's own failure, unless it is no Exception (Ctrl-C)
};

/// Runs `work` in a thread of its own, without the GIL, while the calling thread looks for signals
/// every 50 ms and calls `progress(what, done)`, unless that is None, with the latest news. When
/// Ctrl-C came, or `progress` raised, `work` is told to stop, and the exception is raised when it
/// has ended. Otherwise throws what `work` threw or what KeepPythonError() kept.
void CallLong(const pybind11::object& progress,
              const std::function<void(const LongCallHooks&)>& work,
              RaisedBySearch raised = RaisedBySearch::kEndsTheCall);

/// Whether any long call is under way.
bool LongCallUnderWay();

/// Keeps an exception that a function of the user's raised within the long call of this thread, to
/// be raised when that call ends, or drops it where it is the method's only. Without a long call it
/// is dropped. The first one counts. Needs the GIL.
void KeepPythonError(const pybind11::error_already_set& error);

}  // namespace halfstep::python
