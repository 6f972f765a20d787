#include "experiments/run/foot_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "experiments/run/margin_words.h"
#include "planner/search/step_set.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// The robot as it stands with its feet beside each other about the origin.
Posture StandingPosture(const RobotModel& robot) {
  WalkState x = WalkState::Zero();
  x[kLeftY] = 0.5 * robot.standing_width;
  x[kRightY] = -0.5 * robot.standing_width;
  return SolvePosture(robot, x);
}

// The same, moved so that one sole is at X_WF.
Posture WithSoleAt(Posture posture, size_t side, const Foothold& X_WF) {
  const Eigen::Isometry3d move = ToIsometry(X_WF) * posture.X_WSole[side].inverse();
  posture.X_WB = move * posture.X_WB;
  for (size_t s = 0; s < 2; ++s) {
    posture.X_WSole[s] = move * posture.X_WSole[s];
    for (Eigen::Isometry3d& X_WLink : posture.X_WLink[s]) X_WLink = move * X_WLink;
  }
  return posture;
}

// Places in a region, on a grid with its border and its middle.
std::vector<Eigen::Vector2d> PointsOf(const GoalRegion& goal) {
  constexpr int kHalf = 3;
  std::vector<Eigen::Vector2d> points;
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      const Eigen::Vector2d at(static_cast<double>(i) / kHalf, static_cast<double>(j) / kHalf);
      Eigen::Vector2d p_G = goal.radius * at;
      if (goal.box) {
        p_G = 0.5 * goal.box->cwiseProduct(at);
      } else if (at.norm() > 0.0) {  // the square's points, drawn into the disc
        p_G *= at.lpNorm<Eigen::Infinity>() / at.norm();
      }
      points.push_back(goal.X_WG * p_G);
    }
  }
  return points;
}

std::vector<double> YawsOf(const GoalRegion& goal) {
  constexpr int kYaws = 12;
  const double half = goal.yaw_tolerance.value_or(std::numbers::pi);
  std::vector<double> yaws;
  for (int k = 0; k < kYaws; ++k) yaws.push_back(goal.X_WG.yaw + half * (2.0 * k / kYaws - 1.0));
  yaws.push_back(goal.X_WG.yaw + (goal.yaw_tolerance ? half : 0.0));
  return yaws;
}

std::vector<Side> FeetOf(GoalPart part) {
  if (part == GoalPart::kLeftFoot) return {Side::kLeft};
  if (part == GoalPart::kRightFoot) return {Side::kRight};
  return {Side::kLeft, Side::kRight};
}

}  // namespace

FootPlaces::FootPlaces(const MarginEvaluator& evaluator)
    : evaluator_(evaluator),
      areas_(evaluator.scene(), evaluator.robot().sole_outline),
      standing_(StandingPosture(evaluator.robot())) {}

FootPlace FootPlaces::At(Side side, const Foothold& X_WF) const {
  constexpr double kNear = 0.3;  // [m]
  const auto s = static_cast<size_t>(Index(side));
  FootPlace place{.clearance = std::numeric_limits<double>::infinity()};
  place.on_area = !areas_.Clears(X_WF.Planar(), limits().demanded_of(MarginFamily::kNoStep));
  if (standing_.reachable && scene().rests()) {
    const Posture posture = WithSoleAt(standing_, s, X_WF);
    MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
    for (size_t b = 0; b < robot().bodies.size(); ++b) {
      const RobotBody& body = robot().bodies[b];
      if (body.leg != Index(side) || body.link != 5) continue;
      const Margin margin = evaluator_.clearances().OfBody(b, posture, 0.0, kNear, &scratch.bodies);
      if (margin.other < 0 || margin.value >= place.clearance) continue;
      place.clearance = margin.value;
      place.obstacle = scene().NameOf(margin.other);
    }
  }
  place.free = !place.on_area && place.clearance >= limits().demanded_of(MarginFamily::kClearance);
  return place;
}

std::string GoalWithoutPlace(const GoalRegion& goal, const FootPlaces& places) {
  if (places.scene().obstacles.empty() && places.scene().no_step.empty() &&
      !HasLevels(*places.scene().ground)) {
    return "";
  }
  const double half_width = 0.5 * places.robot().standing_width;
  const Ground& ground = *places.scene().ground;
  int tried = 0;
  bool all_on_area = true;
  std::map<std::string, int> obstacles;
  for (const Eigen::Vector2d& point : PointsOf(goal)) {
    for (const double yaw : YawsOf(goal)) {
      bool free = goal.part == GoalPart::kMidFeet, on_area = false;
      for (const Side side : FeetOf(goal.part)) {
        Pose2 X_WF{point.x(), point.y(), yaw};
        if (goal.part == GoalPart::kMidFeet) {
          X_WF = X_WF * Pose2{0.0, side == Side::kLeft ? half_width : -half_width, 0.0};
        }
        const auto stands = ground.Standing(places.robot().sole_outline, X_WF);
        if (!stands) {
          ++obstacles["an edge of the ground"];
          all_on_area = false;
          if (goal.part == GoalPart::kMidFeet) free = false;
          continue;
        }
        const FootPlace place = places.At(side, *stands);
        free = goal.part == GoalPart::kMidFeet ? free && place.free : free || place.free;
        on_area = on_area || place.on_area;
        if (!place.free && place.obstacle) ++obstacles[*place.obstacle];
      }
      if (free) return "";
      ++tried;
      all_on_area = all_on_area && on_area;
    }
  }
  std::string by = all_on_area ? "no-step areas" : "";
  if (!all_on_area) {
    const auto most =
        std::ranges::max_element(obstacles, {}, [](const auto& named) { return named.second; });
    by = (most == obstacles.end() ? "no-step areas" : most->first) +
         (obstacles.size() > 1 ? " and others" : "");
  }
  return Formatted("goal: of %d places of a sole in it that were tried none is free: ", tried) +
         by + (all_on_area || obstacles.size() > 1 ? " are" : " is") + " in the way";
}

}  // namespace halfstep
