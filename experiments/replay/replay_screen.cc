#include "experiments/replay/replay_screen.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::replay {

using nlohmann::ordered_json;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

// "forward", "forward left" …: the eight directions of pushes.
const char* DirectionName(double direction) {
  const long eighth = std::lround(direction / (std::numbers::pi / 4));
  constexpr const char* kNames[] = {"forward", "forward left", "left",  "back left",
                                    "back",    "back right",   "right", "forward right"};
  return kNames[eighth % 8];
}

const std::string& BodyName(const Replayed& replayed, const TouchRecord& touch) {
  return Nth(replayed.bodies, touch.body);
}
const std::string& ObstacleName(const Replayed& replayed, const TouchRecord& touch) {
  return Nth(replayed.obstacles, touch.obstacle);
}

std::vector<TouchRecord> TouchesOf(const Replayed& replayed, bool at_rest) {
  std::vector<TouchRecord> touches;
  for (const TouchRecord& touch : replayed.result.touches) {
    if (touch.at_rest == at_rest) touches.push_back(touch);
  }
  return touches;
}

double GreatestForce(const std::vector<TouchRecord>& touches) {
  double force = 0.0;
  for (const TouchRecord& touch : touches) force = std::max(force, touch.force);
  return force;
}

// One line for all, then one for each pair in the order of first contact.
std::string TouchText(const Replayed& replayed, bool at_rest) {
  std::vector<TouchRecord> left = TouchesOf(replayed, at_rest);
  std::string text = std::string("  touches ") + (at_rest ? "at rest: " : "while walking: ");
  if (left.empty()) return text + "none\n";
  text += std::to_string(left.size()) + Formatted(", first at %.3f s, greatest force %.1f N\n",
                                                  left[0].begin, GreatestForce(left));
  while (!left.empty()) {
    const TouchRecord first = left.front();
    const auto other = [&first](const TouchRecord& touch) {
      return touch.body != first.body || touch.obstacle != first.obstacle;
    };
    const auto same = std::stable_partition(left.begin(), left.end(), other);
    const std::vector<TouchRecord> pair(same, left.end());
    left.erase(same, left.end());
    text += "    " + BodyName(replayed, first) + " and " + ObstacleName(replayed, first) +
            Formatted(": %zu, first at %.3f s, greatest force %.1f N\n", pair.size(), first.begin,
                      GreatestForce(pair));
  }
  return text;
}

std::string SupportText(const Replayed& replayed) {
  const SupportDrift& support = replayed.result.support;
  const auto place = [](const Eigen::Vector3d& p) {
    return Formatted("x %.1f mm, y %.1f mm, yaw %.2f deg", 1e3 * p[0], 1e3 * p[1], p[2] / kDegree);
  };
  return "  support feet off their plan: in the end " + place(support.at_end) + "; at most " +
         place(support.largest) +
         Formatted(
             "; within %.1f s this changes by at most %.1f mm; seen from them, waist and soles are "
             "off by at most %.1f mm\n",
             replayed.window, 1e3 * support.within_window, 1e3 * replayed.result.stray);
}

std::string SolesText(const ReplayResult& result) {
  return Formatted(
      "  pressure at the edge of the soles for %.1f %% of the time, at most %.2f weights, %.3f s "
      "in "
      "flight, carrying soles turn by %.2f deg\n",
      100 * result.edge_share, result.peak, result.flight, result.turn / kDegree);
}

std::string OffText(const TrackingError& off) {
  return Formatted("feet %.1f mm and %.2f deg, waist %.1f mm, joints %.2f deg", 1e3 * off.foot,
                   off.foot_yaw / kDegree, 1e3 * off.waist, off.joint / kDegree);
}

ordered_json OffJson(const TrackingError& off) {
  return {{"foot_m", off.foot},
          {"foot_yaw_rad", off.foot_yaw},
          {"waist_m", off.waist},
          {"joint_rad", off.joint}};
}

ordered_json TouchJson(const Replayed& replayed) {
  ordered_json json = ordered_json::array();
  for (const TouchRecord& touch : replayed.result.touches) {
    json.push_back({{"body", BodyName(replayed, touch)},
                    {"obstacle", ObstacleName(replayed, touch)},
                    {"begin_s", touch.begin},
                    {"end_s", touch.end},
                    {"greatest_force_n", touch.force},
                    {"at_rest", touch.at_rest}});
  }
  return json;
}

ordered_json PlaceJson(const Eigen::Vector3d& place) {
  return {{"x_m", place[0]}, {"y_m", place[1]}, {"yaw_rad", place[2]}};
}

ordered_json Json(const Replayed& replayed) {
  const ReplayResult& result = replayed.result;
  const SupportDrift& support = result.support;
  ordered_json json = {{"method", replayed.method},
                       {"duration_s", replayed.duration},
                       {"stayed_up", result.stayed_up},
                       {"ended_s", result.ended},
                       {"largest_tilt_rad", result.largest_tilt},
                       {"zmp_rms_m", result.zmp_rms},
                       {"zmp_largest_m", result.zmp_largest},
                       {"zmp_model_rms_m", result.model_rms},
                       {"zmp_model_largest_m", result.model_largest},
                       {"slip_m", result.slip},
                       {"drift_m", result.drift},
                       {"weight_share", result.weight_share},
                       {"support_drift",
                        {{"at_end", PlaceJson(support.at_end)},
                         {"largest", PlaceJson(support.largest)},
                         {"largest_shift_m", support.largest_shift},
                         {"window_s", replayed.window},
                         {"within_window_m", support.within_window}}},
                       {"stray_m", result.stray},
                       {"edge_share", result.edge_share},
                       {"peak_weights", result.peak},
                       {"flight_s", result.flight},
                       {"sole_turn_rad", result.turn}};
  if (replayed.controller) {
    json["controller"] = *replayed.controller;
    json["tracking"] = {{"most", OffJson(result.off.most)},
                        {"largest", OffJson(result.off.largest)}};
  }
  if (replayed.tube) json["suggested_tube"] = SuggestedTubeJson(*replayed.tube);
  if (!replayed.obstacles.empty()) {
    json["touches_walking"] = TouchesOf(replayed, false).size();
    json["touches_at_rest"] = TouchesOf(replayed, true).size();
    json["touches"] = TouchJson(replayed);
  }
  for (const PushLimit& push : replayed.pushes) {
    json["pushes"].push_back(
        {{"at_s", push.at},
         {"direction", DirectionName(push.direction)},
         {"survived_n_s", push.survived},
         {"fell_n_s", std::isinf(push.fell) ? ordered_json(nullptr) : ordered_json(push.fell)}});
  }
  return json;
}

}  // namespace

std::string ReplayText(const Replayed& replayed) {
  const ReplayResult& result = replayed.result;
  std::string text =
      replayed.method + ": " +
      (result.stayed_up ? "stays up" : "FALLS at " + Formatted("%.2f s", result.ended)) +
      Formatted(
          ", walk of %.3f s, largest tilt %.1f deg, ZMP off by %.1f (rms) and %.1f mm "
          "(largest; mass model alone %.1f and %.1f mm), slip %.1f mm, drift %.1f mm\n",
          replayed.duration, result.largest_tilt / kDegree, 1e3 * result.zmp_rms,
          1e3 * result.zmp_largest, 1e3 * result.model_rms, 1e3 * result.model_largest,
          1e3 * result.slip, 1e3 * result.drift);
  text += SupportText(replayed) + SolesText(result);
  if (replayed.controller) {
    text += "  controller " + *replayed.controller +
            ": off the plan, shifted with the support, by " + OffText(result.off.most) +
            " for 95 % of the time; at most " + OffText(result.off.largest) + "\n";
  }
  if (!replayed.obstacles.empty()) {
    text += TouchText(replayed, false);
    if (!TouchesOf(replayed, true).empty()) text += TouchText(replayed, true);
  }
  for (const PushLimit& push : replayed.pushes) {
    text += std::string("  pushed ") + DirectionName(push.direction) +
            Formatted(" at %.2f s: survives %.1f N s", push.at, push.survived) +
            (std::isinf(push.fell) ? ", the most that was tried\n"
                                   : ", falls at " + Formatted("%.1f N s\n", push.fell));
  }
  if (replayed.tube) text += SuggestedTubeText(replayed.method, *replayed.tube);
  return text;
}

std::string ReplayedJson(const Replayed& replayed) { return Json(replayed).dump(2); }

std::string ReplayJson(const std::string& run, const std::vector<std::string>& notes,
                       const std::vector<Replayed>& all) {
  ordered_json json = {
      {"run", run}, {"engine", "mujoco " + EngineVersion()}, {"statement", kReplayDisclaimer}};
  if (!notes.empty()) json["notes"] = notes;
  for (const Replayed& replayed : all) json["methods"].push_back(Json(replayed));
  return json.dump(2) + "\n";
}

}  // namespace halfstep::replay
