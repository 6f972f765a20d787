#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "smoothing/walk/homotopy_parameters.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/half_step_sequence.h"
#include "wpg/robot_model.h"

namespace halfstep {

/// Under AddressSanitizer, where tests do less.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// `count`, or a tenth of it (at least 1) when sanitized.
constexpr int Draws(int count) { return kSanitized ? std::max(1, count / 10) : count; }

inline RobotModel Hrp2() { return LoadRobot(HALFSTEP_SOURCE_DIR "/wpg/robots/hrp2.yaml"); }

/// Soles side by side, 0.21 m apart.
inline std::array<Pose2, 2> StandingFeet() { return {Pose2{0, 0.105, 0}, Pose2{0, -0.105, 0}}; }

/// Random walks, reproducible from the seed.
class WalkDraw {
 public:
  explicit WalkDraw(unsigned seed) : random_(seed) {}

  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  Pose2 Pose(double reach, double yaw) {
    const double x = Uniform(-reach, reach), y = Uniform(-reach, reach);
    return {x, y, Uniform(-yaw, yaw)};
  }

  /// Footsteps in turn, about where HRP-2 can put its feet; durations and heights differ.
  std::vector<Footstep> Footsteps(int count) {
    std::array<Pose2, 2> feet = StandingFeet();
    Side side = Uniform(0, 1) < 0.5 ? Side::kLeft : Side::kRight;
    std::vector<Footstep> footsteps;
    for (int i = 0; i < count; ++i, side = Opposite(side)) {
      const double x = Uniform(-0.15, 0.25), y = Sign(side) * Uniform(0.17, 0.28);
      const Pose2 X_SF{x, y, Uniform(-0.3, 0.3)};
      Pose2& foot = feet[static_cast<size_t>(Index(side))];
      foot = feet[static_cast<size_t>(Index(Opposite(side)))] * X_SF;
      const double height = Uniform(0.05, 0.25);
      footsteps.push_back(
          {.side = side, .X_WF = foot, .via_height = height, .duration = Uniform(1.0, 3.0)});
    }
    return footsteps;
  }

  /// Lets the shape, the LIPM and the place of the start vary too.
  HalfStepSequence Sequence(int steps) {
    const HalfStepShape shape{.shift = Uniform(0.03, 0.4), .horizontal_delay = Uniform(0.0, 0.2)};
    const Lipm lipm{.com_height = Uniform(0.6, 1.0)};
    return Moved(Pose(2.0, 3.0), MakeSequence(StandingFeet(), Footsteps(steps), 0.24, shape, lipm));
  }

  /// Durations within 20 % of the planned ones, heights from a tenth to all, and overlaps between
  /// `low` and `high` of their natural bounds.
  HomotopyParameters Parameters(const HalfStepSequence& sequence, double low, double high) {
    HomotopyParameters parameters = PlannedMotion(sequence);
    for (double& T : parameters.durations) T *= Uniform(0.8, 1.2);
    for (double& eta : parameters.height_scales) eta = Uniform(0.1, 1.0);
    for (int i = 0; i < sequence.num_junctions(); ++i) {
      const double bound = NaturalOverlapBound(sequence, parameters.durations, i);
      parameters.overlaps[static_cast<size_t>(i)] = Uniform(low, high) * bound;
    }
    return parameters;
  }

  /// Every overlap at a random one of: zero, a random value, the natural bound.
  HomotopyParameters ExtremeParameters(const HalfStepSequence& sequence) {
    HomotopyParameters parameters = Parameters(sequence, 0.0, 1.0);
    for (int i = 0; i < sequence.num_junctions(); ++i) {
      const double bound = NaturalOverlapBound(sequence, parameters.durations, i);
      const double choice = Uniform(0, 3);
      if (choice < 1) parameters.overlaps[static_cast<size_t>(i)] = 0.0;
      if (choice > 2) parameters.overlaps[static_cast<size_t>(i)] = bound;
    }
    return parameters;
  }

 private:
  std::mt19937 random_;
};

/// Every overlap at a fraction of its natural bound, the rest as planned.
inline HomotopyParameters Overlapped(const HalfStepSequence& sequence, double fraction) {
  HomotopyParameters parameters = PlannedMotion(sequence);
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    parameters.overlaps[static_cast<size_t>(i)] =
        fraction * NaturalOverlapBound(sequence, parameters.durations, i);
  }
  return parameters;
}

/// Absolute times where some profile of the walk is not smooth: its third derivative jumps [s].
inline std::vector<double> Knots(const SuperposedWalk& walk) {
  std::vector<double> knots;
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const HalfStepProfiles& p = walk.profiles(i);
    for (double tau :
         {0.0, p.horizontal_begin(), p.horizontal_end(), p.t1(), p.t2(), p.duration()}) {
      knots.push_back(walk.start_of(i) + tau);
    }
  }
  return knots;
}

/// Whether a knot is nearer than `distance` [s].
inline bool NearKnot(const SuperposedWalk& walk, double t, double distance) {
  const std::vector<double> knots = Knots(walk);
  return std::any_of(knots.begin(), knots.end(),
                     [&](double knot) { return std::abs(knot - t) < distance; });
}

/// Value, first and second derivative one below the other (39×1).
inline Eigen::VectorXd Stacked(const WalkJet& jet) {
  Eigen::VectorXd all(3 * kNumQuantities);
  all << jet.value, jet.first, jet.second;
  return all;
}

}  // namespace halfstep
