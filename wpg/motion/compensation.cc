#include "wpg/motion/compensation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "wpg/check.h"
#include "wpg/motion/posture.h"
#include "wpg/motion/robot_dynamics.h"

namespace halfstep {
namespace {

constexpr int kInstants = 10 * WaistSway::kPieces;  // intervals between instants looked at
constexpr double kLeastTheta = 0.5;                 // ω·T (HalfStepProfiles)
constexpr int kHalvings = 5;
constexpr std::array<double, 3> kFractions = {1.0, 0.7071067811865476, 0.5};  // of the duration

// A half-step of some duration, looked at from its start to its end.
class Isolated {
 public:
  Isolated(const RobotModel& robot, const HalfStep& half_step, const Lipm& lipm, double duration)
      : robot_(robot), lipm_(lipm), half_step_(half_step) {
    half_step_.duration = duration;
  }

  void Sway(const WaistSway& sway) { half_step_.sway = sway; }

  /// Where the robot's ZMP is, less the planned one, at each instant (rows); none when a leg does
  /// not reach or the floor does not push.
  std::optional<Eigen::MatrixX2d> ZmpErrors() const {
    Eigen::MatrixX2d errors(kInstants + 1, 2);
    for (int i = 0; i <= kInstants; ++i) {
      const WalkJet jet = At(i);
      Posture posture = SolvePosture(robot_, jet.value);
      if (!posture.reachable || !SolveJointSpeeds(robot_, jet, &posture)) return std::nullopt;
      const auto zmp = RobotDynamics(robot_, jet, posture, lipm_.gravity).Zmp();
      if (!zmp) return std::nullopt;
      errors.row(i) = (*zmp - jet.value.segment<2>(kZmpX)).transpose();
    }
    return errors;
  }

  /// What either leg has left to stretch at least [m].
  double LeastReach() const {
    double least = INFINITY;
    for (int i = 0; i <= kInstants; ++i) {
      const Posture posture = SolvePosture(robot_, At(i).value);
      for (const LegIkSolution& leg : posture.ik) least = std::min(least, leg.reach_margin);
    }
    return least;
  }

  /// Z of each B-spline (columns) at each instant (rows).
  Eigen::MatrixXd ZmpOfSplines() const {
    Eigen::MatrixXd Z(kInstants + 1, WaistSway::kControls);
    const double rate = WaistSway::kPieces / half_step_.duration;
    for (int i = 0; i <= kInstants; ++i) {
      for (int k = 0; k < WaistSway::kControls; ++k) {
        const double sigma = static_cast<double>(i) / kInstants;
        const Eigen::Vector3d B = CubicBSpline(WaistSway::kPieces * sigma - k);
        Z(i, k) = lipm_.Zmp(B[0], rate * rate * B[2]);
      }
    }
    return Z;
  }

 private:
  WalkJet At(int instant) const {
    return Evaluate(half_step_, profiles_, half_step_.duration * instant / kInstants);
  }

  const RobotModel& robot_;
  const Lipm& lipm_;
  HalfStep half_step_;
  HalfStepProfiles profiles_{half_step_.kind, half_step_.shape, half_step_.duration, lipm_};
};

}  // namespace

WaistSway Compensation(const RobotModel& robot, const HalfStep& half_step, const Lipm& lipm,
                       int iterations) {
  HALFSTEP_CHECK(iterations >= 0, iterations << " iterations");
  HALFSTEP_CHECK(iterations == 0 || robot.masses.known(), robot.masses.fault);
  if (iterations == 0) return {};
  std::vector<Isolated> all;
  for (const double fraction : kFractions) {
    all.emplace_back(robot, half_step, lipm,
                     std::max(fraction * half_step.duration, kLeastTheta / lipm.omega()));
  }
  const auto least_reach = [&](const WaistSway& sway) {
    double least = INFINITY;
    for (Isolated& one : all) {
      one.Sway(sway);
      least = std::min(least, one.LeastReach());
    }
    return least;
  };
  const double reach = least_reach({});
  WaistSway sway{std::vector<Eigen::Vector2d>(WaistSway::kControls, Eigen::Vector2d::Zero())};
  for (int i = 0; i < iterations; ++i) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(WaistSway::kControls, WaistSway::kControls);
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(WaistSway::kControls, 2);
    for (Isolated& one : all) {
      one.Sway(sway);
      const auto errors = one.ZmpErrors();
      if (!errors) return {};
      const Eigen::MatrixXd Z = one.ZmpOfSplines();
      normal += Z.transpose() * Z;
      right -= Z.transpose() * *errors;
    }
    const Eigen::MatrixX2d change = normal.ldlt().solve(right);
    for (int k = 0; k < WaistSway::kControls; ++k) {
      sway.controls[static_cast<size_t>(k)] += change.row(k).transpose();
    }
  }
  for (int halvings = 0; halvings <= kHalvings; ++halvings) {
    if (least_reach(sway) >= 0.5 * reach) return sway;
    sway = sway.Scaled(0.5);
  }
  return {};
}

HalfStepSequence Compensated(const RobotModel& robot, const HalfStepSequence& sequence,
                             int iterations) {
  HalfStepSequence compensated = sequence;
  for (auto& [half_step, X_WS] : compensated.half_steps) {
    half_step.sway = {};
    half_step.sway = Compensation(robot, half_step, sequence.lipm, iterations);
  }
  return compensated;
}

}  // namespace halfstep
