#include "wpg/workers.h"

#include "wpg/check.h"

namespace halfstep {
namespace {

// How often a thread looks for more work, or for the end of it, before it sleeps: some tens of
// microseconds. Fewer: it sleeps while the next work comes; more: it takes time from others.
constexpr int kLooks = 200;

int RunAlone(int count, const Workers::Work& work) {
  for (int i = 0; i < count; ++i) {
    if (!work(i, 0)) return i;
  }
  return count;
}

}  // namespace

Workers::Workers(int threads) {
  HALFSTEP_CHECK(threads >= 1, threads << " threads");
  for (int thread = 1; thread < threads; ++thread) {
    others_.emplace_back([this, thread] { Serve(thread); });
  }
}

Workers::~Workers() {
  ending_ = true;
  ++rounds_;
  rounds_.notify_all();
  for (std::thread& other : others_) other.join();
}

int Workers::Run(int count, const Work& work) {
  if (others_.empty() || count < 2) return RunAlone(count, work);
  work_ = &work;
  count_ = count;
  next_ = 0;
  stop_ = count;
  failure_ = nullptr;
  open_ = true;
  ++rounds_;
  rounds_.notify_all();
  TakeAll(0);
  // Who comes now finds the call closed; who came before is waited for.
  open_ = false;
  for (int look = 0; inside_ != 0; ++look) {
    if (look < kLooks) {
      std::this_thread::yield();
    } else if (const int inside = inside_; inside != 0) {
      inside_.wait(inside);
    }
  }
  if (failure_ && failed_ == stop_) std::rethrow_exception(failure_);
  return stop_;
}

void Workers::Serve(int thread) {
  uint32_t seen = 0;
  while (!ending_) {
    for (int look = 0; look < kLooks && rounds_ == seen; ++look) std::this_thread::yield();
    rounds_.wait(seen);
    seen = rounds_;
    ++inside_;
    if (open_) TakeAll(thread);
    --inside_;
    inside_.notify_all();
  }
}

void Workers::TakeAll(int thread) {
  for (int i = next_++; i < count_ && i < stop_; i = next_++) {
    try {
      if (!(*work_)(i, thread)) StopAt(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_ || i < failed_) {
        failure_ = std::current_exception();
        failed_ = i;
      }
      StopAt(i);
    }
  }
}

void Workers::StopAt(int index) {
  int before = stop_;
  while (index < before && !stop_.compare_exchange_weak(before, index)) {
  }
}

int RunWith(Workers* workers, int count, const Workers::Work& work) {
  return workers ? workers->Run(count, work) : RunAlone(count, work);
}

int NumThreads(const Workers* workers) { return workers ? workers->threads() : 1; }

}  // namespace halfstep
