#include "experiments/live/promise.h"

#include <algorithm>

namespace halfstep {

std::string_view Name(PromiseStatus status) {
  switch (status) {
    case PromiseStatus::kKept:
      return "kept";
    case PromiseStatus::kNotKept:
      return "not_kept";
    case PromiseStatus::kTouched:
      return "touched";
  }
  return "";
}

void BrokenPromise::Add(const Contradiction& place, int measurements) {
  if (!place.was_there) {
    was_there = false;
    return;
  }
  beyond = std::max(beyond, place.beyond());
  const double way = place.moved - place.errors;
  speed = std::max(
      speed, place.elapsed > 0.0 ? way / place.elapsed : std::numeric_limits<double>::infinity());
  error = std::max(error, (place.moved - place.speed * place.elapsed) / measurements);
}

}  // namespace halfstep
