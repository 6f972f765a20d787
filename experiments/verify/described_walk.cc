#include "experiments/verify/described_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/foot_forces.h"
#include "experiments/verify/tolerances.h"
#include "wpg/check.h"
#include "wpg/motion/moved_footsteps.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep::verify {

DescribedWalk::DescribedWalk(const RobotModel& robot, const HalfStepSequence& planned,
                             const std::vector<HalfStepRow>& rows)
    : robot_(robot), lipm_(robot.com_height) {
  HALFSTEP_CHECK(!rows.empty() && rows.size() == planned.half_steps.size(),
                 rows.size() << " rows, " << planned.half_steps.size() << " half-steps");
  std::vector<Pose2> moves;
  for (size_t i = 0; i < rows.size(); i += 2) {
    moves.push_back(rows[i].FormOf(planned.half_steps[i].half_step).footstep);
  }
  const std::vector<PlacedHalfStep> placed = WithFootstepsMoved(planned, moves).half_steps;
  for (size_t i = 0; i < rows.size(); ++i) {
    const auto& [as_planned, X_WS] = placed[i];
    HalfStep half_step = as_planned;
    half_step.duration = rows[i].duration;
    half_step.via_height *= rows[i].height_scale;
    half_step.shape.support_point = rows[i].support_point;
    const FormColumns form = rows[i].FormOf(as_planned);
    for (const FormColumn& one : AllFormColumns()) one.in(&half_step) = form.*one.value;
    pieces_.push_back(
        {.half_step = half_step, .tracks = {half_step, lipm_, X_WS}, .start = rows[i].start});
  }
}

DescribedWalk DescribedWalk::StopBranch(int last) const {
  DescribedWalk branch = *this;
  branch.pieces_.erase(branch.pieces_.begin() + last + 1, branch.pieces_.end());
  return branch;
}

std::pair<double, double> DescribedWalk::WindowOf(int half_step) const {
  const Piece& piece = Nth(pieces_, half_step);
  return {piece.start, piece.start + piece.tracks.duration()};
}

WalkJet DescribedWalk::At(double t) const {
  WalkJet jet;
  jet.value = pieces_.front().tracks.start();
  for (size_t i = 0; i < pieces_.size(); ++i) {
    if (Local(t, i) > 0) pieces_[i].tracks.AddMotion(Local(t, i), &jet);
  }
  return jet;
}

bool DescribedWalk::HasLanded(double t, size_t up) const {
  const size_t down = up + 1;
  return down < pieces_.size() && Local(t, down) > pieces_[down].tracks.t1();
}

int DescribedWalk::StepInAir(double t) const {
  for (size_t up = 0; up < pieces_.size(); up += 2) {
    if (Local(t, up) >= pieces_[up].tracks.t2() && !HasLanded(t, up)) {
      return static_cast<int>(up / 2);
    }
  }
  return -1;
}

Support DescribedWalk::SupportAt(double t) const {
  const int step = StepInAir(t);
  if (step < 0) return Support::kBoth;
  return static_cast<Support>(Index(Nth(pieces_, 2 * step).half_step.support));
}

int DescribedWalk::HalfStepAt(double t) const {
  size_t i = 0;
  while (i + 1 < pieces_.size() && Local(t, i + 1) >= 0) ++i;
  return static_cast<int>(i) + 1;
}

// From the beginning of the up half-step's motion, or of the down half-step if that is earlier, to
// the end of the down half-step's, or of the up half-step if that is later.
bool DescribedWalk::MovesHorizontally(double t, int side) const {
  const int step = StepInAir(t);
  if (step < 0) return false;
  const size_t up = 2 * static_cast<size_t>(step), down = up + 1;
  if (Index(pieces_[up].half_step.swing()) != side) return false;
  const HalfStepTracks& rise = pieces_[up].tracks;
  const bool begun = Local(t, up) >= rise.horizontal_begin();
  const bool rises = Local(t, up) <= rise.duration();
  if (down == pieces_.size()) return begun && rises;
  return (begun || Local(t, down) >= 0) &&
         (Local(t, down) <= pieces_[down].tracks.horizontal_end() || rises);
}

PlayedRow DescribedWalk::Row(double t) const {
  const WalkJet jet = At(t);
  const Posture posture = SolvePosture(robot_, jet.value);
  PlayedRow row;
  row.t = t;
  row.half_step = HalfStepAt(t);
  row.support = SupportAt(t);
  row.com << jet.value.segment<2>(kComX), lipm_.com_height();
  row.com_velocity = jet.first.segment<2>(kComX);
  row.com_acceleration = jet.second.segment<2>(kComX);
  row.zmp = jet.value.segment<2>(kZmpX);
  row.waist << posture.X_WB.translation(), jet.value[kWaistYaw];
  row.soles = {jet.value.segment<4>(kLeftX), jet.value.segment<4>(kRightX)};
  for (size_t s = 0; s < 2; ++s) {
    row.q[s] = posture.ik[s].q;
    if (posture.ik[s].status != LegIkStatus::kSolved) row.q[s].setConstant(std::nan(""));
  }
  return row;
}

std::array<Vector6d, 2> DescribedWalk::JointSpeeds(double t) const {
  const double half = Tolerances(robot_).speed_step;
  const double from = std::max(t - half, 0.0), to = std::min(t + half, end());
  const Posture a = SolvePosture(robot_, At(from).value), b = SolvePosture(robot_, At(to).value);
  std::array<Vector6d, 2> speeds;
  for (size_t s = 0; s < 2; ++s) speeds[s] = (b.ik[s].q - a.ik[s].q) / (to - from);
  return speeds;
}

WalkDynamics DescribedWalk::DynamicsAt(double t) const {
  WalkDynamics dynamics;
  const auto momentum = RobotMomentum::Of(robot_, At(t), kGravity);
  if (!momentum) return dynamics;
  PlayedRow row = Row(t);
  row.zmp = momentum->Zmp();
  dynamics.zmp = ZmpMargin(row, robot_);
  dynamics.torques = JointTorques(robot_, row, *momentum);
  dynamics.friction = FrictionNeeded(robot_, row, *momentum);
  return dynamics;
}

double WalkDynamics::TorqueMargin(const RobotModel& robot, size_t side, size_t joint) const {
  const double torque = std::abs(torques[side][static_cast<Eigen::Index>(joint)]);
  if (!std::isfinite(torque)) return -std::numeric_limits<double>::infinity();
  return robot.legs[side].joints[joint].max_torque - torque;
}

double WalkDynamics::LeastTorqueMargin(const RobotModel& robot) const {
  double least = std::numeric_limits<double>::infinity();
  for (size_t s = 0; s < 2; ++s) {
    for (size_t j = 0; j < 6; ++j) least = std::min(least, TorqueMargin(robot, s, j));
  }
  return least;
}

double DescribedWalk::ComFourthBound(double begin, double end) const {
  WalkState second = WalkState::Zero();
  for (size_t i = 0; i < pieces_.size(); ++i) {
    pieces_[i].tracks.AddSecondBounds(Local(begin, i), Local(end, i), &second);
  }
  return lipm_.omega() * lipm_.omega() *
         (second.segment<2>(kComX) + second.segment<2>(kZmpX)).norm();
}

}  // namespace halfstep::verify
