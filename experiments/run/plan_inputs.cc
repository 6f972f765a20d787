#include "experiments/run/plan_inputs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "experiments/run/foot_places.h"
#include "experiments/run/margin_words.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string FootName(Side side) { return std::string(Name(side)) + " foot"; }
std::string StepName(size_t index, Side side) {
  return Formatted("footstep %zu (%s)", index + 1, std::string(Name(side)).c_str());
}

// A footstep as it is taken.
struct Taken {
  Side side;
  Foothold X_SF;  // seen from the foot that carries
};

std::vector<Taken> StepsOf(const std::vector<Footstep>& footsteps, std::array<Foothold, 2> feet,
                           bool exchanged) {
  std::vector<Taken> steps;
  for (const Footstep& footstep : footsteps) {
    const Side side = exchanged ? Opposite(footstep.side) : footstep.side;
    const Foothold& X_WS = Nth(feet, Index(Opposite(side)));
    steps.push_back({side, X_WS.Inverse() * footstep.X_WF});
    Nth(feet, Index(side)) = footstep.X_WF;
  }
  return steps;
}

// How far on its own side of the other foot a foot is [m]; below 0 it is on the other's.
double OwnSide(Side side, const Foothold& X_SF) { return side == Side::kLeft ? X_SF.y : -X_SF.y; }

// Feet on the wrong side, and whether exchanging left and right mends it.
class Sides {
 public:
  Sides(const std::vector<Footstep>& footsteps, const RobotModel& robot,
        const std::array<Foothold, 2>& start)
      : footsteps_(footsteps), robot_(robot), start_(start) {}

  std::string Sentence() const {
    const auto first = First(start_, /*exchanged=*/false);
    if (!first) return "";
    std::string text = *first;
    const std::array<Foothold, 2> swapped = {start_[1], start_[0]};
    const char* mended = nullptr;
    if (!First(start_, true)) {
      mended = "`footsteps`";
    } else if (!First(swapped, false)) {
      mended = "`start`";
    } else if (!First(swapped, true)) {
      mended = "`start` and `footsteps`";
    }
    if (mended != nullptr) {
      text += std::string("; left and right look exchanged in ") + mended;
    }
    return text;
  }

 private:
  // The first foot on the wrong side of the other one, or in line with it.
  std::optional<std::string> First(const std::array<Foothold, 2>& start, bool exchanged) const {
    constexpr double kInLine = 0.3;  // of the standing width: no foot is set down so near
    const double least = kInLine * robot_.standing_width;
    const double apart = OwnSide(Side::kLeft, start[1].Inverse() * start[0]);
    if (apart < least) return "start: the left foot is " + Where(Side::kLeft, apart);
    const std::vector<Taken> steps = StepsOf(footsteps_, start, exchanged);
    for (size_t i = 0; i < steps.size(); ++i) {
      const double own = OwnSide(steps[i].side, steps[i].X_SF);
      if (own < least) return StepName(i, steps[i].side) + " is " + Where(steps[i].side, own);
    }
    return std::nullopt;
  }
  static std::string Where(Side side, double own) {
    const std::string other = "the " + FootName(Opposite(side));
    const std::string hand(Name(own < 0.0 ? Opposite(side) : side));
    return Formatted("%.3g m to the %s of ", std::abs(own), hand.c_str()) + other;
  }

  const std::vector<Footstep>& footsteps_;
  const RobotModel& robot_;
  const std::array<Foothold, 2>& start_;
};

void AddSides(const std::vector<Footstep>& footsteps, const RobotModel& robot,
              const std::array<Foothold, 2>& start, std::vector<std::string>* lines) {
  const std::string sentence = Sides(footsteps, robot, start).Sentence();
  if (!sentence.empty()) lines->push_back(sentence);
}

// Of feet that no leg reaches: in which unit they would be near.
std::string UnitHint(double distance, double reach) {
  for (const auto& [unit, metre] : {std::pair{"centimetres", 100.0}, {"millimetres", 1000.0}}) {
    if (distance / metre > reach || distance / metre < 0.05 * reach) continue;
    return Formatted("; in %s it would be %.3g m (x_m and y_m are in metres)", unit,
                     distance / metre);
  }
  return "";
}

void AddReach(const Experiment& experiment, const std::array<Foothold, 2>& start,
              const std::vector<Taken>& steps, std::vector<std::string>* lines) {
  const RobotMeasures measures = MeasuresOf(experiment.robot);
  // Both legs stretched away from each other, which no walk does.
  const double reach = 2.0 * measures.leg_length + measures.standing_width;
  const auto add = [&](const std::string& who, double distance) {
    if (distance <= reach) return false;
    lines->push_back(who +
                     Formatted(" %.3g m away, and the legs of %s are %.2g m long", distance,
                               experiment.robot.name.c_str(), measures.leg_length) +
                     UnitHint(distance, reach));
    return true;
  };
  if (add("start: the feet are",
          (start[0].Planar().position() - start[1].Planar().position()).norm()))
    return;
  for (size_t i = 0; i < steps.size(); ++i) {
    const std::string who =
        StepName(i, steps[i].side) + " lands beside the " + FootName(Opposite(steps[i].side));
    if (add(who, steps[i].X_SF.Planar().position().norm())) return;  // the next ones follow from it
  }
}

// By how much a hip turns at most about the vertical, either way [rad]; none: it has no such axis.
std::optional<double> HipTurn(const RobotModel& robot) {
  constexpr double kUpright = 0.9;
  double turn = 0.0;
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) {
      if (std::abs(joint.axis_B.z()) < kUpright) continue;
      turn = std::max({turn, std::abs(joint.lower), std::abs(joint.upper)});
    }
  }
  return turn > 0.0 ? std::optional(turn) : std::nullopt;
}

void AddTurns(const RobotModel& robot, const std::vector<Taken>& steps,
              std::vector<std::string>* lines) {
  const std::optional<double> hip = HipTurn(robot);
  if (!hip) return;
  for (size_t i = 0; i < steps.size(); ++i) {
    const double turn = std::abs(steps[i].X_SF.yaw);
    if (turn <= 2.0 * *hip) continue;
    lines->push_back(StepName(i, steps[i].side) +
                     Formatted(" is turned by %.3g° against the %s, and the hips of %s turn by "
                               "%.3g° each at most",
                               turn * kDegrees, FootName(Opposite(steps[i].side)).c_str(),
                               robot.name.c_str(), *hip * kDegrees));
    return;
  }
}

void AddRepeated(const std::vector<Taken>& steps, std::vector<std::string>* lines) {
  for (size_t i = 1; i < steps.size(); ++i) {
    if (steps[i].side != steps[i - 1].side) continue;
    lines->push_back(Formatted("footsteps %zu and %zu are both of the ", i, i + 1) +
                     FootName(steps[i].side) + ": is one of the " +
                     FootName(Opposite(steps[i].side)) + " missing in between?");
    return;
  }
}

void AddInside(const std::string& who, Side side, const Foothold& X_WF, const FootPlaces& places,
               std::vector<std::string>* lines) {
  const FootPlace place = places.At(side, X_WF);
  if (!place.obstacle || place.clearance >= 0.0) return;
  lines->push_back(who + " stands " + Amount(-place.clearance, "m") + " inside " + *place.obstacle);
}

void AddStartInside(const std::array<Foothold, 2>& start, const FootPlaces& places,
                    std::vector<std::string>* lines) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    AddInside("start: the " + FootName(side), side, Nth(start, Index(side)), places, lines);
  }
}

}  // namespace

std::vector<std::string> LookAtFootsteps(const Experiment& experiment,
                                         const MarginEvaluator& evaluator) {
  std::vector<std::string> lines;
  const Ground& ground = *experiment.scene.ground;
  const std::array<Foothold, 2> start = StartOf(experiment.config, experiment.robot, ground);
  const std::vector<Footstep> footsteps = FootstepsOf(experiment.config, experiment.robot, ground);
  const std::vector<Taken> steps = StepsOf(footsteps, start, /*exchanged=*/false);
  AddReach(experiment, start, steps, &lines);
  const bool far = !lines.empty();  // then sides and turns say nothing more
  AddRepeated(steps, &lines);
  if (!far) {
    AddSides(footsteps, experiment.robot, start, &lines);
    AddTurns(experiment.robot, steps, &lines);
  }
  const FootPlaces places(evaluator);
  AddStartInside(start, places, &lines);
  for (size_t i = 0; i < steps.size(); ++i) {
    AddInside(StepName(i, steps[i].side), steps[i].side, footsteps[i].X_WF, places, &lines);
  }
  return lines;
}

std::vector<std::string> LookAtGoal(const ExperimentConfig& config,
                                    const MarginEvaluator& evaluator) {
  std::vector<std::string> lines;
  const FootPlaces places(evaluator);
  const std::array<Foothold, 2> start =
      StartOf(config, evaluator.robot(), *evaluator.scene().ground);
  AddSides({}, evaluator.robot(), start, &lines);
  AddStartInside(start, places, &lines);
  const std::string goal = GoalWithoutPlace(config.goal.Region(), places);
  if (!goal.empty()) lines.push_back(goal);
  return lines;
}

}  // namespace halfstep
