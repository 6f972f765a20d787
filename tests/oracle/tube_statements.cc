// The oracle's statements about motions that stay within a tube of the walk.
#include <algorithm>
#include <cmath>

#include "tests/oracle/plain_soles.h"
#include "tests/oracle/walk_truth.h"

namespace halfstep::oracle {
namespace {

// What of a foot touches the floor, in the sole's frame: the rectangle and the body's lowest
// points.
std::vector<Eigen::Vector3d> SoleOf(const PlainRobot& robot, size_t leg) {
  const Eigen::Vector2d half = 0.5 * robot.sole_size;
  std::vector<Eigen::Vector3d> points;
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) points.emplace_back(x, y, 0);
  }
  for (const PlainRobot::Body& body : robot.bodies) {
    if (body.link != robot.legs[leg].foot_link) continue;
    for (const Eigen::Vector3d& p : body.points) {
      const Eigen::Vector3d seen = p - robot.legs[leg].sole;
      if (seen.z() < 1e-9) points.push_back(seen);
    }
  }
  return points;
}

}  // namespace

// The same instant with another posture.
WalkTruth::Instant WalkTruth::Displaced(const Instant& plan, const TubePosture& posture) const {
  Instant moved;
  moved.t = plan.t;
  moved.state = plan.state;
  moved.speed = plan.speed;
  moved.reaches = true;
  moved.X_WB = posture.X_WB;
  moved.q = posture.q;
  moved.X_BLink = posture.X_BLink;
  for (size_t leg = 0; leg < 2; ++leg) moved.X_WSole[leg] = posture.X_WSole(leg);
  PlaceBodies(&moved);
  return moved;
}

// A family's least margin in a posture of the tube; of the statement with that name alone, where
// one is named.
TrueMargin WalkTruth::InPosture(const std::string& family, const std::string& subject,
                                const Stretch& s, const PlainTube& tube, Instant& plan,
                                Instant& moved) const {
  TrueMargin least;
  const auto lower = [&](double value, const std::string& of) {
    if (!(value < least.value) || (!subject.empty() && of != subject)) return;
    least = {value, value, plan.t, of};
  };
  if (family == "floor" || family == "no_step") {
    for (size_t foot = 0; foot < 2; ++foot) {
      const bool flies = s.in_air == static_cast<int>(foot);
      const std::string name = foot == 0 ? "left foot" : "right foot";
      std::vector<Eigen::Vector2d> outline;
      for (const Eigen::Vector3d& p : SoleOf(robot_, foot)) {
        const Eigen::Vector3d placed = moved.X_WSole[foot] * p;
        outline.push_back(placed.head<2>());
        if (family == "floor" && flies && s.moves) lower(placed.z(), name);
      }
      for (size_t k = 0; family == "no_step" && !flies && k < no_step_.size(); ++k) {
        lower(Apart(outline, no_step_[k]), name + " - area" + std::to_string(k));
      }
    }
  } else if (family == "ground") {
    for (size_t b = 0; b < robot_.bodies.size(); ++b) {
      if (leg_link_[b][1] == 5) continue;
      for (const Eigen::Vector3d& p : BodyAt(moved, b).points) lower(p.z(), robot_.bodies[b].name);
    }
  } else if (family == "zmp_robot") {
    std::vector<Eigen::Vector2d> corners;
    for (size_t foot = 0; foot < 2; ++foot) {
      if (s.in_air == static_cast<int>(foot)) continue;
      for (const Eigen::Vector2d& c : SoleCorners({0, 0, 0, 0}, robot_.sole_size)) {
        corners.push_back((moved.X_WSole[foot] * Eigen::Vector3d(c.x(), c.y(), 0)).head<2>());
      }
    }
    // The ZMP goes towards the nearest side.
    lower(InsideHull(corners, DynamicsOf(plan).zmp_in_world()) - tube.zmp, "");
  } else {
    for (const Statement& statement : statements_) {
      if (statement.family != family) continue;
      if (!subject.empty() && statement.subject != subject) continue;
      const double value = statement.value(moved, s).upper;
      lower(family == "joint_speed" ? value - tube.joint_speed : value, statement.subject);
    }
  }
  return least;
}

TrueMargin WalkTruth::InTube(const std::string& family, const PlainTube& tube, int tries,
                             Draw* draw) {
  TrueMargin least;
  const double nearest = Least(family)[family].t, any = draw->Uniform(0, walk_.duration());
  for (const double t : {nearest, any}) {
    At(family, t, "");  // so that it is known
    Instant& plan = instants_.at(t);
    if (!plan.reaches) continue;
    for (const Stretch& s : walk_.stretches()) {
      if (t < s.begin || t > s.end) continue;
      const std::string subject = InPosture(family, "", s, tube, plan, plan).subject;
      TubeMotions motions(robot_, tube, {plan.X_WB, plan.q, plan.X_BLink}, draw);
      const auto value = [&](const TubePosture& posture) {
        Instant moved = Displaced(plan, posture);
        return InPosture(family, subject, s, tube, plan, moved).value;
      };
      for (int k = 0; k < tries; ++k) {
        Instant moved = Displaced(plan, k % 3 == 2 ? motions.AtRandom() : motions.Lowering(value));
        const TrueMargin found = InPosture(family, "", s, tube, plan, moved);
        if (found.value < least.value) least = found;
      }
    }
  }
  return least;
}

}  // namespace halfstep::oracle
