#include "experiments/checker/check_trajectory.h"

#include <algorithm>
#include <limits>

#include "experiments/checker/trajectory_statements.h"
#include "wpg/files/input_error.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

using Kind = TrajectoryFinding::Kind;
constexpr double kSmooth = 1e-9;  // jumps of a velocity that are told as none [rad/s]
constexpr double kNear = 1e-6;    // how near the least limit that holds is to what is met [m, rad]

void AddJoints(const Trajectory& trajectory, const RobotMotion& motion,
               const TrajectoryDemands& demands, std::vector<Statement>* statements,
               TrajectoryCheck* check) {
  const JointedRobot& robot = motion.robot();
  const Curves& curves = motion.curves();
  for (size_t j = 0; j < robot.urdf().joints.size(); ++j) {
    const UrdfJoint& joint = robot.urdf().joints[j];
    const int curve = motion.CurveOf(static_cast<int>(j));
    if (curve < 0) continue;
    // `margin(range)` of all values of an interval.
    const auto add = [&](Kind kind, int order,
                         const std::function<double(const Interval&)>& margin) {
      const auto value = [=, &curves](double t) {
        return margin(curves.Range(curve, order, t, t));
      };
      const auto look = [=, &curves](double from, double to) {
        Part part{.from = from, .to = to, .bound = margin(curves.Range(curve, order, from, to))};
        part.value = value(part.middle());
        return part;
      };
      statements->push_back({.kind = kind,
                             .subject = joint.name,
                             .span = {curves.begin(), curves.end()},
                             .look = look,
                             .value = value,
                             .slides = joint.slides});
    };
    if (joint.turns_freely) {
      check->not_covered.push_back(joint.name + ": turns freely, so that no limit is asked for");
    } else {
      add(Kind::kLimits, 0, [&joint](const Interval& q) {
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
                            .least = *demands.acceleration,
                            .slides = joint.slides};
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

TrajectoryFinding FindingOf(const Statement& statement, const std::vector<double>& knots,
                            TrajectoryCheck* check) {
  const Proof proof = Prove(statement.span, statement.demanded, statement.look);
  check->intervals += proof.intervals;
  TrajectoryFinding finding{.kind = statement.kind,
                            .subject = statement.subject,
                            .proved = proof.proved,
                            .demanded = statement.demanded,
                            .least = proof.least,
                            .at = proof.at,
                            .slides = statement.slides};
  if (proof.proved) return finding;
  double least = std::numeric_limits<double>::infinity();
  for (const double t : knots) {
    if (statement.span.begin <= t && t <= statement.span.end) {
      least = std::min(least, statement.value(t));
    }
  }
  finding.at_knots = least;
  if (statement.most) {
    const double kept = LeastOf(statement.span, kNear, statement.look, &check->intervals);
    if (kept > -kInfinity) finding.holds = Above(*statement.most - kept);
  }
  return finding;
}

std::vector<ConvexBody> BodiesOf(const Scene& scene) {
  std::vector<ConvexBody> bodies;
  for (const Obstacle& obstacle : scene.obstacles) {
    if (!obstacle.rests()) {
      throw InputError({"obstacle " + obstacle.name + ": moves (valid here: obstacles that rest)"});
    }
    bodies.push_back(BodyOfObstacle(obstacle));
  }
  return bodies;
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
  TrajectoryCheck check;
  RobotMotion motion(trajectory, robot);
  std::vector<Statement> statements;
  AddJoints(trajectory, motion, demands, &statements, &check);
  const std::vector<ConvexBody> obstacles = BodiesOf(scene);
  AddPairs(demands, scene, obstacles, &motion, &statements);
  AddGround(demands, &motion, &statements, &check);
  AddContacts(demands, &motion, &statements, &check);
  const std::vector<Standing> standing = StandingOf(demands, motion);
  AddFloor(trajectory, demands, standing, &motion, &statements, &check);
  AddTorques(trajectory, standing, &motion, &statements, &check);
  for (size_t i = 0; i < statements.size(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(statements.size());
    check.stopped = progress && !progress(done);
    if (check.stopped) break;
    check.findings.push_back(FindingOf(statements[i], motion.curves().times(), &check));
  }
  check.Sort();
  return check;
}

}  // namespace halfstep::checker
