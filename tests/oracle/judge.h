#pragma once

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/scene/scene.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/walk_truth.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {
struct ForgeryTally;
}

namespace halfstep::oracle {

/// What a control has the oracle take for true of a walk over levels, each by a little.
enum class OracleMistake {
  kNone,
  kRisersNearer,  ///< all solids 5 mm larger, for a robot of HRP-2's size
  kEdgesNearer,   ///< 1 mm smaller
  kTreadsHigher,  ///< by 1 mm
  kTreadsLower,   ///< by 1 mm
  kWaistLater,    ///< its height changes a twentieth of T later
  kFlatShadows,   ///< both soles at one height, in shadows
  kFlatFriction,  ///< in friction
  kFlatLoads,     ///< in what each foot carries
};
inline constexpr int kNumOracleMistakes = 9;

/// What came out for one family of margins.
struct FamilyTally {
  long statements = 0;  ///< of certified answers that were sampled, each for a whole walk
  long pushed = 0;      ///< certified with next to nothing to spare
  long falsified = 0;   ///< claims that were made false on purpose
  long found = 0;       ///< of these, by the oracle
  double least_spare = std::numeric_limits<double>::infinity();  ///< over what was demanded [unit]
  double disagreement = 0;  ///< of the oracle's and the project's value at an instant [unit]
  std::string where;        ///< the largest of these is
  void Add(const FamilyTally& other);
};

/// What came out for one kind of scene.
struct Tally {
  long walks = 0;                                   ///< drawn, each asked several times
  long refused = 0;                                 ///< scenes that the project does not read
  long certified = 0, violated = 0, undecided = 0;  ///< answers
  long judged = 0;                                  ///< certified answers that were sampled
  long idle = 0;                                    ///< walks without one
  long false_certified = 0, false_violated = 0;
  long instants = 0;                            ///< that the oracle looked at
  std::map<std::string, FamilyTally> families;  ///< by name
  std::map<std::string, FamilyTally> tubes;     ///< what motions of a tube keep, by family
  std::vector<std::string> missed;              ///< falsified claims that the oracle did not find
  void Add(const Tally& other);
};

/// A tally's numbers in one line of text, and back; texts are left out.
std::string ToLine(const Tally& tally);
Tally ToTally(const std::string& line);

/// Asks the project about drawn walks and judges its answers by the oracle. A certified walk is
/// pushed to its limit: overlaps are raised until it is refused, then what is demanded of one
/// family after the other. The last certified and the refused answers are judged. Three of the
/// families that a tube covers are asked in tubes that widen until they are refused, and the oracle
/// looks for a motion of the widest certified one that misses what is demanded.
class Judge {
 public:
  /// `tolerance` [the margin's unit; of the limit where there is one]: what a sampled margin may
  /// fall short by; both sides round, positions of 900 m to 1e-13 m, joint speeds near a stretched
  /// knee to 1e-11 rad/s.
  explicit Judge(const std::string& robot_yaml, double tolerance = 1e-9)
      : Judge(robot_yaml, robot_yaml, tolerance) {}
  /// The oracle reads another file than the project: a control, for there are falsehoods then.
  Judge(const std::string& robot_yaml, const std::string& plain_yaml, double tolerance);
  /// The oracle is mistaken: another control.
  Judge(const std::string& robot_yaml, OracleMistake mistake) : Judge(robot_yaml) {
    mistake_ = mistake;
  }

  /// One walk in a scene of that kind. `folder` gets the scene's files. Falsehoods are described in
  /// `falsehoods`, enough to draw them again from the seed.
  Tally JudgeOne(SceneKind kind, unsigned seed, const std::string& folder,
                 std::vector<std::string>* falsehoods) const;

  /// The same of the walk's first step and one family alone, without overlaps. Quicker.
  Tally JudgeFamily(MarginFamily family, SceneKind kind, unsigned seed, const std::string& folder,
                    std::vector<std::string>* falsehoods) const;

  /// Certificates of such a walk that are made wrong, asked of `halfstep check`
  /// (tests/checker/forged_certificates.h).
  checker::ForgeryTally Forge(SceneKind kind, unsigned seed, int rounds, const std::string& folder,
                              std::vector<std::string>* falsehoods) const;

  const PlainRobot& plain() const { return plain_; }
  const RobotModel& robot() const { return robot_; }

 private:
  struct Case;
  Case DrawCase(SceneKind kind, unsigned seed, Draw* draw, Draw* further,
                std::vector<std::string>* falsehoods) const;
  bool FindFeasible(const std::string& folder, Case* drawn, Tally* tally) const;
  void RaiseOverlaps(Case* drawn, Tally* tally) const;
  void JudgeCertified(const Case& drawn, const MarginLimits& limits,
                      const std::map<std::string, TrueMargin>& least, const WalkTruth& truth,
                      Tally* tally) const;
  void JudgeViolated(const Case& drawn, const MarginLimits& limits, const Margin& witness,
                     WalkTruth* truth, Tally* tally) const;
  void Compare(const Case& drawn, std::span<const MarginFamily> families, WalkTruth* truth,
               Tally* tally) const;
  Feasibility Ask(const Case& drawn, const MarginLimits& limits,
                  std::optional<MarginFamily> only) const;
  void Count(const Feasibility& answer, Tally* tally) const;
  void PushTubes(const Case& drawn, WalkTruth* truth, Draw* draw, Tally* tally) const;
  void PushTube(const Case& drawn, MarginLimits limits, MarginFamily family, WalkTruth* truth,
                Draw* draw, Tally* tally) const;
  void Push(const Case& drawn, MarginFamily family, WalkTruth* truth, Tally* tally) const;
  double ToleranceOf(MarginFamily family) const;
  void LimitOverLevels(Draw* draw, Case* drawn) const;
  // As the oracle sees them.
  WalkPlan Seen(const WalkPlan& plan) const;
  PlainScene Seen(const PlainScene& scene) const;
  Demands Seen(const Case& drawn) const;

  PlainRobot plain_;
  RobotModel robot_;
  double tolerance_;
  OracleMistake mistake_ = OracleMistake::kNone;
};

}  // namespace halfstep::oracle
