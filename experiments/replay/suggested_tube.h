#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/replay/replay.h"

namespace halfstep::replay {

/// The tube within which a walk was followed in simulations. Sampled: nothing is proved by it.
struct SuggestedTube {
  int standing = 0;     ///< simulations that it covers: those in which the robot stood
  int of = 0;           ///< that were played
  bool has_zmp = true;  ///< whether the ZMP was measured (TubeGauge::has_zmp)
  /// A tube of the ZMP from here on no walk carries: half of the soles' lesser size [m].
  double most_zmp = 0.0;
  /// The largest over those that stand, each number by itself; shares and distances of contacts
  /// that were not as planned, too.
  MeasuredTube over;
};

/// Of the simulations that stood, out of so many.
SuggestedTube SuggestTube(const std::vector<MeasuredTube>& standing, int of,
                          const RobotModel& robot);

/// The tube that holds where they stood. Precondition: ReplaySetup::measures_tube.
SuggestedTube SuggestTube(const std::vector<const ReplayResult*>& played, const RobotModel& robot);

/// The keys of `smoothing.tube` as YAML, rounded up to two digits, behind each what 95 % of the
/// instants do not exceed, and what it covers as comments; lines, each with its end. Where no robot
/// stood or one was farther off than the keys take, a sentence that there is none. A ZMP that was
/// farther off than soles can hold is a comment.
std::string SuggestedTubeText(const std::string& method, const SuggestedTube& tube);

/// `suggested_tube` of the JSON output: `tube` as `smoothing.tube` has it, null where
/// there is none.
nlohmann::ordered_json SuggestedTubeJson(const SuggestedTube& tube);

}  // namespace halfstep::replay
