#include "experiments/checker/tube_loss.h"

#include <algorithm>

namespace halfstep::checker {
namespace {

// Points of the line: the left sole, the left leg's axes from the ankle up, the right leg's from
// the hip down, the right sole. Points i and i + 1 are of one link, the waist at 6.
constexpr size_t kWaist = 6;

Interval Length(const Vector& v) { return Sqrt(Square(v[0]) + Square(v[1]) + Square(v[2])); }

Interval Sum(const std::array<Interval, 14>& of, size_t first, size_t end) {
  Interval sum = 0.0;
  for (size_t i = first; i < end; ++i) sum = sum + of[i];
  return sum;
}
const Interval& Lesser(const Interval& a, const Interval& b) { return a.hi < b.hi ? a : b; }

}  // namespace

TubeLoss::TubeLoss(const verify::TubeText& text, const RobotModel& robot) : tube_(text) {
  const Tube& tube = tube_.tube;
  std::array<Vector, 14> line;
  for (size_t side = 0; side < 2; ++side) {
    line[13 * side] = VectorOf(robot.legs[side].X_BSole.translation());
    for (size_t j = 0; j < 6; ++j) {
      line[side == 0 ? 6 - j : 7 + j] = VectorOf(robot.legs[side].AxisPoint(j));
    }
  }
  std::array<Interval, 13> link;  // distances of neighbours
  for (size_t i = 0; i < 13; ++i) link[i] = Length(line[i + 1] - line[i]);
  for (const RobotBody& body : robot.bodies) {
    OnLine& on = bodies_.emplace_back();
    const size_t side = static_cast<size_t>(std::max(body.leg, 0));
    const size_t number = static_cast<size_t>(std::max(body.link, 0));
    on.gap = body.leg < 0 ? kWaist : side == 0 ? 5 - number : 7 + number;
    const Frame X_LinkB =
        body.leg < 0 ? Frame() : FrameOf(robot.legs[side].joints[number].X_BLink).Inverse();
    const auto farthest = [&](const Vector& from_B) {
      const Vector from = X_LinkB * from_B;
      double most = 0.0;
      for (const auto& vertex : body.shape.vertices.colwise()) {
        most = std::max(most, Length(VectorOf(vertex) - from).hi);
      }
      return Interval(most) + Interval(body.shape.disc_radius) + Interval(body.shape.ball_radius);
    };
    auto& far = on.far;
    far[on.gap] = farthest(line[on.gap]);
    far[on.gap + 1] = farthest(line[on.gap + 1]);
    for (size_t i = on.gap; i-- > 0;) far[i] = far[i + 1] + link[i];
    for (size_t i = on.gap + 2; i < 14; ++i) far[i] = far[i - 1] + link[i - 1];
    // By the waist and the joints between, or by a sole and those.
    const size_t hip = on.gap < kWaist ? kWaist : kWaist + 1;
    const Interval of_waist =
        on.gap == kWaist ? farthest({0.0, 0.0, 0.0}) : far[hip] + Length(line[hip]);
    const Interval joint = tube.joint, foot = tube.foot, turn = tube.foot_turn;
    const Interval left = foot + turn * far[0] + joint * Sum(far, 1, on.gap + 1);
    const Interval right = foot + turn * far[13] + joint * Sum(far, on.gap + 1, 13);
    on.way = Interval(tube.waist) + Interval(tube.waist_turn) * of_waist +
             joint * (on.gap < kWaist ? Sum(far, on.gap + 1, kWaist + 1)
                                      : Sum(far, kWaist + 1, on.gap + 1));
    if (on.gap <= kWaist) on.way = Lesser(on.way, left);
    if (on.gap >= kWaist) on.way = Lesser(on.way, right);
  }
  double outline = 0.0;
  for (const auto& corner : robot.sole_outline.colwise()) {
    outline = std::max(outline, Length({corner.x(), corner.y(), 0.0}).hi);
  }
  sole_ = Interval(tube.foot) + Interval(tube.foot_turn) * Interval(outline);
}

double TubeLoss::Raised(verify::Family family, double demanded, const Interval& loss) const {
  if (demanded == verify::kNotDemanded) return demanded;
  Interval before = demanded;
  for (const auto& [name, by] : tube_.raised) {
    if (name == verify::kFamilyNames[family]) before = before - Interval(by);
  }
  return std::max(demanded, (before + loss).hi);
}

double TubeLoss::Demanded(verify::Family family, double demanded) const {
  switch (family) {
    case verify::kFloor:
    case verify::kNoStep:
      return Raised(family, demanded, sole_);
    case verify::kZmpRobot:
      return Raised(family, demanded, sole_ + Interval(tube_.tube.zmp));
    case verify::kJoint:
      return Raised(family, demanded, tube_.tube.joint);
    case verify::kJointSpeed:
      return Raised(family, demanded, tube_.tube.joint_speed);
    default:
      return demanded;
  }
}

// Of a joint between two bodies either may be taken to rest.
double TubeLoss::Demanded(const WalkStatement& statement) const {
  const bool pair = statement.family == verify::kSelfClearance;
  if (!pair && statement.family != verify::kClearance && statement.family != verify::kGround) {
    return statement.demanded;
  }
  const OnLine& a = bodies_[statement.a];
  if (statement.family == verify::kGround && (a.gap == 0 || a.gap == 12)) {
    return statement.demanded;  // it may touch the floor
  }
  if (!pair) return Raised(statement.family, statement.demanded, a.way);
  const OnLine& b = bodies_[statement.b];
  Interval between = 0.0;
  for (size_t i = std::min(a.gap, b.gap) + 1; i <= std::max(a.gap, b.gap); ++i) {
    between = between + Interval(tube_.tube.joint) * Lesser(a.far[i], b.far[i]);
  }
  return Raised(statement.family, statement.demanded, Lesser(between, a.way + b.way));
}

}  // namespace halfstep::checker
