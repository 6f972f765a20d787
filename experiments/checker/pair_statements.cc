#include <algorithm>
#include <memory>

#include "experiments/checker/separation.h"
#include "experiments/checker/trajectory_statements.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

// Two convex bodies, of which the first belongs to the robot.
struct Pair {
  const JointedRobot::Body* a = nullptr;
  const ConvexBody* b = nullptr;
  int link_b = -1;  // −1: at X_WB
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  std::vector<JointedRobot::Lever> levers_of_a, levers_of_b;  // the second: none for obstacles
};

class PairLook {
 public:
  PairLook(Pair pair, RobotMotion* motion) : pair_(std::move(pair)), motion_(*motion) {}

  double About(double t) const { return Hint(motion_.At(t)).distance; }

  Part operator()(double from, double to) const {
    Part part{.from = from, .to = to};
    const double t = part.middle();
    const RobotMotion::Frames& frames = motion_.At(t);
    double most = motion_.Moved(pair_.levers_of_a, from, to, t);
    if (pair_.link_b >= 0) most = std::min(most, motion_.Moved(pair_.levers_of_b, from, to, t));
    const SeparationHint hint = Hint(frames);
    part.value = hint.distance;
    part.bound = Below(Gap(hint, frames) - most);
    return part;
  }

 private:
  SeparationHint Hint(const RobotMotion::Frames& frames) const {
    return HintOf(pair_.a->shape, Nth(frames.about, pair_.a->link), *pair_.b,
                  pair_.link_b < 0 ? pair_.X_WB : Nth(frames.about, pair_.link_b));
  }
  double Gap(const SeparationHint& hint, const RobotMotion::Frames& frames) const {
    return GapAlong(hint.direction, pair_.a->shape, Nth(frames.sure, pair_.a->link), *pair_.b,
                    pair_.link_b < 0 ? FrameOf(pair_.X_WB) : Nth(frames.sure, pair_.link_b));
  }

  Pair pair_;
  RobotMotion& motion_;
};

bool Ignored(const TrajectoryDemands& demands, const std::string& a, const std::string& b) {
  return std::ranges::any_of(demands.ignored, [&](const auto& pair) {
    return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
  });
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

void AddPairs(const TrajectoryDemands& demands, const Scene& scene,
              const std::vector<ConvexBody>& obstacles, RobotMotion* motion,
              std::vector<Statement>* statements) {
  const JointedRobot& robot = motion->robot();
  CheckIgnored(robot, demands);
  const auto add = [&](TrajectoryFinding::Kind kind, const std::string& other, double demanded,
                       Pair pair) {
    if (pair.levers_of_a.empty()) return;  // rigid, or fixed in the world
    const std::string subject = pair.a->name + " - " + other;
    const auto look = std::make_shared<PairLook>(std::move(pair), motion);
    statements->push_back({.kind = kind,
                           .subject = subject,
                           .demanded = demanded,
                           .span = {motion->curves().begin(), motion->curves().end()},
                           .look = [look](double from, double to) { return (*look)(from, to); },
                           .value = [look](double t) { return look->About(t); }});
  };
  const std::vector<JointedRobot::Body>& bodies = robot.bodies();
  for (size_t i = 0; i < bodies.size(); ++i) {
    for (size_t k = i + 1; k < bodies.size(); ++k) {
      const JointedRobot::Body &a = bodies[i], &b = bodies[k];
      const auto& links = robot.urdf().links;
      if (robot.AreNeighbours(a.link, b.link) ||
          Ignored(demands, Nth(links, a.link).name, Nth(links, b.link).name)) {
        continue;
      }
      add(TrajectoryFinding::Kind::kSelfClearance, b.name, demands.self_clearance,
          {.a = &a,
           .b = &b.shape,
           .link_b = b.link,
           .levers_of_a = motion->Levers(a, b.link),
           .levers_of_b = motion->Levers(b, a.link)});
    }
  }
  for (size_t k = 0; k < obstacles.size(); ++k) {
    const Obstacle& obstacle = scene.obstacles[k];
    const double error = obstacle.motion.error;  // how far it may be from there
    for (const JointedRobot::Body& body : bodies) {
      add(TrajectoryFinding::Kind::kClearance, obstacle.name,
          error > 0.0 ? Above(demands.clearance + error) : demands.clearance,
          {.a = &body,
           .b = &obstacles[k],
           .X_WB = obstacle.X_WO,
           .levers_of_a = motion->Levers(body, -1),
           .levers_of_b = {}});
    }
  }
}

}  // namespace halfstep::checker
