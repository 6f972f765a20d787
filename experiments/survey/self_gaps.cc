#include "experiments/survey/self_gaps.h"

#include <algorithm>
#include <cmath>
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

// How far a posture is within reach [of the leg's length] and limits [rad] of the legs, less what
// is kept of both; −∞: a leg does not reach.
double SlackOf(const RobotModel& robot, const Posture& posture) {
  constexpr double kWithin = 0.01;  // [rad]
  if (!posture.reachable) return -std::numeric_limits<double>::infinity();
  const double length = std::max(robot.waist_height, 0.5 * robot.com_height);
  double slack = std::numeric_limits<double>::infinity();
  for (size_t leg = 0; leg < 2; ++leg) {
    slack = std::min(slack, posture.ik[leg].reach_margin / length - 1e-3);
    for (size_t i = 0; i < 6; ++i) {
      const LegJoint& joint = robot.legs[leg].joints[i];
      const double q = posture.ik[leg].q[static_cast<Eigen::Index>(i)];
      slack = std::min({slack, q - joint.lower - kWithin, joint.upper - kWithin - q});
    }
  }
  return slack;
}

// The least of the planned motion, sampled.
double SlackOf(const RobotModel& robot, const HalfStepSequence& sequence) {
  double slack = std::numeric_limits<double>::infinity();
  for (const Posture& posture : PlannedPostures(robot, sequence)) {
    slack = std::min(slack, SlackOf(robot, posture));
  }
  return slack;
}

}  // namespace

HalfStepSequence SixSteps(const RobotModel& robot, const HalfStep& prototype) {
  constexpr int kMost = 12;
  constexpr double kSame = 1e-6;
  const double leg = MeasuresOf(robot).leg_length;
  const auto steps = [&](int parts) { return SixStepsOf(robot, prototype, 0.025 * parts * leg); };
  const auto longest = [&](double enough) {
    int parts = kMost;
    while (parts > 1 && !(SlackOf(robot, steps(parts)) >= enough)) --parts;
    return parts;
  };
  const int parts = longest(0.0);
  if (parts > 1) return steps(parts);
  const double least = SlackOf(robot, steps(1));
  if (least >= 0.0 || std::isinf(least)) return steps(1);
  return steps(longest(least - kSame));  // the steps' length is not to blame
}

bool IsWithinReach(const RobotModel& robot, const HalfStepSequence& sequence) {
  return SlackOf(robot, sequence) >= 0.0;
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
