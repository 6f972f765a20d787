#include "experiments/run/tube_words.h"

#include <numbers>

#include "experiments/run/margin_words.h"
#include "smoothing/margins/family_traits.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {

std::string TubeWords(const MarginEvaluator& evaluator) {
  const MarginLimits& limits = evaluator.limits();
  const Tube& tube = limits.tube;
  if (tube == Tube{}) return "";
  const auto degrees = [](double angle) {
    return Formatted("%.3g deg", angle * 180.0 / std::numbers::pi);
  };
  std::string text = "tube: soles within " + Amount(tube.foot, "m") + " and " +
                     degrees(tube.foot_turn) + " of the plan, waist " + Amount(tube.waist, "m") +
                     " and " + degrees(tube.waist_turn) + ", leg joints " +
                     Amount(tube.joint, "rad") + " and " + Amount(tube.joint_speed, "rad/s") +
                     ", ZMP " + Amount(tube.zmp, "m") + "\n  it raises what is demanded of ";
  std::string separator;
  for (const MarginFamily family : evaluator.families()) {
    const double by = Nth(limits.raised, family);
    if (by == 0.0 || limits.demanded_of(family) == kNotDemanded) continue;
    text += separator + std::string(Name(family)) + " by " + Amount(by, Unit(family));
    separator = ", ";
  }
  const TubeShift shift(evaluator.robot(), tube);
  return text + "; it takes up to " + Amount(shift.body, "m") + " from the clearance of a body, " +
         Amount(shift.pair, "m") + " from that of a pair\n";
}

}  // namespace halfstep
