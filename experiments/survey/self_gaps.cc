#include "experiments/survey/self_gaps.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {

HalfStepSequence SixSteps(const RobotModel& robot, const HalfStep& prototype) {
  const double stride = 0.3 * MeasuresOf(robot).leg_length, y = 0.5 * robot.standing_width;
  std::vector<Footstep> footsteps;
  for (int i = 0; i < 6; ++i) {
    const Side side = i % 2 == 0 ? Side::kRight : Side::kLeft;
    footsteps.push_back({.side = side,
                         .X_WF = Pose2{stride * std::min(i + 1, 5), Sign(side) * y, 0.0},
                         .via_height = prototype.via_height,
                         .duration = prototype.duration});
  }
  return MakeSequence({Pose2{0, y, 0}, Pose2{0, -y, 0}}, footsteps, prototype.via_lateral,
                      prototype.shape, Lipm{.com_height = robot.com_height});
}

std::vector<Posture> SampledPostures(const RobotModel& robot, const HalfStepSequence& sequence) {
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  std::vector<Posture> postures;
  constexpr int kInHalfStep = 16;
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    for (int k = 0; k < kInHalfStep; ++k) {
      const double tau = walk.half_step(i).duration * k / kInHalfStep;
      const Posture posture = SolvePosture(robot, walk.At({i, tau}).value);
      if (posture.reachable) postures.push_back(posture);
    }
  }
  return postures;
}

SelfGaps::SelfGaps(const RobotModel& robot, std::vector<Posture> postures)
    : robot_(robot), postures_(std::move(postures)) {
  for (const RobotBody& body : robot.bodies) shapes_.emplace_back(body.shape);
}

double SelfGaps::Distance(int a, const Eigen::Isometry3d& X_Wa, int b,
                          const Eigen::Isometry3d& X_Wb, double enough) const {
  const CollisionShape &first = shapes_[static_cast<size_t>(a)],
                       &second = shapes_[static_cast<size_t>(b)];
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
        return postures_[i].OfBody(robot_.bodies[static_cast<size_t>(body)]);
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
