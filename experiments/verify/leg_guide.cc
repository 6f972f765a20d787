#include "experiments/verify/leg_guide.h"

#include <algorithm>
#include <cmath>

#include "experiments/verify/robot_posture.h"
#include "experiments/verify/tolerances.h"

namespace halfstep::verify {
namespace {

constexpr double kPeriod = 5e-3;  // of HRP-2's size [s]
constexpr size_t kBlock = 16;   // angles from one that is found without its neighbours to the next
constexpr double kSame = 1e-9;  // angles that are found in two ways [rad]
constexpr double kJump = 0.2;   // angles farther apart say nothing of those between [rad]

// NaNs compare as false: maxCoeff() alone may pass them over.
bool Within(const Vector6d& way, double most) { return (way.cwiseAbs().array() <= most).all(); }

}  // namespace

void LegGuide::Extend(const RobotModel& robot, double from, double to, const Numbers& numbers) {
  if (robot.legs[0].met.empty() && robot.legs[1].met.empty()) return;
  period_ = kPeriod * Tolerances(robot).time;
  const auto kept = static_cast<size_t>(std::floor(std::max(from, 0.0) / period_)) + 1;
  angles_.resize(std::min(angles_.size(), from > 0.0 ? kept : 0));
  const auto count = static_cast<size_t>(std::ceil(to / period_)) + 1;
  const auto at = [&](size_t k) { return numbers(static_cast<double>(k) * period_); };
  const auto chained = [&](size_t k) {
    std::array<Vector6d, 2> near = angles_[k - 1];
    if (k > 1) {
      for (size_t side = 0; side < 2; ++side)
        near[side] += angles_[k - 1][side] - angles_[k - 2][side];
    }
    return PostureOf(robot, at(k), &near).q;
  };
  for (size_t k = angles_.size(); k < count; ++k) {
    if (k % kBlock != 0) {
      angles_.push_back(chained(k));
      continue;
    }
    const std::array<Vector6d, 2> alone = PostureOf(robot, at(k)).q;
    if (k > 0) {
      const std::array<Vector6d, 2> last = chained(k);
      const bool same = Within(last[0] - alone[0], kSame) && Within(last[1] - alone[1], kSame);
      for (size_t i = k - kBlock + 1; i < k && !same; ++i) angles_[i] = PostureOf(robot, at(i)).q;
    }
    angles_.push_back(alone);
  }
}

std::array<Vector6d, 2> LegGuide::Near(double t) const {
  const Vector6d unknown = Vector6d::Constant(std::nan(""));
  std::array<Vector6d, 2> near = {unknown, unknown};
  if (angles_.size() < 2) return near;
  const double place = std::max(t, 0.0) / period_;
  const size_t k = std::min(static_cast<size_t>(place), angles_.size() - 2);
  const double share = place - static_cast<double>(k);
  if (share > 1.0) return near;
  for (size_t side = 0; side < 2; ++side) {
    const Vector6d &a = angles_[k][side], &b = angles_[k + 1][side];
    if (!Within(b - a, kJump)) continue;
    near[side] = a + share * (b - a);
    if (k == 0 || k + 2 >= angles_.size()) continue;
    // What the cubic through the four around it adds to the straight line.
    const Vector6d before = angles_[k - 1][side] - 2 * a + b,
                   after = a - 2 * b + angles_[k + 2][side];
    const Vector6d bent = share * (1 - share) / 6 * ((2 - share) * before + (1 + share) * after);
    if (Within(bent, kJump)) near[side] -= bent;
  }
  return near;
}

}  // namespace halfstep::verify
