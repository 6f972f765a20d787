#include "experiments/verify/described_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/foot_forces.h"
#include "experiments/verify/robot_momentum.h"
#include "experiments/verify/robot_numbers.h"
#include "experiments/verify/tolerances.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep::verify {

DescribedWalk::DescribedWalk(const RobotModel& robot, const WalkPlan& planned,
                             const std::vector<HalfStepRow>& rows,
                             const std::optional<double>& floor)
    : robot_(robot),
      floor_(floor ? WalkFloor(*floor) : WalkFloor(planned)),
      crouch_(StartCrouch(planned)),
      pieces_(std::make_shared<const std::vector<Piece>>(PiecesOf(robot, planned, rows))),
      size_(pieces_->size()) {
  Guide(0.0);
}

std::vector<DescribedWalk::Piece> DescribedWalk::PiecesOf(const RobotModel& robot,
                                                          const WalkPlan& planned,
                                                          const std::vector<HalfStepRow>& rows) {
  HALFSTEP_CHECK(!rows.empty() && rows.size() == planned.half_steps.size(),
                 rows.size() << " rows, " << planned.half_steps.size() << " half-steps");
  std::vector<Pose2> moves;
  for (size_t i = 0; i < rows.size(); i += 2) {
    moves.push_back(rows[i].FormOf(planned.half_steps[i].half_step).footstep);
  }
  WalkPlan plan = Moved(planned, moves);
  const double crouch = StartCrouch(planned);
  std::vector<Piece> pieces;
  std::array<double, 2> heights = {planned.start[0].height, planned.start[1].height};
  for (size_t i = 0; i < rows.size(); ++i) {
    HalfStep& half_step = plan.half_steps[i].half_step;
    half_step.duration = rows[i].duration;
    half_step.via_height *= rows[i].height_scale;
    half_step.support_point = rows[i].support_point;
    half_step.form = rows[i].FormOf(half_step);
    Piece piece{.motion = {plan.half_steps[i], PendulumRate(robot, crouch)},
                .start = rows[i].start,
                .heights = heights};
    piece.begin = piece.motion.start();
    piece.ended = piece.end();
    if (i > 0) {
      WalkInstant before{.value = pieces.back().begin};
      pieces.back().motion.AddAt(pieces.back().motion.duration(), &before);
      piece.begin = before.value;
      piece.ended = std::max(pieces.back().ended, piece.end());
    }
    const HalfStep& is = piece.motion.half_step();
    if (!is.up) Nth(heights, Index(is.swing())) = piece.motion.FootstepHeight();
    pieces.push_back(std::move(piece));
  }
  double begins = std::numeric_limits<double>::infinity();
  for (size_t i = pieces.size(); i-- > 0;) {
    pieces[i].begins = begins = std::min(begins, pieces[i].start);
  }
  return pieces;
}

size_t DescribedWalk::FirstActive(double t) const {
  const auto end = pieces_->begin() + static_cast<std::ptrdiff_t>(size_ - 1);
  const auto first = std::partition_point(pieces_->begin(), end,
                                          [t](const Piece& piece) { return piece.ended <= t; });
  return static_cast<size_t>(first - pieces_->begin());
}

DescribedWalk DescribedWalk::StopBranch(int last) const {
  DescribedWalk branch = *this;
  branch.size_ = static_cast<size_t>(last) + 1;
  // Until the first half-step that is left out it is the same walk.
  if (last + 1 < num_half_steps()) branch.Guide(WindowOf(last + 1).first);
  return branch;
}

void DescribedWalk::Guide(double from) {
  guide_.Extend(robot_, from, end(), [this](double t) { return At(t).value; });
}

RobotPosture DescribedWalk::PostureAt(double t) const {
  const std::array<Vector6d, 2> near = NearAngles(t);
  return PostureOf(robot_, At(t).value, &near);
}

std::pair<double, double> DescribedWalk::WindowOf(int half_step) const {
  const Piece& of = piece(half_step);
  return {of.start, of.end()};
}

std::pair<double, double> DescribedWalk::ShiftOf(int half_step) const {
  const Piece& of = piece(half_step);
  return {of.start + of.motion.t1(), of.start + of.motion.t2()};
}

WalkInstant DescribedWalk::At(double t) const {
  WalkInstant at;
  size_t i = FirstActive(t);
  at.value = (*pieces_)[i].begin;
  for (; i < size_ && (*pieces_)[i].begins < t; ++i) (*pieces_)[i].motion.AddAt(Local(t, i), &at);
  return at;
}

bool DescribedWalk::HasLanded(double t, size_t up) const {
  const size_t down = up + 1;
  return down < size_ && Local(t, down) > (*pieces_)[down].motion.t1();
}

int DescribedWalk::StepInAir(double t) const {
  for (size_t up = FirstActive(t) / 2 * 2; up < size_ && (*pieces_)[up].begins <= t; up += 2) {
    if (Local(t, up) >= (*pieces_)[up].motion.t2() && !HasLanded(t, up)) {
      return static_cast<int>(up / 2);
    }
  }
  return -1;
}

Support DescribedWalk::SupportAt(double t) const {
  const int step = StepInAir(t);
  if (step < 0) return Support::kBoth;
  return static_cast<Support>(Index(piece(2 * step).motion.half_step().support));
}

int DescribedWalk::HalfStepAt(double t) const {
  size_t i = FirstActive(t);
  if (i > 0) --i;
  while (i + 1 < size_ && Local(t, i + 1) >= 0) ++i;
  return static_cast<int>(i) + 1;
}

// From the beginning of the up half-step's motion, or of the down half-step if that is earlier, to
// the end of the down half-step's, or of the up half-step if that is later.
bool DescribedWalk::MovesHorizontally(double t, int side) const {
  const int step = StepInAir(t);
  if (step < 0) return false;
  const size_t up = 2 * static_cast<size_t>(step), down = up + 1;
  if (Index((*pieces_)[up].motion.half_step().swing()) != side) return false;
  const HalfStepMotion& rise = (*pieces_)[up].motion;
  const bool begun = Local(t, up) >= rise.foot_begin();
  const bool rises = Local(t, up) <= rise.duration();
  if (down == size_) return begun && rises;
  return (begun || Local(t, down) >= 0) &&
         (Local(t, down) <= (*pieces_)[down].motion.foot_end() || rises);
}

double DescribedWalk::FootholdHeight(double t, int side) const {
  size_t up = FirstActive(t) / 2 * 2;
  double height = Nth((*pieces_)[up].heights, side);
  for (; up < size_ && HasLanded(t, up); up += 2) {
    const HalfStepMotion& motion = (*pieces_)[up + 1].motion;
    if (Index(motion.half_step().swing()) == side) height = motion.FootstepHeight();
  }
  return height;
}

double DescribedWalk::LandingHeight(double t, int side) const {
  const int step = StepInAir(t);
  if (step < 0) return FootholdHeight(t, side);
  const size_t up = 2 * static_cast<size_t>(step), last = std::min(up + 1, size_ - 1);
  const HalfStepMotion& motion = (*pieces_)[last].motion;
  return Index(motion.half_step().swing()) == side ? motion.FootstepHeight()
                                                   : FootholdHeight(t, side);
}

PlayedRow DescribedWalk::Row(double t) const {
  const WalkInstant at = At(t);
  const std::array<Vector6d, 2> near = NearAngles(t);
  const RobotPosture posture = PostureOf(robot_, at.value, &near);
  PlayedRow row;
  row.t = t;
  row.half_step = HalfStepAt(t);
  row.support = SupportAt(t);
  row.com << at.value.segment<2>(kComX), robot_.com_height + at.value[kWaistZ];
  row.com_velocity = at.first.segment<2>(kComX);
  row.com_acceleration = at.second.segment<2>(kComX);
  row.zmp = at.value.segment<2>(kZmpX);
  row.waist << posture.X_WB.translation(), at.value[kWaistYaw];
  row.soles = {at.value.segment<4>(kLeftX), at.value.segment<4>(kRightX)};
  row.q = posture.q;
  return row;
}

std::array<Vector6d, 2> DescribedWalk::JointSpeeds(double t) const {
  const double half = Tolerances(robot_).speed_step;
  const double from = std::max(t - half, 0.0), to = std::min(t + half, end());
  const RobotPosture a = PostureAt(from), b = PostureAt(to);
  std::array<Vector6d, 2> speeds;
  for (size_t s = 0; s < 2; ++s) speeds[s] = (b.q[s] - a.q[s]) / (to - from);
  return speeds;
}

WalkDynamics DescribedWalk::DynamicsAt(double t) const {
  WalkDynamics dynamics;
  const auto momentum = RobotMomentum::Of(robot_, At(t), NearAngles(t));
  if (!momentum) return dynamics;
  const PlayedRow row = Row(t);
  dynamics.zmp = RobotZmpMargin(robot_, row, *momentum);
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
  Eigen::Vector2d seconds{0, 0};
  for (size_t i = FirstActive(begin); i < size_ && (*pieces_)[i].begins <= end; ++i) {
    seconds += (*pieces_)[i].motion.SecondBounds(Local(begin, i), Local(end, i));
  }
  return std::pow(PendulumRate(robot_, crouch_), 2) * seconds.norm();
}

}  // namespace halfstep::verify
