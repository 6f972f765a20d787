#include "experiments/live/executor.h"

#include <utility>

#include "experiments/live/recent_part.h"

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
  const int common = CommonHalfSteps(walk_, successor);
  if (common <= begun_) return "it changes a half-step that has begun";
  if (begun_ + 1 < successor.num_half_steps() && successor.start_of(begun_ + 1) < now) {
    return "its next half-step should have begun already";
  }
  plan_ = plan;
  walk_ = successor;
  grant_ = grant;
  common_ = common;
  stopped_ = false;
  return "";
}

int Executor::Forget() {
  std::optional<RecentPart> recent = RecentPart::Of(plan_, walk_, begun_);
  if (!recent) return 0;
  const int less = recent->first;
  plan_ = std::move(recent->plan);
  walk_ = plan_.Walk();
  grant_.through -= less;
  std::erase_if(grant_.near, [less](int near) { return near < less; });
  for (int& near : grant_.near) near -= less;
  begun_ -= less;
  common_ -= less;
  first_ += less;
  return less;
}

}  // namespace halfstep
