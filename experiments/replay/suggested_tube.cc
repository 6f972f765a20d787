#include "experiments/replay/suggested_tube.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/config/smoothing_config.h"
#include "experiments/run/json_fields.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep::replay {
namespace {

using nlohmann::ordered_json;

// Two significant digits, no less than the value.
double RoundedUp(double value) {
  if (value == 0.0) return 0.0;
  double unit = 0.1;  // of the second digit
  while (unit > 0.1 * value) unit /= 10.0;
  while (unit * 100.0 <= value) unit *= 10.0;
  return Shortened(std::ceil(value / unit) * unit, 3);
}

// The keys of smoothing.tube.
ordered_json KeysOf(Tube tube) {
  return halfstep::JsonOf([&tube](Fields& fields) { DeclareTube(fields, &tube); });
}

ordered_json RoundedUp(ordered_json keys) {
  for (auto& [key, value] : keys.items()) value = RoundedUp(value.get<double>());
  return keys;
}

// The tube as it is suggested.
ordered_json KeysToPaste(const SuggestedTube& tube) {
  ordered_json keys = RoundedUp(KeysOf(tube.over.largest));
  if (!tube.has_zmp || keys["zmp_m"] >= tube.most_zmp) keys.erase("zmp_m");
  return keys;
}

// "" or why there is no tube.
std::string WhyNone(const SuggestedTube& tube) {
  if (tube.standing == 0) return "the robot falls in every simulation";
  const ordered_json widest = KeysOf(WidestTube());
  const ordered_json keys = KeysToPaste(tube);
  for (const auto& [key, value] : keys.items()) {
    if (value <= widest[key]) continue;
    return key + " would be " + ShortestText(value.get<double>()) + " (valid: 0 … " +
           ShortestText(widest[key].get<double>()) + ")";
  }
  return "";
}

}  // namespace

SuggestedTube SuggestTube(const std::vector<MeasuredTube>& standing, int of,
                          const RobotModel& robot) {
  SuggestedTube tube{.standing = static_cast<int>(standing.size()),
                     .of = of,
                     .has_zmp = robot.masses.known(),
                     .most_zmp = 0.5 * robot.sole_size.minCoeff(),
                     .over = {}};
  for (const MeasuredTube& one : standing) {
    for (double Tube::*const part : kTubeParts) {
      tube.over.most.*part = std::max(tube.over.most.*part, one.most.*part);
      tube.over.largest.*part = std::max(tube.over.largest.*part, one.largest.*part);
    }
    tube.over.beside = std::max(tube.over.beside, one.beside);
    tube.over.zmp_beside = std::max(tube.over.zmp_beside, one.zmp_beside);
  }
  return tube;
}

SuggestedTube SuggestTube(const std::vector<const ReplayResult*>& played, const RobotModel& robot) {
  std::vector<MeasuredTube> standing;
  for (const ReplayResult* one : played) {
    if (one->stayed_up) standing.push_back(one->tube.value());
  }
  return SuggestTube(standing, static_cast<int>(played.size()), robot);
}

std::string SuggestedTubeText(const std::string& method, const SuggestedTube& tube) {
  if (const std::string why = WhyNone(tube); !why.empty()) {
    return method + ": no tube is suggested: " + why + "\n";
  }
  std::string text =
      "# " + method +
      Formatted(
          ": farthest from the plan every 5 ms in %d of %d simulations%s; behind it, "
          "what 95 %% of the time stays within\n",
          tube.standing, tube.of, tube.standing < tube.of ? " (it falls in the others)" : "");
  text += "smoothing:\n  tube:\n";
  const ordered_json keys = KeysToPaste(tube), most = RoundedUp(KeysOf(tube.over.most));
  const auto line = [&most](const std::string& key, double value) {
    return key + ": " + ShortestText(value) + "  # " + ShortestText(most[key].get<double>());
  };
  for (const auto& [key, value] : keys.items()) {
    text += "    " + line(key, value.get<double>()) + "\n";
  }
  if (!tube.has_zmp) text += "    # no zmp_m: the robot's masses are not known\n";
  if (tube.has_zmp && !keys.contains("zmp_m")) {
    text += "    # " + line("zmp_m", RoundedUp(tube.over.largest.zmp)) +
            ": more than soles hold, so nothing is certified of the ZMP off the plan\n";
  }
  text +=
      "# The plan is put where the robot stands when it begins; what soles drift from then on "
      "counts.\n"
      "# Not covered: other disturbances, what is between 5 ms, and another walk, such as this "
      "one\n"
      "# smoothed again with the tube. Instants of contact are the plan's in a tube";
  if (!tube.has_zmp) return text + ".\n";
  return text + Formatted(
                    ": where they were not, for up to %.1f %% of\n"
                    "# the time, the ZMP is not covered; it was off by up to %.0f mm.\n",
                    100 * tube.over.beside, 1e3 * tube.over.zmp_beside);
}

ordered_json SuggestedTubeJson(const SuggestedTube& tube) {
  const std::string why = WhyNone(tube);
  ordered_json json = {{"stands", tube.standing}, {"of", tube.of}};
  json["tube"] = why.empty() ? KeysToPaste(tube) : ordered_json(nullptr);
  if (!why.empty()) json["why_none"] = why;
  json["largest"] = KeysOf(tube.over.largest);
  json["most"] = KeysOf(tube.over.most);
  if (!tube.has_zmp) return json;
  json["contacts_not_planned_share"] = tube.over.beside;
  json["zmp_largest_then_m"] = tube.over.zmp_beside;
  return json;
}

}  // namespace halfstep::replay
