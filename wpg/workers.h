#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace halfstep {

/// Threads that share work out among themselves, the caller's being one of them. They are started
/// once, so that work of a fraction of a millisecond is worth sharing. What the work finds does not
/// depend on their number as long as each index writes to a place of its own and reads nothing that
/// another one writes.
class Workers {
 public:
  /// What is done for an index by a thread ∈ [0, threads()), which may keep memory of its own.
  /// False: larger indices need not be begun any more.
  using Work = std::function<bool(int index, int thread)>;

  /// `threads` ≥ 1 (std::logic_error), the caller's included.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return static_cast<int>(others_.size()) + 1; }  ///< the caller's included

  /// Does the work of indices 0, 1, … in their order, until `count` or one that says false, and
  /// returns that index, or `count`: all before it are done. Larger ones may be done as well; which
  /// depends on the threads. What the work throws is thrown again, of the smallest such index. One
  /// call at a time; the work itself must not call it.
  int Run(int count, const Work& work);

 private:
  void Serve(int thread);
  void TakeAll(int thread);
  void StopAt(int index);

  const Work* work_ = nullptr;  // of the call under way, with what follows
  int count_ = 0;
  std::atomic<int> next_ = 0, stop_ = 0;
  std::mutex mutex_;  // of the failure
  std::exception_ptr failure_;
  int failed_ = 0;

  std::atomic<bool> open_ = false, ending_ = false;
  std::atomic<int> inside_ = 0;       // other threads that may look at the call
  std::atomic<uint32_t> rounds_ = 0;  // counts calls
  std::vector<std::thread> others_;
};

/// The same by the caller alone where `workers` is null.
int RunWith(Workers* workers, int count, const Workers::Work& work);

/// How many threads RunWith uses.
int NumThreads(const Workers* workers);

}  // namespace halfstep
