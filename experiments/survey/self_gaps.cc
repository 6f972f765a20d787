#include "experiments/survey/self_gaps.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "smoothing/walk/superposed_walk.h"
#include "wpg/motion/lipm.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {

namespace {

HalfStepSequence SixStepsOf(const RobotModel& robot, const HalfStep& prototype, double stride) {
  const double y = 0.5 * robot.standing_width;
  std::vector<Footstep> footsteps;
  for (int i = 0; i < 6; ++i) {
    const Side side = i % 2 == 0 ? Side::kRight : Side::kLeft;
    footsteps.push_back(
        {.side = side,
         .X_WF = Foothold::Level({stride * std::min(i + 1, 5), Sign(side) * y, 0.0}),
         .via_height = prototype.via_height,
         .duration = prototype.duration});
  }
  return MakeSequence({Foothold::Level({0, y, 0}), Foothold::Level({0, -y, 0})}, footsteps,
                      prototype.via_lateral, prototype.shape,
                      std::make_shared<Lipm>(robot.com_height));
}

// Postures of the planned motion at equal steps of each half-step; some may not be reachable.
std::vector<Posture> PlannedPostures(const RobotModel& robot, const HalfStepSequence& sequence) {
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  std::vector<Posture> postures;
  constexpr int kInHalfStep = 16;
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    for (int k = 0; k < kInHalfStep; ++k) {
      const double tau = walk.half_step(i).duration * k / kInHalfStep;
      postures.push_back(SolvePosture(robot, walk.At({i, tau}).value));
    }
  }
  return postures;
}

bool IsWithinLimits(const RobotModel& robot, const Posture& posture) {
  constexpr double kWithin = 0.01;  // [rad]
  if (!posture.reachable) return false;
  for (size_t leg = 0; leg < 2; ++leg) {
    if (posture.ik[leg].reach_margin < 1e-3 * std::max(robot.waist_height, 0.5 * robot.com_height))
      return false;
    for (size_t i = 0; i < 6; ++i) {
      const LegJoint& joint = robot.legs[leg].joints[i];
      const double q = posture.ik[leg].q[static_cast<Eigen::Index>(i)];
      if (q < joint.lower + kWithin || q > joint.upper - kWithin) return false;
    }
  }
  return true;
}

}  // namespace

HalfStepSequence SixSteps(const RobotModel& robot, const HalfStep& prototype) {
  const double leg = MeasuresOf(robot).leg_length;
  for (int parts = 12;; --parts) {
    HalfStepSequence sequence = SixStepsOf(robot, prototype, 0.025 * parts * leg);
    if (parts == 1 || IsWithinReach(robot, sequence)) return sequence;
  }
}

bool IsWithinReach(const RobotModel& robot, const HalfStepSequence& sequence) {
  return std::ranges::all_of(PlannedPostures(robot, sequence), [&robot](const Posture& posture) {
    return IsWithinLimits(robot, posture);
  });
}

std::vector<Posture> SampledPostures(const RobotModel& robot, const HalfStepSequence& sequence) {
  std::vector<Posture> postures = PlannedPostures(robot, sequence);
  std::erase_if(postures, [](const Posture& posture) { return !posture.reachable; });
  return postures;
}

SelfGaps::SelfGaps(const RobotModel& robot, std::vector<Posture> postures)
    : robot_(robot), postures_(std::move(postures)) {
  for (const RobotBody& body : robot.bodies) shapes_.emplace_back(body.shape);
}

double SelfGaps::Distance(int a, const Eigen::Isometry3d& X_Wa, int b,
                          const Eigen::Isometry3d& X_Wb, double enough) const {
  const CollisionShape &first = Nth(shapes_, a), &second = Nth(shapes_, b);
  const double apart =
      (X_Wa * first.center() - X_Wb * second.center()).norm() - first.radius() - second.radius();
  return apart > enough ? enough : Separate(first, X_Wa, second, X_Wb).distance;
}

std::vector<SelfGap> SelfGaps::Nearer(double enough) const {
  std::vector<SelfGap> gaps;
  for (const auto& [a, b] : robot_.self_pairs) {
    SelfGap gap{a, b, enough, enough};
    for (size_t i = 0; i < postures_.size(); ++i) {
      const auto X = [&](int body) -> const Eigen::Isometry3d& {
        return postures_[i].OfBody(Nth(robot_.bodies, body));
      };
      const double distance = Distance(a, X(a), b, X(b), enough);
      if (i == 0) gap.standing = distance;
      gap.least = std::min(gap.least, distance);
    }
    if (gap.least < enough) gaps.push_back(gap);
  }
  return gaps;
}

double SelfGaps::FromLegs(const std::vector<int>& moved, const std::vector<Eigen::Isometry3d>& X_B,
                          double enough) const {
  double least = enough;
  for (const Posture& posture : postures_) {
    for (size_t k = 0; k < moved.size(); ++k) {
      const Eigen::Isometry3d X_Wa = posture.X_WB * X_B[k];
      for (size_t b = 0; b < robot_.bodies.size(); ++b) {
        const RobotBody& body = robot_.bodies[b];
        if (body.leg < 0) continue;
        least = std::min(
            least, Distance(moved[k], X_Wa, static_cast<int>(b), posture.OfBody(body), least));
      }
    }
  }
  return least;
}

}  // namespace halfstep
