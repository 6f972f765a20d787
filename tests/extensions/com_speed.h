#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "smoothing/margins/own_margin.h"

namespace halfstep {

inline constexpr double kComSpeedLimit = 0.27;  // [m/s]

/// A margin of one's own: the CoM is never faster than kComSpeedLimit.
class ComSpeedStatement : public OwnStatement {
 public:
  std::string name() const override { return "CoM's speed"; }
  double scale() const override { return 0.1; }
  double Value(Instant* at) const override { return kComSpeedLimit - Velocity(at->jet()).norm(); }
  double Change(const MarginInterval& interval) const override {
    return interval.motion.half_width * interval.motion.second.segment<2>(kComX).norm();
  }
  std::vector<double> Slopes(Instant* at,
                             const std::vector<WalkSensitivity>& along) const override {
    const Eigen::Vector2d v = Velocity(at->jet());
    std::vector<double> slopes;
    for (const WalkSensitivity& s : along) {
      slopes.push_back(-v.dot(Velocity(s.jet)) / std::max(v.norm(), 1e-9));
    }
    return slopes;
  }

 private:
  static Eigen::Vector2d Velocity(const WalkJet& jet) { return jet.first.segment<2>(kComX); }
};

}  // namespace halfstep
