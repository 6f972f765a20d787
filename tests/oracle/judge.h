#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "planner/scene/scene.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/walk_truth.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::oracle {

/// What came out for one kind of scene.
struct Tally {
  long walks = 0;                                   ///< drawn, each asked several times
  long refused = 0;                                 ///< scenes that the project does not read
  long certified = 0, violated = 0, undecided = 0;  ///< answers
  long judged = 0;                                  ///< certified answers that were sampled
  long false_certified = 0, false_violated = 0;
  double least_clearance = std::numeric_limits<double>::infinity();  ///< over what was demanded [m]
  double least_slack = std::numeric_limits<double>::infinity();      ///< of any family [its scale]
  long instants = 0;                                                 ///< that the oracle looked at
  void Add(const Tally& other);
};

/// Asks the project about drawn walks and judges its answers by the oracle. A certified walk is
/// pushed to its limit: overlaps are raised until it is refused, then what is demanded of one
/// family. The last certified and the refused answers are judged.
class Judge {
 public:
  /// `tolerance` [the margin's unit]: what a sampled margin may fall short by; both sides round,
  /// positions of 900 m to 1e-13 m, joint speeds near a stretched knee to 1e-11 rad/s.
  explicit Judge(const std::string& robot_yaml, double tolerance = 1e-9);

  /// One walk in a scene of that kind. `folder` gets the scene's files. Falsehoods are described in
  /// `falsehoods`, enough to draw them again from the seed.
  Tally JudgeOne(SceneKind kind, unsigned seed, const std::string& folder,
                 std::vector<std::string>* falsehoods) const;

  const PlainRobot& plain() const { return plain_; }
  const RobotModel& robot() const { return robot_; }

 private:
  struct Case;
  void JudgeCertified(const Case& drawn, const WalkPlan& plan, const MarginLimits& limits,
                      Tally* tally) const;
  void JudgeViolated(const Case& drawn, const WalkPlan& plan, const MarginLimits& limits,
                     const Margin& witness, Tally* tally) const;
  Feasibility Ask(const Case& drawn, const WalkPlan& plan, const MarginLimits& limits,
                  Tally* tally) const;
  void PushDemands(const Case& drawn, const WalkPlan& plan, MarginLimits limits, Draw* draw,
                   Tally* tally) const;

  PlainRobot plain_;
  RobotModel robot_;
  double tolerance_;
};

/// The plan as the project takes it.
HalfStepSequence ToSequence(const WalkPlan& plan);
HomotopyParameters ToParameters(const WalkPlan& plan);

}  // namespace halfstep::oracle
