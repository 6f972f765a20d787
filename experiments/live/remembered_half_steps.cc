#include "experiments/live/remembered_half_steps.h"

#include <cmath>
#include <cstdint>

namespace halfstep {
namespace {

// All that the motion from the beginning of half-step j to its end depends on, when nothing comes
// after it, seen from its support sole, and where that stands where it counts.
std::string KeyOf(const SuperposedWalk& walk, int j, bool by_place) {
  std::string key;
  const auto add = [&key](double x) {
    constexpr double kRounding = 1e-12;  // [m], [rad], [s]; equal values may round apart, rarely
    const auto rounded = static_cast<std::int64_t>(std::llround(x / kRounding));
    key.append(reinterpret_cast<const char*>(&rounded), sizeof rounded);
  };
  const auto add_place = [&add](const Foothold& place) {
    for (const double x : {place.x, place.y, place.yaw, place.height}) add(x);
  };
  const double begin = walk.start_of(j);
  if (by_place) add_place(walk.X_WS(j));
  for (int i = j; i >= 0 && (i == j || walk.end_of(i) > begin); --i) {
    const HalfStep& half_step = walk.half_step(i);
    key.push_back(half_step.support == Side::kLeft ? 'l' : 'r');
    key.push_back(half_step.kind == HalfStepKind::kUp ? 'u' : 'd');
    add_place(walk.X_WS(j).Inverse() * walk.X_WS(i));
    add_place(half_step.X_SF);
    for (const double x : {begin - walk.start_of(i), walk.tracks(i).duration(),
                           half_step.via_height, half_step.via_lateral, half_step.via_along}) {
      add(x);
    }
    for (const double x : half_step.shape.numbers()) add(x);
    add(half_step.crouch_on_floor());
    add(walk.X_WS(i).height);
  }
  return key;
}

}  // namespace

bool RememberedHalfSteps::Knows(const SuperposedWalk& walk, int j) const {
  const std::string key = KeyOf(walk, j, by_place_);
  const std::lock_guard lock(mutex_);
  return known_.contains(key);
}

void RememberedHalfSteps::Remember(const SuperposedWalk& walk, int j) {
  std::string key = KeyOf(walk, j, by_place_);
  const std::lock_guard lock(mutex_);
  known_.insert(std::move(key));
}

}  // namespace halfstep
