#include "experiments/replay/tube_gauge.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "experiments/replay/ranks.h"
#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

double Distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

double Turn(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return AngleOf(a.linear() * b.linear().transpose());
}

// Between both soles, seen from above.
Pose2 Middle(const Pose2& left, const Pose2& right) {
  return {0.5 * (left.x + right.x), 0.5 * (left.y + right.y),
          left.yaw + 0.5 * std::remainder(right.yaw - left.yaw, 2 * std::numbers::pi)};
}

}  // namespace

TubeGauge::TubeGauge(const RobotModel& robot, const ReferenceMotion& motion) : motion_(motion) {
  if (robot.masses.known()) whole_.emplace(robot, motion);
}

void TubeGauge::BeginAt(const Simulation& robot) {
  const auto planned = [&row = motion_.rows().front()](Side side) {
    const Eigen::Vector4d& sole = Nth(row.soles, Index(side));
    return Pose2{sole[0], sole[1], sole[3]};
  };
  X_WP_ = Middle(OnFloor(robot.X_WSole(Side::kLeft)), OnFloor(robot.X_WSole(Side::kRight))) *
          Middle(planned(Side::kLeft), planned(Side::kRight)).Inverse();
}

TubeSample TubeGauge::Of(const Simulation& robot, const ReplayRow& row, double period) const {
  const TrajectoryRow planned = motion_.RowAt(row.t);
  const JointTargets wanted = motion_.TargetsAt(row.t);
  const control::MeasuredState now = robot.Measure();
  const Eigen::Isometry3d X_WP = ToIsometry(X_WP_, 0.0);
  const Eigen::Isometry3d X_WB = robot.X_WB(), waist = X_WP * planned.X_WB();
  TubeSample sample;
  Tube& tube = sample.tube;
  tube.waist = Distance(X_WB, waist);
  tube.waist_turn = Turn(X_WB, waist);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Isometry3d X = robot.X_WSole(side);
    const Eigen::Isometry3d place = X_WP * TrajectoryRow::Upright(Nth(planned.soles, Index(side)));
    tube.foot = std::max(tube.foot, Distance(X, place));
    tube.foot_turn = std::max(tube.foot_turn, Turn(X, place));
    const auto off = [s = Index(side)](const auto& a, const auto& b) {
      return (Nth(a, s) - Nth(b, s)).cwiseAbs().maxCoeff();
    };
    tube.joint = std::max(tube.joint, off(now.q, wanted.q));
    tube.joint_speed = std::max(tube.joint_speed, off(now.speeds, wanted.speed));
  }
  if (!whole_) return sample;
  const control::PlannedState middle = whole_->At(row.t - period / 2);
  bool as_planned = true;
  for (size_t s = 0; s < 2; ++s) {
    as_planned = as_planned && middle.stands[s] == (row.vertical[s] > 0.0);
  }
  const double zmp = (row.zmp_measured - X_WP_ * middle.zmp).norm();  // nan in flight
  if (as_planned) tube.zmp = zmp;
  if (!as_planned) sample.zmp_beside = std::isnan(zmp) ? 0.0 : zmp;
  return sample;
}

MeasuredTube::MeasuredTube(const std::vector<TubeSample>& samples) {
  if (samples.empty()) return;
  long others = 0;
  for (const TubeSample& sample : samples) {
    if (!sample.zmp_beside) continue;
    ++others;
    zmp_beside = std::max(zmp_beside, *sample.zmp_beside);
  }
  beside = static_cast<double>(others) / static_cast<double>(samples.size());
  for (double Tube::*const part : kTubeParts) {
    std::vector<double> values;
    for (const TubeSample& sample : samples) {
      if (part != &Tube::zmp || !sample.zmp_beside) values.push_back(sample.tube.*part);
    }
    std::tie(most.*part, largest.*part) = MostAndLargest(std::move(values));
  }
}

}  // namespace halfstep::replay
