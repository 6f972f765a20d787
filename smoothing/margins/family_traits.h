#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/scene/scene.h"
#include "smoothing/margins/margin.h"
#include "smoothing/margins/tube_shift.h"
#include "wpg/robot/not_covered.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What the values of a family need, from little work to much. Families that need little are asked
/// first, so that most violations are found with little work.
enum class MarginCost : int {
  kWalk,         ///< the superposed quantities
  kPosture,      ///< joint angles
  kJointSpeeds,  ///< joint speeds, poses of links
  kObstacles,    ///< distances of bodies to obstacles
  kPairs,        ///< distances of bodies to each other
};

/// A margin as a sentence, for people. It may name {family}, {subject}, the {amount} with its unit,
/// and of a subject like "RLEG_LINK5 - bar" the {first} and the {second}.
struct MarginSentence {
  std::string_view inside;  ///< for values ≥ 0
  std::string_view beyond;  ///< for values < 0
};
/// That of families that keep something inside a limit.
inline constexpr MarginSentence kOfALimit = {"{family} of {subject}: {amount} inside its limit",
                                             "{family} of {subject}: {amount} beyond its limit"};

/// Why a family cannot be told where its margin is −∞.
struct Untold {
  std::string_view at_instant;  ///< " cannot be told, since …,", as MarginEvaluator::Describe says
  std::string_view of_plan;     ///< the same of a plan, in few words: " cannot be told: …"
};
/// That of families that need the legs' joints.
inline constexpr Untold kNeedsLegs = {
    " cannot be told, since a leg does not reach or is stretched,",
    " cannot be told: a leg does not reach"};
/// That of families that also need what the floor gives.
inline constexpr Untold kNeedsGround = {
    " cannot be told, since the soles cannot give what the motion needs or a leg does not reach,",
    kNeedsLegs.of_plan};

/// Why a robot's files do not let anything be demanded of a family, as a sentence without subject;
/// "" where they let it be. A function that no family can leave out.
class DemandFault {
 public:
  using Function = std::string (*)(const RobotModel& robot);         ///< gives the sentence
  constexpr DemandFault(Function function) : function_(function) {}  ///< as which it is written
  std::string operator()(const RobotModel& robot) const { return function_(robot); }  ///< tells it

 private:
  Function function_;
};
/// Of families that any robot lets be demanded.
inline std::string AlwaysDemandable(const RobotModel&) { return ""; }
/// Of families that need the masses of all links.
inline std::string NeedsMasses(const RobotModel& robot) { return robot.masses.fault; }

/// What a family assumes where robot or scene do not say it, as a certificate lists it.
using Assumption = std::optional<NotCovered> (*)(const RobotModel& robot, const Scene& scene);
/// Of families that assume nothing.
inline std::optional<NotCovered> AssumesNothing(const RobotModel&, const Scene&) {
  return std::nullopt;
}

/// By how much the margins of a family may be less anywhere in a tube than on the plan [its unit];
/// 0 where they have lost it already, each its own share (TubeLevers). Source: smoothing/README.md,
/// "Tubes".
using TubeShare = double (*)(const TubeShift& shift);

/// What a certificate does not cover of a family.
struct FamilyCoverage {
  DemandFault why_not_demandable;  ///< of a robot
  /// The limit without which every margin is +∞, where a config may say that there is none.
  std::optional<double> MarginLimits::*limit = nullptr;
  Assumption assumes = AssumesNothing;  ///< of robot and scene
  /// Whether a config has to ask for it, so that it is not missed where none does.
  bool on_request = false;
};
/// That of families that every robot, config and scene has all for.
inline constexpr FamilyCoverage kAlwaysCovered = {.why_not_demandable = AlwaysDemandable};
/// That of families that every robot has, and a config has to ask for.
inline constexpr FamilyCoverage kCoveredOnRequest = {.why_not_demandable = AlwaysDemandable,
                                                     .on_request = true};
/// That of families that need the masses of all links.
inline constexpr FamilyCoverage kCoveredWithMasses = {.why_not_demandable = NeedsMasses};

/// What the margins of a walk rest on beside the walk itself.
enum class MarginScope : int {
  kRobot = 1,  ///< robot and floor
  kScene,      ///< also what is known of the scene, which may change while one walks
};

/// What a family is called and how it is used. Each class of a family has one as `kTraits`, which
/// leaves out nothing that has no default here (IsComplete).
struct FamilyTraits {
  MarginFamily family;       ///< of which this is told
  std::string_view name;     ///< in YAML, CSV and certificates
  std::string_view unit;     ///< "m", "rad" …; "1" for a pure number
  std::string_view key;      ///< under `smoothing.margins`: the name and, by its unit, an ending
  std::string_view meaning;  ///< of the key
  std::string_view remedy;   ///< what may help a planned motion that misses the demand
  MarginSentence sentence;   ///< what its values say
  FamilyCoverage coverage;   ///< what is not covered of it
  MarginScope scope;         ///< on what it rests
  double scale;              ///< what counts as a clear change of the margin [its unit]
  double demanded;           ///< by default [its unit]
  bool raised;      ///< whether the program `safest` raises it, not only keeps what is demanded
  MarginCost cost;  ///< what an evaluation needs
  /// The family whose row of the program it shares, mostly itself; none when no parameter moves the
  /// margin, so that it has no row.
  std::optional<MarginFamily> row;
  bool may_be_none = false;  ///< whether it can be left out: then nothing is demanded of it
  double most = 0.5;         ///< that may be demanded [its unit]
  /// Whether some robots or configs do not have it (MarginStatements::present): then a config that
  /// is written back has its key only where something else than `demanded` is demanded.
  bool may_be_absent = false;
  Untold untold = kNeedsLegs;   ///< where it is −∞
  TubeShare in_tube = nullptr;  ///< null: what is certified of it is about the planned motion alone
  /// Of margins that have a second subject (Margin::other); empty: as `sentence`.
  MarginSentence of_two = {};
};

/// Whether traits leave out nothing that has no default.
constexpr bool IsComplete(const FamilyTraits& t) {
  const bool named = !t.name.empty() && !t.unit.empty() && t.key.starts_with(t.name);
  const bool told = !t.meaning.empty() && !t.remedy.empty() && !t.sentence.inside.empty() &&
                    !t.sentence.beyond.empty();
  return named && told && t.scope != MarginScope{} && t.scale > 0.0;
}

/// The traits of a family.
const FamilyTraits& Traits(MarginFamily family);

}  // namespace halfstep
