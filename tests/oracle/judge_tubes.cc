// What is certified of all motions within a tube, judged.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/oracle/judge.h"
#include "tests/oracle/judge_case.h"
#include "tests/oracle/project_side.h"

namespace halfstep::oracle {
namespace {

// By smoothing/README.md, "Tubes".
constexpr std::array kInTube = {MarginFamily::kFloor,      MarginFamily::kJoint,
                                MarginFamily::kJointSpeed, MarginFamily::kSelfClearance,
                                MarginFamily::kClearance,  MarginFamily::kGround,
                                MarginFamily::kNoStep,     MarginFamily::kZmpRobot};

PlainTube DrawTube(double size, Draw* draw) {
  const auto some = [draw](double most) {
    return draw->Chance(0.1) ? 0 : draw->Logarithmic(most / 20, most);
  };
  const double degree = std::numbers::pi / 180;
  PlainTube tube;
  tube.foot = some(0.01 * size);
  tube.foot_turn = some(degree);
  tube.waist = some(0.01 * size);
  tube.waist_turn = some(degree);
  tube.joint = some(0.02);
  tube.joint_speed = some(0.3);
  tube.zmp = some(0.01 * size);
  return tube;
}

}  // namespace

void Judge::PushTubes(const Case& drawn, WalkTruth* truth, Draw* draw, Tally* tally) const {
  // In half of the walks nothing is demanded beyond the tube.
  MarginLimits limits = drawn.limits;
  if (draw->Chance(0.5)) {
    for (const MarginFamily family : {MarginFamily::kFloor, MarginFamily::kSelfClearance,
                                      MarginFamily::kClearance, MarginFamily::kZmpRobot}) {
      limits.demanded_of(family) = 0;
    }
  }
  truth->Demand(ToDemands(limits, drawn.plain_scene.friction));
  const int first = draw->Below(static_cast<int>(kInTube.size()));
  for (size_t k = 0; k < 3; ++k) {
    const MarginFamily family = kInTube[(static_cast<size_t>(first) + k) % kInTube.size()];
    PushTube(drawn, limits, family, truth, draw, tally);
  }
}

// Widens a tube as long as a family's statements are certified in it.
void Judge::PushTube(const Case& drawn, MarginLimits limits, MarginFamily family, WalkTruth* truth,
                     Draw* draw, Tally* tally) const {
  const std::string name(Name(family));
  if (truth->CountOf(name) == 0) return;
  PlainTube tube = DrawTube(plain_.size(), draw);
  if (family == MarginFamily::kJoint) {  // whose share is joint alone: all else makes way for it
    tube.foot = tube.waist = 0.1 * plain_.size();
    tube.foot_turn = tube.waist_turn = 0.2;
    tube.joint = draw->Uniform(0.02, 0.1);
  } else if (family == MarginFamily::kJointSpeed) {
    tube.joint_speed = draw->Uniform(0.2, 1);
  }
  const double demanded = limits.demanded_of(family);
  for (const MarginFamily other : kInTube) {  // so that the tube asks nothing of these
    if (other != family) limits.demanded_of(other) = -1000;
  }
  bool violated = false;  // else the proof ended before the truth did
  const auto certified = [&](double times) {
    limits.tube = ToTube(tube.Scaled(times));
    const Feasibility answer = Ask(drawn, limits, family);
    Count(answer, tally);
    if (answer.verdict == Verdict::kFeasible) return true;
    violated = answer.verdict == Verdict::kViolated;
    return false;
  };
  double widest = 0, refused = 16;
  for (double times = 8; widest == 0 && times > 0.02; times *= 0.5) {
    (certified(times) ? widest : refused) = times;
  }
  if (widest == 0) return;
  while (refused < 16 && refused > 1.02 * widest) {
    const double times = std::sqrt(widest * refused);
    (certified(times) ? widest : refused) = times;
  }
  constexpr int kTries = 9;
  FamilyTally& its = tally->tubes[name];
  ++tally->judged;
  its.statements += truth->CountOf(name);
  its.pushed += refused < 16;
  const TrueMargin found = truth->InTube(name, tube.Scaled(widest), kTries, draw);
  its.least_spare = std::min(its.least_spare, found.value - demanded);
  if (!(found.value >= demanded - ToleranceOf(family))) {
    ++tally->false_certified;
    char text[300];
    std::snprintf(text, sizeof text,
                  "in a tube: %s of %s is %.12g, demanded %.12g, at t = %.9f s, %g of the tube",
                  name.c_str(), found.subject.c_str(), found.value, demanded, found.t, widest);
    drawn.Tell(text);
  }
  if (refused == 16 || !violated) return;
  // The same claim of a wider tube is false, and found.
  ++its.falsified;
  its.found += truth->InTube(name, tube.Scaled(8 * widest), kTries, draw).value < demanded;
}

}  // namespace halfstep::oracle
