#include "experiments/checker/walk_statements.h"

#include <algorithm>
#include <cmath>

#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/robot_motion.h"
#include "experiments/checker/separation.h"
#include "wpg/nth.h"
#include "wpg/robot/sole_outline.h"

namespace halfstep::checker {
namespace {

using verify::Family;

constexpr Kept kDoesNotCount = {kInfinity, kInfinity};
constexpr double kOnFloor = 1e-8;  // soles are no lower than what bears them, but for rounding [m]
constexpr double kSinking = 0.01;  // height below which the limit of sinking is its own [m]

template <int N>
Kept Of(const Taylor<N>& margin) {
  return Kept::Of(margin.over[0], margin.at[0]);
}
template <int N>
Kept Inside(const std::vector<SupportEdge<N>>& support) {
  Kept kept = kDoesNotCount;
  for (const SupportEdge<N>& edge : support) kept = Least(kept, Of(edge.inside));
  return kept;
}

}  // namespace

Vector CenterAt(const FrameIn<Curve>& X_W, const ConvexBody& body) {
  const VectorIn<Curve> center = X_W * VectorOf<Curve>(body.center);
  return {center[0].over[0], center[1].over[0], center[2].over[0]};
}

ConvexBody PrismOver(const Eigen::Matrix2Xd& polygon, double bottom, double top) {
  ConvexBody prism;
  prism.vertices.resize(3, polygon.cols() * (bottom < top ? 2 : 1));
  for (Eigen::Index i = 0; i < prism.vertices.cols(); ++i) {
    prism.vertices.col(i) << polygon.col(i % polygon.cols()), i < polygon.cols() ? bottom : top;
  }
  prism.center << polygon.rowwise().mean(), 0.5 * (bottom + top);
  prism.radius = (prism.vertices.colwise() - prism.center).colwise().norm().maxCoeff();
  prism.radius *= 1.0 + 1e-12;
  return prism;
}

// A body is seen from the other one, so that their common motion does not count.
Kept WalkStatements::Apart(const Placed& a, const Placed& b, double demanded,
                           Eigen::Vector3d* direction, bool told) {
  const Vector d = b.center - a.center;
  const Interval between = Sqrt(Square(d[0]) + Square(d[1]) + Square(d[2]));
  const double spheres = (between - Interval(a.shape.radius) - Interval(b.shape.radius)).lo;
  if (spheres >= demanded) return {spheres, spheres};
  const FrameIn<Curve> X_AB = a.X_W.Inverse() * b.X_W;
  const Frame over = FrameOver(X_AB);
  const double known =
      direction->isZero() ? -kInfinity : GapAlong(*direction, a.shape, Frame(), b.shape, over);
  if (known >= demanded) return {known, known};
  if (told) {
    const Eigen::Isometry3d X_WA = MiddleOf(FrameOver(a.X_W, true)),
                            X_WB = MiddleOf(FrameOver(b.X_W, true));
    const double far = (X_WB * b.shape.center - X_WA * a.shape.center).norm();
    const Kept kept{std::max(spheres, known), far - a.shape.radius - b.shape.radius};
    if (direction->isZero()) return {kept.bound, kept.value, true};
    const Frame there = FrameOf(X_WA.inverse() * X_WB);
    return {kept.bound,
            std::max(kept.value, GapAlong(*direction, a.shape, Frame(), b.shape, there))};
  }
  const SeparationHint hint =
      HintOf(a.shape, Eigen::Isometry3d::Identity(), b.shape, MiddleOf(FrameOver(X_AB, true)));
  *direction = hint.direction;
  return {std::max(known, GapAlong(hint.direction, a.shape, Frame(), b.shape, over)),
          hint.distance};
}

WalkStatements::WalkStatements(const RobotModel& robot, const Scene& scene,
                               const verify::CertificateText& certificate)
    : robot_(robot), scene_(scene), certificate_(certificate) {
  const auto add = [&](Family family, const std::string& subject, size_t a = 0, size_t b = 0) {
    const double demanded = Nth(certificate.demanded, family);
    if (demanded == verify::kNotDemanded) return;
    all_.push_back({family, subject, demanded, a, b});
  };
  if (std::isfinite(scene.ground->Floor())) add(verify::kFloor, "swing foot");
  const std::vector<GroundSolid>& solids = scene.ground->Solids();
  const size_t num_obstacles = scene.obstacles.size();
  for (size_t k = 0; k < solids.size(); ++k) {
    add(verify::kFloor, "swing foot - " + solids[k].name, 1, num_obstacles + k);
  }
  if (certificate.foot_speed) add(verify::kFootSpeed, "swing foot");
  if (certificate.foot_yaw_rate) add(verify::kFootYawRate, "swing foot");
  if (certificate.landing_speed) add(verify::kLandingSpeed, "swing foot");
  add(verify::kZmp, "point mass");
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto s = static_cast<size_t>(Index(side));
    add(verify::kReach, std::string(Name(side)) + " leg", s);
    for (size_t j = 0; j < 6; ++j) {
      const LegJoint& joint = robot.legs[s].joints[j];
      add(verify::kJoint, joint.name, s, j);
      add(verify::kJointSpeed, joint.name, s, j);
      if (std::isfinite(joint.max_acceleration)) add(verify::kJointAcceleration, joint.name, s, j);
      if (std::isfinite(joint.max_torque)) add(verify::kTorque, joint.name, s, j);
    }
  }
  for (const auto& [a, b] : robot.self_pairs) {
    add(verify::kSelfClearance, Nth(robot.bodies, a).name + " - " + Nth(robot.bodies, b).name,
        static_cast<size_t>(a), static_cast<size_t>(b));
  }
  for (size_t i = 0; i < robot.bodies.size(); ++i) {
    if (std::isfinite(scene.ground->Floor())) add(verify::kGround, robot.bodies[i].name, i);
    for (size_t k = 0; k < num_obstacles + solids.size(); ++k) {
      add(verify::kClearance, robot.bodies[i].name + " - " + scene.NameOf(static_cast<int>(k)), i,
          k);
    }
  }
  for (const Obstacle& obstacle : scene.obstacles) {
    const auto* const mesh = std::get_if<TriangleMesh>(&obstacle.shape);
    meshes_.push_back(mesh != nullptr ? std::make_unique<MeshTree>(*mesh) : nullptr);
    obstacles_.push_back(mesh != nullptr ? meshes_.back()->Around() : BodyOfObstacle(obstacle));
  }
  for (const GroundSolid& solid : solids) {
    obstacles_.push_back(PrismOver(solid.polygon, solid.bottom, solid.top));
  }
  if (!solids.empty()) foot_ = PrismOver(FootOutline(robot));
  add(verify::kZmpRobot, "robot");
  add(verify::kFriction, "soles");
}

std::vector<double> WalkStatements::WaypointTimes() const {
  std::vector<double> times;
  for (const Obstacle& obstacle : scene_.obstacles) {
    for (const ObstacleMotion::Waypoint& waypoint : obstacle.motion.waypoints) {
      times.push_back(waypoint.t);
    }
  }
  return times;
}

Kept WalkStatements::Look(WalkStatement* statement, WalkState* state) const {
  const WalkNumbers& x = state->numbers();
  switch (statement->family) {
    case verify::kZmp: {
      const Seen<3> zmp = {x[kZmp], x[kZmp + 1]};
      return Inside<3>(state->Support<3>({zmp, zmp}));
    }
    case verify::kReach:
      return Of(state->reach(statement->a));
    case verify::kJoint:
    case verify::kJointSpeed:
    case verify::kJointAcceleration:
      return OfJoint(*statement, state);
    case verify::kSelfClearance:
    case verify::kClearance:
    case verify::kGround:
      return OfBodies(statement, state);
    case verify::kZmpRobot: {
      const WalkState::Dynamics& all = state->dynamics();
      return Inside<1>(
          state->Support<1>({all.At(state->HeightOf(0)), all.At(state->HeightOf(1))}, all.lean));
    }
    case verify::kFriction:
      return Friction(state);
    case verify::kTorque:
      return Torque(*statement, state);
    default:
      return OfSwingFoot(statement, *state);
  }
}

Kept WalkStatements::OfSwingFoot(WalkStatement* statement, const WalkState& state) const {
  const WalkMotion::Flight* const flight = state.flight();
  if (flight == nullptr) return kDoesNotCount;
  const Curve* const sole = &state.numbers()[kSole + 4 * flight->side];
  const Curve& z = sole[2];
  const auto speed = [&](auto part) {
    return Sqrt(Square(part(sole[0])) + Square(part(sole[1])) + Square(part(z)));
  };
  switch (statement->family) {
    case verify::kFloor: {
      if (state.middle() < flight->moves_from || state.middle() > flight->moves_to) break;
      if (statement->a == 0) return Of(z - Curve(scene_.ground->Floor()));
      const FrameIn<Curve>& X_WF = state.sole(flight->side);
      return FromSolid(statement, {foot_, X_WF, CenterAt(X_WF, foot_)});
    }
    case verify::kFootSpeed:
      return Kept::Under(*certificate_.foot_speed, speed([](const Curve& x) { return x.over[1]; }),
                         speed([](const Curve& x) { return x.at[1]; }));
    case verify::kFootYawRate:
      return Kept::Under(*certificate_.foot_yaw_rate, sole[3].over[1], sole[3].at[1]);
    case verify::kLandingSpeed: {
      // v·max(1, z/1 cm) is at least either.
      const Taylor<2> sinking = z.Derivative<1, 2>();
      const double v = *certificate_.landing_speed;
      const Kept low = Of(sinking + Taylor<2>(v));
      const Taylor<2> above = z.Derivative<0, 2>() - Taylor<2>(flight->landing);
      const Kept high = Of(sinking + Interval(v) / Interval(kSinking) * above);
      return {std::max(low.bound, high.bound), std::max(low.value, high.value)};
    }
    default:
      break;
  }
  return kDoesNotCount;
}

Kept WalkStatements::OfJoint(const WalkStatement& statement, WalkState* state) const {
  const LegJoint& joint = robot_.legs[statement.a].joints[statement.b];
  const Curve& q = state->leg(statement.a).q[statement.b];
  if (statement.family == verify::kJointSpeed) {
    return Kept::Under((Interval(certificate_.joint_speed_scale) * Interval(joint.max_speed)).lo,
                       q.over[1], q.at[1]);
  }
  if (statement.family == verify::kJointAcceleration) {
    return Kept::Under(joint.max_acceleration, q.over[2], q.at[2]);
  }
  const double at = q.at[0].Middle();
  return {std::min(Beyond(q.over[0].lo, joint.lower), Beyond(joint.upper, q.over[0].hi)),
          std::min(at - joint.lower, joint.upper - at)};
}

const GroundSolid* WalkStatements::SolidOf(const WalkStatement& statement) const {
  const size_t first = scene_.obstacles.size();
  const bool is = statement.family == verify::kClearance && statement.b >= first;
  return is ? &scene_.ground->Solids()[statement.b - first] : nullptr;
}

Kept WalkStatements::FromSolid(WalkStatement* statement, const Placed& moving) const {
  const ConvexBody& solid = obstacles_[statement->b];
  return Apart({solid, FrameIn<Curve>(), VectorOf(solid.center)}, moving, statement->demanded,
               &statement->direction, statement->told);
}

Kept WalkStatements::OfBodies(WalkStatement* statement, WalkState* state) const {
  const RobotBody& body = robot_.bodies[statement->a];
  const GroundSolid* const solid = SolidOf(*statement);
  bool below = false;
  if (body.leg >= 0 && body.link == 5 && statement->family != verify::kSelfClearance) {
    // It reaches no lower than its sole (wpg/README.md, "Robots"), whose plane separates it from
    // what is below.
    const Curve& z = state->numbers()[kSole + 4 * static_cast<size_t>(body.leg) + 2];
    const double floor = scene_.ground->Floor();
    const auto kept = [&](double height) {
      return height >= floor - kOnFloor ? kInfinity : height - floor;
    };
    if (statement->family == verify::kGround) return {kept(z.over[0].lo), kept(z.at[0].Middle())};
    if (solid != nullptr && solid->top - kOnFloor <= z.over[0].lo) return kDoesNotCount;
    // Where it is below in the middle, shorter intervals may tell.
    below = solid != nullptr && solid->top - kOnFloor <= z.at[0].lo;
  }
  const auto placed = [&](size_t i) -> Placed {
    const RobotBody& of = robot_.bodies[i];
    const FrameIn<Curve>& X_W = state->FrameOfBody(of);
    return {of.shape, X_W, state->CenterOf(i)};
  };
  const Placed moving = placed(statement->a);
  if (statement->family == verify::kSelfClearance) {
    return Apart(placed(statement->b), moving, statement->demanded, &statement->direction,
                 statement->told);
  }
  if (solid != nullptr) {
    const Kept kept = FromSolid(statement, moving);
    return below ? Kept{kept.bound, kInfinity, kept.hint_missing} : kept;
  }
  if (statement->family == verify::kClearance) return FromObstacle(statement, moving, *state);
  const double lowest = (moving.center[2] - Interval(body.shape.radius)).lo;
  if (lowest >= statement->demanded) return {lowest, lowest};
  const Eigen::Isometry3d about = MiddleOf(FrameOver(moving.X_W, true));
  const Eigen::Vector3d down = about.linear().transpose() * -Eigen::Vector3d::UnitZ();
  return {LeastAlong(Eigen::Vector3d::UnitZ(), body.shape, FrameOver(moving.X_W)),
          (about * SupportPoint(body.shape, down)).z()};
}

}  // namespace halfstep::checker
