#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <vector>

#include "tests/draws.h"
#include "tests/wpg/hrp2.h"
#include "wpg/geometry/foothold.h"
#include "wpg/motion/half_step_sequence.h"
#include "wpg/motion/lipm.h"

namespace halfstep {

/// Soles side by side, 0.21 m apart.
inline std::array<Foothold, 2> StandingFeet() {
  return {Foothold::Level({0, 0.105, 0}), Foothold::Level({0, -0.105, 0})};
}

/// Random sequences of half-steps, reproducible from the seed.
class SequenceDraw {
 public:
  /// Each footstep is up to `rise` [m] higher or lower than the one before.
  explicit SequenceDraw(unsigned seed, double rise = 0.0)
      : random_(seed), forms_(seed), rise_(rise) {}

  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  Pose2 Pose(double reach, double yaw) {
    const double x = Uniform(-reach, reach), y = Uniform(-reach, reach);
    return {x, y, Uniform(-yaw, yaw)};
  }

  /// Footsteps in turn, about where HRP-2 can put its feet; durations and heights differ.
  std::vector<Footstep> Footsteps(int count) {
    std::array<Foothold, 2> feet = StandingFeet();
    Side side = Uniform(0, 1) < 0.5 ? Side::kLeft : Side::kRight;
    std::vector<Footstep> footsteps;
    for (int i = 0; i < count; ++i, side = Opposite(side)) {
      const double x = Uniform(-0.15, 0.25), y = Sign(side) * Uniform(0.17, 0.28);
      Foothold X_SF = Foothold::Level({x, y, Uniform(-0.3, 0.3)});
      if (uneven()) X_SF.height = Form(-rise_, rise_);
      Foothold& foot = feet[static_cast<size_t>(Index(side))];
      const Foothold& support = feet[static_cast<size_t>(Index(Opposite(side)))];
      const double from = foot.height - support.height;
      foot = support * X_SF;
      const double height = Uniform(0.05, 0.25) + std::max({0.0, from, X_SF.height});
      footsteps.push_back(
          {.side = side, .X_WF = foot, .via_height = height, .duration = Uniform(1.0, 3.0)});
    }
    return footsteps;
  }

  /// Lets the shape, the LIPM and the place of the start vary too.
  HalfStepSequence Sequence(int steps) {
    const double shift = Uniform(0.03, 0.4), delay = Uniform(0.0, 0.2);
    HalfStepShape shape{.shift = shift,
                        .foot_delay = delay,
                        .bump_ramp = Form(0, 1) < 0.5 ? 1.0 : Form(0.1, 1.0),
                        .foot_ramp = Form(0, 1) < 0.5 ? 0.5 : Form(0.1, 0.5),
                        .lift_share = Form(0, 1) < 0.5 ? 1.0 : Form(0.3, 1.0),
                        .support_point = Form(-0.03, 0.06)};
    if (uneven()) {
      shape.rise_begin = Form(0.0, 0.75);
      shape.rise_end = Form(0.85, 1.0);
      shape.crouch = Form(0.0, 0.1);
    }
    const auto lipm = std::make_shared<Lipm>(Uniform(0.6, 1.0));
    return Moved(Pose(2.0, 3.0), MakeSequence(StandingFeet(), Footsteps(steps), 0.24, shape, lipm));
  }

  bool uneven() const { return rise_ > 0.0; }

  /// What half-steps are like besides; drawn apart, so that a new number of theirs leaves all
  /// others as they are.
  double Form(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(forms_);
  }

 private:
  std::mt19937 random_, forms_;
  double rise_;
};

}  // namespace halfstep
