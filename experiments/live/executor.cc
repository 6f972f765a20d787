#include "experiments/live/executor.h"

#include <utility>

namespace halfstep {

Executor::Executor(WalkPlan plan, const Grant& grant)
    : plan_(std::move(plan)), walk_(plan_.Walk()), grant_(grant) {}

std::vector<int> Executor::Advance(double until) {
  std::vector<int> begin;
  while (!stopped_ && begun_ + 1 < walk_.num_half_steps()) {
    const int next = begun_ + 1;
    if (walk_.start_of(next) >= until) break;
    if (next > grant_.through || walk_.end_of(next) > grant_.valid_until) {
      stopped_ = true;
      break;
    }
    begun_ = next;
    begin.push_back(next);
  }
  return begin;
}

std::string Executor::TakeOver(const WalkPlan& plan, const Grant& grant, double now) {
  const SuperposedWalk successor = plan.Walk();
  if (CommonHalfSteps(walk_, successor) <= begun_) return "it changes a half-step that has begun";
  if (begun_ + 1 < successor.num_half_steps() && successor.start_of(begun_ + 1) < now) {
    return "its next half-step should have begun already";
  }
  plan_ = plan;
  walk_ = successor;
  grant_ = grant;
  stopped_ = false;
  return "";
}

}  // namespace halfstep
