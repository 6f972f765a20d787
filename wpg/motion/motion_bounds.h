#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "wpg/motion/posture.h"
#include "wpg/motion/posture_rounding.h"
#include "wpg/motion/walk_state.h"
#include "wpg/robot/leg_motion_bound.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How far a robot can be, over an interval of time, from where it is at the interval's midpoint m:
/// the exact robot, from where it is computed to be. Everything holds for all t in [m − h, m + h],
/// and rates are suprema there. In the world frame unless said otherwise.
struct IntervalMotion {
  double half_width = 0.0;                  ///< h [s]
  WalkJet jet;                              ///< at m
  Posture posture;                          ///< at m, links placed, joint speeds solved
  WalkState second;                         ///< sup |ẍ| of every quantity [1/s²]
  std::array<JointBounds, 2> joints;        ///< by Index(Side)
  std::array<double, 2> leg_length_change;  ///< of the hip–ankle distance [m]
  std::vector<double> displacement;         ///< of any point of a body from its place at m [m]
  std::vector<double> displacement_B;       ///< the same, as seen from the waist [m]
  WalkJet off;               ///< how far jet may be off by rounding; contained in all bounds
  PostureRounding rounding;  ///< the same of posture
  /// False when there is no bound, because a leg does not reach at m or comes too near to stretched
  /// within the interval.
  bool bounded = false;

  /// |x(t) − x(m)| of a quantity.
  double Change(int quantity) const {
    return half_width * (std::abs(jet.first[quantity]) + off.first[quantity] +
                         0.5 * half_width * second[quantity]) +
           off.value[quantity];
  }
  /// sup |ẋ(t) − ẋ(m)| of a quantity.
  double RateChange(int quantity) const {
    return half_width * second[quantity] + off.first[quantity];
  }
};

/// Bounds the motion of one robot. Const and thread-safe; results are the caller's.
class MotionBounds {
 public:
  /// `robot` is borrowed and must outlive this.
  explicit MotionBounds(const RobotModel& robot);

  /// Bounds a motion whose quantities are `mid` at m and have |second derivatives| of at most
  /// `second` for all t in [m − h, m + h], h = `half_width` ≥ 0 [s]. The bounds hold for any h, and
  /// are tight for short ones. `rounding` says how far `mid` may be from the motion that is meant:
  /// value, first and second; without it numbers are taken as exact.
  /// Source: smoothing/README.md, "Motion bounds" and "Rounding".
  void Bound(const WalkJet& mid, const WalkState& second, double half_width, IntervalMotion* motion,
             const WalkJet* rounding = nullptr) const;

 private:
  // Motion of the waist or of a sole over the interval: sups of its rates, in W unless said.
  struct BaseRates {
    double speed = 0.0;             // of the frame's origin [m/s]
    double acceleration = 0.0;      // [m/s²]
    double yaw_rate = 0.0;          // [rad/s]
    double yaw_acceleration = 0.0;  // [rad/s²]
  };
  struct LegRates {
    BaseRates sole;
    BaseRates sole_B;  // seen from the waist
    // At m, of link i, seen from the waist: angular velocity, and velocity where B's origin is.
    std::array<Eigen::Vector3d, 6> omega_B, velocity_B;
  };
  static BaseRates SoleRates(const IntervalMotion& motion, Side side);
  static double Turning(const BaseRates& base);  // sup |ψ̈ẑ×x − ψ̇²x| at distance 1 [1/s²]
  BaseRates WaistRates(const IntervalMotion& motion) const;
  static LegRates RatesOfLeg(const IntervalMotion& motion, Side side, const BaseRates& waist);
  // sup ‖P̈‖ of a point that links turn, at most as far from what they turn about as `levers` [m]
  // say, on a base that moves by `base` and from whose vertical axis P is at most `lever` [m].
  static double AccelerationFrom(const BaseRates& base, const std::array<TurnBound, 6>& turns,
                                 const std::array<double, 6>& levers, double lever);
  bool BoundLeg(Side side, const BaseRates& waist, const LegRates& rates,
                IntervalMotion* motion) const;
  bool BoundOffsetLeg(Side side, const LegRates& rates, IntervalMotion* motion) const;
  void BoundBody(size_t body, const BaseRates& waist, const std::array<LegRates, 2>& legs,
                 IntervalMotion* motion) const;

  const RobotModel& robot_;
  std::array<LegAnchors, 2> anchors_;
  std::vector<std::array<double, 6>> levers_;  // LegAnchors::Levers of a leg's body
  RoundingOfPostures rounding_;
};

}  // namespace halfstep
