#include "experiments/checker/check_trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/checker/curves.h"
#include "experiments/checker/interval_proof.h"
#include "experiments/checker/separation.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

using Kind = TrajectoryFinding::Kind;
constexpr double kSmooth = 1e-9;  // jumps of a velocity that are told as none [rad/s]

// A robot's joints and frames along a trajectory.
class Motion {
 public:
  Motion(const Trajectory& trajectory, const JointedRobot& robot)
      : curves_(trajectory), robot_(robot), curve_of_(robot.urdf().joints.size(), -1) {
    for (size_t j = 0; j < trajectory.joints.size(); ++j) {
      const auto named =
          std::ranges::find(robot.urdf().joints, trajectory.joints[j], &UrdfJoint::name);
      curve_of_[static_cast<size_t>(named - robot.urdf().joints.begin())] = static_cast<int>(j);
    }
  }

  const Curves& curves() const { return curves_; }
  int CurveOf(int joint) const { return Nth(curve_of_, joint); }

  struct Frames {
    std::vector<Frame> sure;
    std::vector<Eigen::Isometry3d> about;
  };
  // Of all links at an instant; the last instants are remembered, for pairs halve at the same ones.
  const Frames& At(double t) {
    const auto known = frames_.find(t);
    if (known != frames_.end()) return known->second;
    if (frames_.size() > 20'000) frames_.clear();
    std::vector<Interval> q(curve_of_.size());
    std::vector<double> middle(q.size(), 0.0);
    for (size_t j = 0; j < q.size(); ++j) {
      if (curve_of_[j] < 0) continue;
      q[j] = curves_.Range(curve_of_[j], 0, t, t);
      middle[j] = q[j].Middle();
    }
    return frames_.emplace(t, Frames{robot_.Frames(q), robot_.urdf().LinkPoses(middle)})
        .first->second;
  }
  // How far a joint is at most from where it is at `t` within [from, to] [rad].
  double Turned(int joint, double from, double to, double t) const {
    const int curve = CurveOf(joint);
    if (curve < 0) return 0.0;
    const Interval there = curves_.Range(curve, 0, from, to), here = curves_.Range(curve, 0, t, t);
    return std::max(there.FarthestFrom(here.lo), there.FarthestFrom(here.hi));
  }

 private:
  Curves curves_;
  const JointedRobot& robot_;
  std::vector<int> curve_of_;
  std::map<double, Frames> frames_;
};

// Two convex bodies, of which the first belongs to the robot.
struct Pair {
  Kind kind = Kind::kSelfClearance;
  std::string subject;
  const JointedRobot::Body* a = nullptr;
  const ConvexBody* b = nullptr;
  int link_b = -1;  // −1: at X_WB
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  double error = 0.0;  // how far the second one may be from there [m]
  std::vector<JointedRobot::Lever> levers_of_a, levers_of_b;  // the second: none for obstacles
};

class PairLook {
 public:
  PairLook(const Pair& pair, Motion* motion) : pair_(pair), motion_(*motion) {}

  double About(double t) const { return Hint(motion_.At(t)).distance; }

  Part operator()(double from, double to) const {
    Part part{.from = from, .to = to};
    const double t = part.middle();
    const Motion::Frames& frames = motion_.At(t);
    const auto moved = [&](const std::vector<JointedRobot::Lever>& levers) {
      double sum = 0.0;
      for (const JointedRobot::Lever& lever : levers) {
        sum = Above(sum + Above(motion_.Turned(lever.joint, from, to, t) * lever.reach));
      }
      return sum;
    };
    double most = moved(pair_.levers_of_a);
    if (pair_.link_b >= 0) most = std::min(most, moved(pair_.levers_of_b));
    const SeparationHint hint = Hint(frames);
    part.value = hint.distance;
    part.bound = Below(Gap(hint, frames) - most);
    return part;
  }

 private:
  SeparationHint Hint(const Motion::Frames& frames) const {
    return HintOf(pair_.a->shape, Nth(frames.about, pair_.a->link), *pair_.b,
                  pair_.link_b < 0 ? pair_.X_WB : Nth(frames.about, pair_.link_b));
  }
  double Gap(const SeparationHint& hint, const Motion::Frames& frames) const {
    return GapAlong(hint.direction, pair_.a->shape, Nth(frames.sure, pair_.a->link), *pair_.b,
                    pair_.link_b < 0 ? FrameOf(pair_.X_WB) : Nth(frames.sure, pair_.link_b));
  }

  const Pair& pair_;
  Motion& motion_;
};

bool Ignored(const TrajectoryDemands& demands, const std::string& a, const std::string& b) {
  return std::ranges::any_of(demands.ignored, [&](const auto& pair) {
    return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
  });
}

std::vector<Pair> SelfPairs(const JointedRobot& robot, const TrajectoryDemands& demands) {
  std::vector<Pair> pairs;
  const std::vector<JointedRobot::Body>& bodies = robot.bodies();
  for (size_t i = 0; i < bodies.size(); ++i) {
    for (size_t k = i + 1; k < bodies.size(); ++k) {
      const JointedRobot::Body &a = bodies[i], &b = bodies[k];
      const auto& links = robot.urdf().links;
      if (robot.AreNeighbours(a.link, b.link) ||
          Ignored(demands, Nth(links, a.link).name, Nth(links, b.link).name)) {
        continue;
      }
      pairs.push_back({.kind = Kind::kSelfClearance,
                       .subject = a.name + " - " + b.name,
                       .a = &a,
                       .b = &b.shape,
                       .link_b = b.link,
                       .levers_of_a = robot.Levers(a, b.link),
                       .levers_of_b = robot.Levers(b, a.link)});
    }
  }
  return pairs;
}

// `value(t)` is about what is kept at t.
void AddFinding(Kind kind, const std::string& subject, double demanded, const Proof& proof,
                const std::vector<double>& knots, const std::function<double(double t)>& value,
                TrajectoryCheck* check) {
  check->intervals += proof.intervals;
  TrajectoryFinding finding{.kind = kind,
                            .subject = subject,
                            .proved = proof.proved,
                            .demanded = demanded,
                            .least = proof.least,
                            .at = proof.at};
  if (!proof.proved) {
    double least = std::numeric_limits<double>::infinity();
    for (const double t : knots) least = std::min(least, value(t));
    finding.at_knots = least;
  }
  check->findings.push_back(finding);
}

void AddJoints(const Trajectory& trajectory, const JointedRobot& robot, const Motion& motion,
               const TrajectoryDemands& demands, TrajectoryCheck* check) {
  const Curves& curves = motion.curves();
  for (size_t j = 0; j < robot.urdf().joints.size(); ++j) {
    const UrdfJoint& joint = robot.urdf().joints[j];
    const int curve = motion.CurveOf(static_cast<int>(j));
    if (curve < 0) continue;
    // `margin(range)` of all values of an interval.
    const auto add = [&](Kind kind, int order, const auto& margin) {
      const auto value = [&](double t) { return margin(curves.Range(curve, order, t, t)); };
      const Proof proof = Prove(curves.begin(), curves.end(), 0.0, [&](double from, double to) {
        Part part{.from = from, .to = to, .bound = margin(curves.Range(curve, order, from, to))};
        part.value = value(part.middle());
        return part;
      });
      AddFinding(kind, joint.name, 0.0, proof, curves.times(), value, check);
    };
    if (joint.turns_freely) {
      check->not_covered.push_back(joint.name + ": turns freely, so that no limit is asked for");
    } else {
      add(Kind::kLimits, 0, [&](const Interval& q) {
        return std::min(Beyond(q.lo, joint.lower), Beyond(joint.upper, q.hi));
      });
    }
    const auto below = [](double most) {
      return [most](const Interval& x) { return Beyond(most, x.Magnitude()); };
    };
    if (joint.max_speed > 0.0) {
      add(Kind::kSpeed, 1, below(joint.max_speed));
    } else {
      check->not_covered.push_back(joint.name + ": the URDF states no limit of speed");
    }
    if (!demands.acceleration) continue;
    if (trajectory.interpolation != Interpolation::kLinear) {
      add(Kind::kAcceleration, 2, below(*demands.acceleration));
      continue;
    }
    TrajectoryFinding jumps{.kind = Kind::kAcceleration,
                            .subject = joint.name,
                            .proved = true,
                            .least = *demands.acceleration};
    for (int k = 1; k + 1 < std::ssize(curves.times()); ++k) {
      if (curves.Jump(curve, k).Magnitude() < kSmooth) continue;
      jumps.proved = false;
      jumps.least = -std::numeric_limits<double>::infinity();
      jumps.at = Nth(curves.times(), k);
      break;
    }
    check->findings.push_back(jumps);
  }
  if (!demands.acceleration) {
    check->not_covered.push_back("accelerations: no limit is asked for (--acceleration)");
  }
}

void CheckIgnored(const JointedRobot& robot, const TrajectoryDemands& demands) {
  for (const auto& [a, b] : demands.ignored) {
    for (const std::string& name : {a, b}) {
      if (robot.urdf().FindLink(name) >= 0) continue;
      throw InputError({"--ignore: no such link: " + Quote(name)});
    }
  }
}

}  // namespace

ConvexBody BodyOfObstacle(const Obstacle& obstacle) {
  const auto refuse = [&](const std::string& what) {
    throw InputError({"obstacle " + obstacle.name + ": " + what});
  };
  if (const auto* mesh = std::get_if<TriangleMesh>(&obstacle.shape)) {
    if (mesh->cubes || mesh->hollow) refuse("is a map or hollow (valid here: solids)");
    return MakeHull(mesh->vertices);
  }
  ConvexBody body;
  std::visit(
      [&](const auto& shape) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(shape)>, TriangleMesh>) {
          body = BodyOf(shape);
        }
      },
      obstacle.shape);
  return body;
}

bool TrajectoryCheck::proved() const {
  return !stopped && std::ranges::all_of(findings, &TrajectoryFinding::proved);
}

void TrajectoryCheck::Sort() {
  std::ranges::stable_sort(findings, [](const auto& x, const auto& y) {
    if (x.kind != y.kind) return x.kind < y.kind;
    if (x.proved != y.proved) return !x.proved;
    return x.least - x.demanded < y.least - y.demanded;
  });
}

TrajectoryCheck CheckTrajectory(const Trajectory& trajectory, const JointedRobot& robot,
                                const Scene& scene, const TrajectoryDemands& demands,
                                const std::function<bool(double done)>& progress) {
  CheckIgnored(robot, demands);
  TrajectoryCheck check;
  Motion motion(trajectory, robot);
  AddJoints(trajectory, robot, motion, demands, &check);

  std::vector<Pair> pairs = SelfPairs(robot, demands);
  std::vector<ConvexBody> obstacles;
  obstacles.reserve(scene.obstacles.size());
  for (const Obstacle& obstacle : scene.obstacles) {
    if (!obstacle.rests()) {
      throw InputError({"obstacle " + obstacle.name + ": moves (valid here: obstacles that rest)"});
    }
    obstacles.push_back(BodyOfObstacle(obstacle));
  }
  for (size_t k = 0; k < obstacles.size(); ++k) {
    for (const JointedRobot::Body& body : robot.bodies()) {
      pairs.push_back({.kind = Kind::kClearance,
                       .subject = body.name + " - " + scene.obstacles[k].name,
                       .a = &body,
                       .b = &obstacles[k],
                       .X_WB = scene.obstacles[k].X_WO,
                       .error = scene.obstacles[k].motion.error,
                       .levers_of_a = robot.Levers(body, 0),
                       .levers_of_b = {}});
    }
  }
  size_t done = 0;
  for (const Pair& pair : pairs) {
    if (progress && !progress(static_cast<double>(done++) / static_cast<double>(pairs.size()))) {
      check.stopped = true;
      break;
    }
    if (pair.levers_of_a.empty()) continue;  // rigid, or fixed in the world
    const PairLook look(pair, &motion);
    const double demanded = pair.kind == Kind::kSelfClearance ? demands.self_clearance
                            : pair.error > 0.0 ? Above(demands.clearance + pair.error)
                                               : demands.clearance;
    const Proof proof = Prove(motion.curves().begin(), motion.curves().end(), demanded, look);
    AddFinding(
        pair.kind, pair.subject, demanded, proof, motion.curves().times(),
        [&look](double t) { return look.About(t); }, &check);
  }
  check.Sort();
  return check;
}

}  // namespace halfstep::checker
