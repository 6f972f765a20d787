#include "experiments/checker/walk_statements.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/checker/interval_proof.h"
#include "experiments/checker/separation.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

using verify::Family;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Kept kDoesNotCount = {kInfinity, kInfinity};
constexpr double kOnFloor = 1e-8;  // soles are no lower, but for rounding [m]
constexpr double kSinking = 0.01;  // height below which the limit of sinking is its own [m]

Kept Least(const Kept& a, const Kept& b) {
  return {std::min(a.bound, b.bound), std::min(a.value, b.value)};
}
// All of an interval, and about what its middle has.
Kept Of(const Interval& over, const Interval& at) { return {over.lo, at.Middle()}; }
template <int N>
Kept Of(const Taylor<N>& margin) {
  return Of(margin.over[0], margin.at[0]);
}
// limit − |x|.
Kept Under(double limit, const Interval& over, const Interval& at) {
  return {Beyond(limit, over.Magnitude()), limit - at.Magnitude()};
}

template <int N>
Kept Inside(const SupportEdges& support, const std::array<Taylor<N>, 2>& p) {
  Kept kept = kDoesNotCount;
  for (const SupportEdges::Edge& edge : support.edges) {
    kept = Least(kept, Of(support.Left(edge, p)));
  }
  return kept;
}

Frame Over(const FrameIn<Curve>& X) {
  Frame frame;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) frame.R[i][k] = X.R[i][k].over[0];
    frame.p[i] = X.p[i].over[0];
  }
  return frame;
}
Eigen::Isometry3d About(const FrameIn<Curve>& X) {
  Eigen::Isometry3d about = Eigen::Isometry3d::Identity();
  for (size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (size_t k = 0; k < 3; ++k) {
      about.linear()(row, static_cast<Eigen::Index>(k)) = X.R[i][k].at[0].Middle();
    }
    about.translation()[row] = X.p[i].at[0].Middle();
  }
  return about;
}

// The frame of an obstacle on an interval that holds no time of a waypoint: it goes straight from
// one to the next, and turns steadily about the vertical.
FrameIn<Curve> PlaceOf(const Obstacle& obstacle, const WalkState& state) {
  FrameIn<Curve> X_WO = FrameOf<Curve>(obstacle.X_WO);
  if (obstacle.motion.waypoints.empty()) return X_WO;
  ObstacleMotion::Waypoint from{.t = 0.0, .translation = obstacle.X_WO.translation()};
  for (const ObstacleMotion::Waypoint& to : obstacle.motion.waypoints) {
    if (to.t <= state.middle()) {
      from = to;
      continue;
    }
    const Interval rate = Interval(1.0) / (Interval(to.t) - Interval(from.t));
    Curve share;
    share.h = state.h();
    share.at = {(Interval(state.middle()) - Interval(from.t)) * rate, rate, 0.0};
    share.Enclose();
    const auto between = [&](double a, double b) {
      return Curve(a) + (Interval(b) - Interval(a)) * share;
    };
    const auto [s, c] = SinCosOf(between(from.yaw, to.yaw));
    X_WO = TurnAbout(Eigen::Vector3d::UnitZ(), s, c) * X_WO;
    for (Eigen::Index i = 0; i < 3; ++i) {
      Nth(X_WO.p, i) = between(from.translation[i], to.translation[i]);
    }
    return X_WO;
  }
  // At the last one.
  const auto [s, c] = SinCosOf(Curve(from.yaw));
  X_WO = TurnAbout(Eigen::Vector3d::UnitZ(), s, c) * X_WO;
  X_WO.p = VectorOf<Curve>(from.translation);
  return X_WO;
}

// How far a point of it may be from there: error + speed·min(|t − t_m|, horizon) [m].
double FarthestAway(const ObstacleMotion& motion, const WalkState& state) {
  if (motion.speed == 0.0) return motion.error;
  const double since = Above(std::abs(state.middle() - motion.measured_at)) + state.h();
  return Above(motion.error + Above(motion.speed * std::min(Above(since), motion.horizon)));
}

}  // namespace

// A body is seen from the other one, so that their common motion does not count.
Kept WalkStatements::Apart(const Placed& a, const Placed& b, double demanded,
                           Eigen::Vector3d* direction, bool told) {
  const Vector d = b.center - a.center;
  const Interval between = Sqrt(Square(d[0]) + Square(d[1]) + Square(d[2]));
  const double spheres = (between - Interval(a.shape.radius) - Interval(b.shape.radius)).lo;
  if (spheres >= demanded) return {spheres, spheres};
  const FrameIn<Curve> X_AB = a.X_W.Inverse() * b.X_W;
  const Frame over = Over(X_AB);
  const double known =
      direction->isZero() ? -kInfinity : GapAlong(*direction, a.shape, Frame(), b.shape, over);
  if (known >= demanded) return {known, known};
  if (told) {
    const Eigen::Isometry3d X_WA = About(a.X_W), X_WB = About(b.X_W);
    const double far = (X_WB * b.shape.center - X_WA * a.shape.center).norm();
    const Kept kept{std::max(spheres, known), far - a.shape.radius - b.shape.radius};
    if (direction->isZero()) return {kept.bound, kept.value, true};
    const Frame there = FrameOf(X_WA.inverse() * X_WB);
    return {kept.bound,
            std::max(kept.value, GapAlong(*direction, a.shape, Frame(), b.shape, there))};
  }
  const SeparationHint hint = HintOf(a.shape, Eigen::Isometry3d::Identity(), b.shape, About(X_AB));
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
  add(verify::kFloor, "swing foot");
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
    add(verify::kGround, robot.bodies[i].name, i);
    for (size_t k = 0; k < scene.obstacles.size(); ++k) {
      add(verify::kClearance, robot.bodies[i].name + " - " + scene.obstacles[k].name, i, k);
    }
  }
  for (const Obstacle& obstacle : scene.obstacles) obstacles_.push_back(BodyOfObstacle(obstacle));
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
    case verify::kZmp:
      return Inside<3>(state->Support(), {x[kZmp], x[kZmp + 1]});
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
      SupportEdges support = state->Support();
      const WalkState::Dynamics& dynamics = state->dynamics();
      return Inside<1>(support, dynamics.zmp_W());
    }
    case verify::kFriction:
      return Friction(state);
    case verify::kTorque:
      return Torque(*statement, state);
    default:
      return OfSwingFoot(statement->family, *state);
  }
}

Kept WalkStatements::OfSwingFoot(Family family, const WalkState& state) const {
  const WalkMotion::Flight* const flight = state.flight();
  if (flight == nullptr) return kDoesNotCount;
  const Curve* const sole = &state.numbers()[kSole + 4 * flight->side];
  const Curve& z = sole[2];
  const auto speed = [&](auto part) {
    return Sqrt(Square(part(sole[0])) + Square(part(sole[1])) + Square(part(z)));
  };
  switch (family) {
    case verify::kFloor:
      if (state.middle() < flight->moves_from || state.middle() > flight->moves_to) break;
      return Of(z);
    case verify::kFootSpeed:
      return Under(*certificate_.foot_speed, speed([](const Curve& x) { return x.over[1]; }),
                   speed([](const Curve& x) { return x.at[1]; }));
    case verify::kFootYawRate:
      return Under(*certificate_.foot_yaw_rate, sole[3].over[1], sole[3].at[1]);
    case verify::kLandingSpeed: {
      // v·max(1, z/1 cm) is at least either.
      const Taylor<2> sinking = z.Derivative<1, 2>();
      const double v = *certificate_.landing_speed;
      const Kept low = Of(sinking + Taylor<2>(v));
      const Kept high = Of(sinking + Interval(v) / Interval(kSinking) * z.Derivative<0, 2>());
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
    return Under((Interval(certificate_.joint_speed_scale) * Interval(joint.max_speed)).lo,
                 q.over[1], q.at[1]);
  }
  if (statement.family == verify::kJointAcceleration) {
    return Under(joint.max_acceleration, q.over[2], q.at[2]);
  }
  const double at = q.at[0].Middle();
  return {std::min(Beyond(q.over[0].lo, joint.lower), Beyond(joint.upper, q.over[0].hi)),
          std::min(at - joint.lower, joint.upper - at)};
}

Kept WalkStatements::OfBodies(WalkStatement* statement, WalkState* state) const {
  const RobotBody& body = robot_.bodies[statement->a];
  if (statement->family == verify::kGround && body.leg >= 0 && body.link == 5) {
    // It reaches no lower than its sole (wpg/README.md, "Robots").
    const Curve& z = state->numbers()[kSole + 4 * static_cast<size_t>(body.leg) + 2];
    const auto kept = [](double height) { return height >= -kOnFloor ? kInfinity : height; };
    return {kept(z.over[0].lo), kept(z.at[0].Middle())};
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
  if (statement->family == verify::kClearance) {
    const Obstacle& obstacle = scene_.obstacles[statement->b];
    const ConvexBody& shape = obstacles_[statement->b];
    const FrameIn<Curve> X_WO = PlaceOf(obstacle, *state);
    const VectorIn<Curve> middle = X_WO * VectorOf<Curve>(shape.center);
    const Vector center = {middle[0].over[0], middle[1].over[0], middle[2].over[0]};
    const double away = FarthestAway(obstacle.motion, *state);
    const Kept kept = Apart({shape, X_WO, center}, moving, Above(statement->demanded + away),
                            &statement->direction, statement->told);
    return {checker::Below(kept.bound - away), kept.value - away, kept.hint_missing};
  }
  const double lowest = (moving.center[2] - Interval(body.shape.radius)).lo;
  if (lowest >= statement->demanded) return {lowest, lowest};
  const Eigen::Isometry3d about = About(moving.X_W);
  const Eigen::Vector3d down = about.linear().transpose() * -Eigen::Vector3d::UnitZ();
  return {LeastAlong(Eigen::Vector3d::UnitZ(), body.shape, Over(moving.X_W)),
          (about * SupportPoint(body.shape, down)).z()};
}

// Two points p ± ρu, each with half of the push, inside of the soles' hull: along u an edge, where
// they may be farthest apart in the middle of the interval. With d the distance inside an edge
// whose normal n has the part |n·u|, ρ is the least of d/|n·u|.
Kept WalkStatements::Friction(WalkState* state) const {
  const SupportEdges support = state->Support();
  const WalkState::Dynamics& all = state->dynamics();
  const std::array<Rate, 2> p = all.zmp_W();
  const auto part = [](const SupportEdges::Edge& edge, const SupportEdges::Edge& along) {
    return Interval((edge.n[0] * along.n[1] - edge.n[1] * along.n[0]).Magnitude());
  };
  const SupportEdges::Edge* best = nullptr;
  double farthest = 0.0;
  for (const SupportEdges::Edge& along : support.edges) {
    double room = kInfinity;
    for (const SupportEdges::Edge& edge : support.edges) {
      room = std::min(room, support.Left(edge, p).at[0].Middle() / part(edge, along).hi);
    }
    if (room > farthest) farthest = room, best = &along;
  }
  if (best == nullptr) return {-kInfinity, -kInfinity};
  const auto& [force, moment] = all.floor;
  const Rate yaw = moment[2] - (all.zmp[0] * force[1] - all.zmp[1] * force[0]);
  const Rate push = Inverse(force[2]);
  const Rate square = force[0] * force[0] + force[1] * force[1];
  // ‖f_t‖, which has no derivative at 0.
  Interval side = Sqrt(square.over[0]), side_at = Sqrt(square.at[0]);
  if (square.over[0].lo > 0.0) side = Sqrt(square).over[0];
  Kept kept = kDoesNotCount;
  for (const SupportEdges::Edge& edge : support.edges) {
    const Rate inside = support.Left(edge, p);
    if (!(inside.over[0].lo > 0.0)) throw NotDefined();
    const Rate turning = part(edge, *best) * (yaw * Inverse(inside));
    const Interval over = (side + Interval(turning.over[0].Magnitude())) * push.over[0];
    const Interval at = (side_at + Interval(turning.at[0].Magnitude())) * push.at[0];
    kept = Least(kept, Of(Interval(scene_.friction) - over, Interval(scene_.friction) - at));
  }
  return kept;
}

// τ = e·(Σ moments of the links that hang on the joint − that of the floor on the foot), about a
// point of the axis. Where both soles stand the right foot carries λW + C and the left one
// (1 − λ)W − C, with λ by the distances of the ZMP from both soles.
Kept WalkStatements::Torque(const WalkStatement& statement, WalkState* state) const {
  const size_t side = statement.a;
  const LegJoint& joint = robot_.legs[side].joints[statement.b];
  const WalkState::Dynamics& all = state->dynamics();
  const FrameIn<Curve>& X_WLink = state->leg(side).X_WLink[statement.b];
  const Eigen::Isometry3d X_LinkB = joint.X_BLink.inverse();
  const Eigen::Vector3d point = robot_.legs[side].AxisPoint(statement.b);
  const VectorIn<Curve> axis_W = X_WLink.Turned(VectorOf<Curve>(X_LinkB.linear() * joint.axis_B));
  const VectorIn<Curve> point_W = X_WLink * VectorOf<Curve>(X_LinkB * point);
  const auto rates = [](const VectorIn<Curve>& x) -> VectorIn<Rate> {
    return {x[0].Derivative<0, 1>(), x[1].Derivative<0, 1>(), x[2].Derivative<0, 1>()};
  };
  const VectorIn<Rate> e = rates(axis_W);
  VectorIn<Rate> r = rates(point_W);
  r[0] = r[0] - Rate(all.reference.x());
  r[1] = r[1] - Rate(all.reference.y());
  const auto about = [&](const WalkState::Wrench& of) {
    return Dot(e, of.moment - Cross(r, of.force));
  };
  Rate links = 0.0;
  for (size_t j = statement.b; j < 6; ++j) links = links + about(all.links[side][j]);
  const Rate floor = about(all.floor);
  if (state->flight() != nullptr) {
    const Rate torque = state->Stands(side) ? links - floor : links;
    return Under(joint.max_torque, torque.over[0], torque.at[0]);
  }
  const auto shared = [&](const auto& of) {
    const std::array<Rate, 2> p = all.zmp_W();
    std::array<Interval, 2> away;
    std::array<std::array<Interval, 2>, 2> center;
    for (size_t s = 0; s < 2; ++s) {
      const Curve* const sole = &state->numbers()[kSole + 4 * s];
      center[s] = {sole[0].at[0], sole[1].at[0]};
      const auto [sin, cos] = SinCosOf(sole[3].at[0]);
      const Interval x = of(p[0]) - center[s][0], y = of(p[1]) - center[s][1];
      const auto out = [](const Interval& along, double size) {
        const Interval half = Interval(0.5) * Interval(size), past = along - half;
        const Interval before = -along - half;
        return Interval(std::max({0.0, past.lo, before.lo}), std::max({0.0, past.hi, before.hi}));
      };
      away[s] = Sqrt(Square(out(cos * x + sin * y, robot_.sole_size.x())) +
                     Square(out(cos * y - sin * x, robot_.sole_size.y())));
    }
    const Interval sum = away[0] + away[1];
    if (!(sum.lo > 0.0)) throw NotDefined();
    const Interval of_right(std::max(0.0, (Interval(away[0].lo) / sum).lo),
                            std::min(1.0, (Interval(away[0].hi) / sum).hi));
    const Interval couple = of_right * (Interval(1.0) - of_right) * of(all.floor.force[2]);
    // C = λ(1 − λ) f_z (c_R − c_L) × ẑ.
    const Interval turn = couple * (of(e[0]) * (center[1][1] - center[0][1]) -
                                    of(e[1]) * (center[1][0] - center[0][0]));
    return of(links) - (side == 1 ? of_right * of(floor) + turn
                                  : (Interval(1.0) - of_right) * of(floor) - turn);
  };
  return Under(joint.max_torque, shared([](const Rate& x) { return x.over[0]; }),
               shared([](const Rate& x) { return x.at[0]; }));
}

}  // namespace halfstep::checker
