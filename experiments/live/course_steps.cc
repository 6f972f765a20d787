#include "experiments/live/course_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kStill = 1e-6;  // less is no motion [m], [rad]

// The pose after one unit of time at a velocity in the frame that moves.
Pose2 Exp(const Eigen::Vector3d& v) {
  const double turn = v[2];
  double along = 1.0, aside = 0.5 * turn;  // sin(turn)/turn, (1 − cos(turn))/turn
  if (std::abs(turn) > 1e-6) {
    const auto [sine, cosine] = SinCos(turn);
    along = sine / turn;
    aside = (1.0 - cosine) / turn;
  }
  return {along * v[0] - aside * v[1], aside * v[0] + along * v[1], turn};
}

double SignOf(Side side) { return side == Side::kLeft ? 1.0 : -1.0; }

// Where a foot stands beside the middle.
Pose2 Beside(Side side, double width) { return {0.0, 0.5 * SignOf(side) * width, 0.0}; }

// Whether the set has an element whose cell holds a placement of the swing foot.
bool HasCell(const Gait& gait, Side support, const Pose2& X_SF) {
  for (int i = 0; i < gait.set.size(); ++i) {
    const Foothold at = gait.set.Placement(i, support);
    if (std::abs(at.x - X_SF.x) <= gait.cell.x && std::abs(at.y - X_SF.y) <= gait.cell.y &&
        std::abs(at.yaw - X_SF.yaw) <= gait.cell.yaw) {
      return true;
    }
  }
  return false;
}

// The foot on the side to which the middle moves; the other one follows it.
bool Leads(Side swing, double to_the_left) { return SignOf(swing) * to_the_left > 0.0; }

class Steps {
 public:
  Steps(const Course& course, const Gait& gait, const Standing& standing)
      : course_(course), gait_(gait), feet_(standing.feet), landed_(standing.landed) {
    if (course.kind == CourseKind::kPath) line_.emplace(course.path);
  }

  CourseSteps Take(std::optional<Side> in_air, int count) {
    CourseSteps steps;
    for (int i = 0; i < count; ++i) {
      const std::optional<Next> next = i == 0 && in_air ? Of(*in_air, /*must=*/true) : NextOf();
      if (!next) break;
      steps.footsteps.push_back(next->footstep);
      steps.part = std::min(steps.part, next->part);
      landed_ = next->footstep.side;
      Nth(feet_, Index(landed_)) = next->footstep.X_WF;
    }
    const bool stands = !in_air || !steps.footsteps.empty();
    steps.complete = stands && IsOver() && !NextOf();
    return steps;
  }

 private:
  struct Next {
    Footstep footstep;
    double part = 1.0;  // of what the course asks for
  };

  // The middle beside the foot that supports while `swing` moves.
  Pose2 Middle(Side swing) const {
    const Side support = Opposite(swing);
    return Nth(feet_, Index(support)).Planar() * Beside(support, gait_.width).Inverse();
  }

  // What the course asks of a footstep, in the frame of the middle.
  Eigen::Vector3d Wanted(Side swing) const {
    if (line_) return AlongPath(swing);
    Eigen::Vector3d v = gait_.pace * course_.velocity;
    for (const int i : {1, 2}) v[i] *= Leads(swing, v[i]) ? 2.0 : 0.0;
    return v;
  }

  Eigen::Vector3d AlongPath(Side swing) const {
    constexpr double kNear = 0.15, kLook = 0.25, kMostTurn = 0.3;  // [m], [m], [rad]
    const Pose2 X_WB = Middle(swing);
    const PathPlace here = line_->Nearest(X_WB);
    const double step = gait_.pace * course_.speed;
    const Eigen::Vector2d to =
        line_->At(here.s + std::max(step, kLook)).X_WP.position() - X_WB.position();
    const double far = to.norm();
    const bool beside = (here.X_WP.position() - X_WB.position()).norm() <= kNear;
    // Near the path the robot looks along it, else to where it goes.
    const double yaw =
        beside || far < kNear ? line_->At(here.s + step).X_WP.yaw : Atan2(to.y(), to.x());
    const double turn = std::remainder(yaw - X_WB.yaw, 2.0 * std::numbers::pi);
    const double part = far > 0.0 ? std::min(1.0, step / far) * std::max(0.0, Cos(turn)) : 0.0;
    const Eigen::Vector2d p_B = X_WB.rotation().transpose() * (part * to);
    Eigen::Vector3d v(p_B.x(), p_B.y(), std::clamp(turn, -kMostTurn, kMostTurn));
    for (const int i : {1, 2}) v[i] *= Leads(swing, v[i]) ? 1.0 : 0.0;
    return v;
  }

  // Whether nothing of the course is left but to close the feet.
  bool IsOver() const {
    if (!line_) return course_.Rests();
    constexpr double kThere = 0.03, kAlong = 0.1;  // [m], [rad]
    const Pose2 X_WB = Middle(Opposite(landed_));
    const PathPlace end = line_->At(line_->length());
    return (end.X_WP.position() - X_WB.position()).norm() <= kThere &&
           std::abs(std::remainder(end.X_WP.yaw - X_WB.yaw, 2.0 * std::numbers::pi)) <= kAlong;
  }

  // The next footstep of feet that stand.
  std::optional<Next> NextOf() const {
    const std::optional<Next> next = Of(Opposite(landed_), /*must=*/false);
    // Where one foot has nothing to do, the other one may.
    return next ? next : Of(landed_, /*must=*/false);
  }

  // The largest part of a footstep that is in a cell of the set, up to a hundredth.
  template <typename Placed>
  double LargestPart(Side support, const Placed& placed) const {
    if (HasCell(gait_, support, placed(1.0))) return 1.0;
    double least = 0.0, most = 1.0;
    while (most - least > 0.01) {
      const double middle = 0.5 * (least + most);
      (HasCell(gait_, support, placed(middle)) ? least : most) = middle;
    }
    return least;
  }

  // None: the ground does not bear it, or the foot stands there already.
  std::optional<Next> Of(Side swing, bool must) const {
    const Side support = Opposite(swing);
    const Foothold& X_WS = Nth(feet_, Index(support));
    const Eigen::Vector3d wanted = IsOver() ? Eigen::Vector3d::Zero() : Wanted(swing);
    const Pose2 from = Beside(support, gait_.width).Inverse(), to = Beside(swing, gait_.width);
    const auto placed = [&](double part) { return from * Exp(part * wanted) * to; };
    const double part = LargestPart(support, placed);
    const Pose2 X_SF = placed(part);
    const Pose2 is = (X_WS.Inverse() * Nth(feet_, Index(swing))).Planar();
    const bool stays = std::abs(X_SF.x - is.x) < kStill && std::abs(X_SF.y - is.y) < kStill &&
                       std::abs(X_SF.yaw - is.yaw) < kStill;
    if (stays && !must) return std::nullopt;
    const Pose2 X_WF = X_WS.Planar() * X_SF;
    const double height = gait_.ground ? gait_.ground(X_WF, X_WS.height) : X_WS.height;
    if (std::isnan(height)) return std::nullopt;
    return Next{.footstep = {.side = swing,
                             .X_WF = Foothold(X_WF, height),
                             .via_height = gait_.set.prototype.via_height,
                             .duration = gait_.set.prototype.duration},
                .part = part};
  }

  const Course& course_;
  const Gait& gait_;
  std::optional<PathLine> line_;
  std::array<Foothold, 2> feet_;
  Side landed_;
};

}  // namespace

CourseSteps FootstepsAlong(const Course& course, const Gait& gait, const Standing& standing,
                           int count) {
  return Steps(course, gait, standing).Take(standing.in_air, count);
}

std::string ShortfallText(const CourseSteps& steps) {
  if (steps.part >= 1.0) return "";
  return Formatted("; footsteps go %.0f %% as far, as much as half-steps reach",
                   100.0 * steps.part);
}

GoalRegion RegionAlong(const Course& course, const std::array<Foothold, 2>& feet, double ahead) {
  GoalRegion region;
  region.part = GoalPart::kMidFeet;
  region.radius = 0.1;
  region.yaw_tolerance = 0.3;
  const Pose2 X_WM = MidFeet(feet[0].Planar(), feet[1].Planar());
  if (course.kind == CourseKind::kPath) {
    const PathLine line(course.path);
    region.X_WG = line.At(line.Nearest(X_WM).s + course.speed * ahead).X_WP;
  } else {
    region.X_WG = X_WM * Exp(ahead * course.velocity);
  }
  return region;
}

}  // namespace halfstep
