#include "experiments/python/long_call.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace py = pybind11;

namespace halfstep::python {
namespace {

constexpr std::chrono::milliseconds kLookEvery{50};

// A long call under way.
struct CallState {
  std::mutex mutex;  // of what follows; never held while waiting for the GIL
  std::condition_variable changed;
  bool done = false, news = false;
  std::string what;
  double fraction = 0.0;
  std::exception_ptr thrown;  // by the work
  std::stop_source stop;
  RaisedBySearch raised = RaisedBySearch::kEndsTheCall;
  std::optional<py::error_already_set> error;  // only with the GIL
};

// How many long calls are under way.
std::atomic<int> g_calls = 0;

// Of the thread that runs the work of a long call.
thread_local CallState* t_current = nullptr;

// Looks for signals and tells the news. Needs the GIL.
void Attend(const py::object& progress, CallState* state) {
  if (state->error) return;
  std::string what;
  double fraction = 0.0;
  bool news = false;
  {
    const std::lock_guard lock(state->mutex);
    news = std::exchange(state->news, false);
    what = state->what;
    fraction = state->fraction;
  }
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (news && !progress.is_none()) progress(what, fraction);
  } catch (const py::error_already_set& error) {
    state->error = error;
    state->stop.request_stop();
  }
}

void Work(const std::function<void(const LongCallHooks&)>& work, CallState* state) {
  t_current = state;
  try {
    work({.stop = state->stop.get_token(), .progress = [state](const std::string& what, double f) {
            const std::lock_guard lock(state->mutex);
            state->what = what;
            state->fraction = f;
            state->news = true;
          }});
  } catch (...) {
    state->thrown = std::current_exception();
  }
  const std::lock_guard lock(state->mutex);
  state->done = true;
  state->changed.notify_all();
}

}  // namespace

void CallLong(const py::object& progress, const std::function<void(const LongCallHooks&)>& work,
              RaisedBySearch raised) {
  struct Counted {
    Counted() { ++g_calls; }
    ~Counted() { --g_calls; }
  };
  const Counted counted;
  CallState state;
  state.raised = raised;
  CallState* const enclosing = t_current;
  {
    const py::gil_scoped_release released;
    const std::jthread worker([&] { Work(work, &state); });
    std::unique_lock lock(state.mutex);
    while (!state.changed.wait_for(lock, kLookEvery, [&] { return state.done; })) {
      lock.unlock();
      if (enclosing != nullptr && enclosing->stop.stop_requested()) state.stop.request_stop();
      {
        const py::gil_scoped_acquire acquired;
        Attend(progress, &state);
      }
      lock.lock();
    }
  }
  Attend(progress, &state);  // the last news of a call that was short
  if (state.error) throw py::error_already_set(*state.error);
  if (state.thrown) std::rethrow_exception(state.thrown);
}

bool LongCallUnderWay() { return g_calls > 0; }

void KeepPythonError(const py::error_already_set& error) {
  if (t_current == nullptr || t_current->error) return;
  const bool of_method = t_current->raised == RaisedBySearch::kEndsTheMethodOnly;
  if (of_method && error.matches(PyExc_Exception)) return;
  t_current->error = error;
  t_current->stop.request_stop();
}

}  // namespace halfstep::python
