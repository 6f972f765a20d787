#include "experiments/live/promise_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "wpg/files/text.h"

namespace halfstep {
namespace {

using nlohmann::ordered_json;

constexpr size_t kTold = 5;  // on the screen; the manifest has all

ordered_json NumberOrNull(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json BrokenJson(const BrokenPromise& broken) {
  ordered_json unproved = ordered_json::array();
  for (const TimeSpan& one : broken.unproved) unproved.push_back({one.begin, one.end});
  return {{"name", broken.name},
          {"was_there", broken.was_there},
          {"from_s", broken.from},
          {"measured_s", NumberOrNull(broken.measured)},
          {"known_s", NumberOrNull(broken.known)},
          {"frames", broken.frames},
          {"beyond_m", broken.beyond},
          {"rested", broken.rested},
          {"speed_m_s", NumberOrNull(broken.speed)},
          {"error_m", broken.error},
          {"covered_by", broken.covered_by},
          {"unproved_s", unproved}};
}

std::optional<double> NumberOf(const nlohmann::json& value) {
  if (value.is_null()) return std::nullopt;
  return value.get<double>();
}

BrokenPromise BrokenOf(const nlohmann::json& json) {
  BrokenPromise broken;
  broken.name = json.at("name").get<std::string>();
  broken.was_there = json.at("was_there").get<bool>();
  broken.from = json.at("from_s").get<double>();
  broken.measured = NumberOf(json.at("measured_s"));
  broken.known = NumberOf(json.at("known_s"));
  broken.frames = json.at("frames").get<int>();
  broken.beyond = json.at("beyond_m").get<double>();
  broken.rested = json.at("rested").get<bool>();
  broken.speed = NumberOf(json.at("speed_m_s")).value_or(std::numeric_limits<double>::infinity());
  broken.error = json.at("error_m").get<double>();
  broken.covered_by = json.at("covered_by").get<std::vector<std::string>>();
  for (const nlohmann::json& one : json.at("unproved_s")) {
    broken.unproved.push_back({one.at(0).get<double>(), one.at(1).get<double>()});
  }
  return broken;
}

// "'crate' was up to 0.532 m farther than its r and v allow, from 2.105 s on; first measured at
// 2.200 s, known at 2.220 s".
std::string WhatItDid(const BrokenPromise& broken) {
  std::string text = Quote(broken.name);
  if (broken.was_there) {
    text += Formatted(" was up to %.4g m farther than its r and v allow", broken.beyond);
  } else {
    text += " was there where a world did not have it";
    if (broken.beyond > 0.0) {
      text += Formatted(", and up to %.4g m farther than its r and v allow", broken.beyond);
    }
  }
  text += Formatted(", from %.3f s on; ", broken.from);
  if (!broken.measured) return text + "no frame said so";
  return text +
         Formatted("first measured at %.3f s, known at %.3f s, ", *broken.measured, *broken.known) +
         std::to_string(broken.frames) + (broken.frames == 1 ? " frame" : " frames");
}

std::string WhatWasUnproved(const BrokenPromise& broken) {
  if (broken.unproved.empty()) return "the robot stood";
  double sum = 0.0;
  for (const TimeSpan& one : broken.unproved) sum += one.end - one.begin;
  const auto& [begin, end] = broken.unproved.front();
  std::string text =
      Formatted("walked without proof of its clearance from it: %.3f s … %.3f s", begin, end);
  if (broken.unproved.size() > 1) {
    text += Formatted(" and %zu times more, %.3f s in all", broken.unproved.size() - 1, sum);
  }
  return text;
}

std::string WhatWouldCover(const BrokenPromise& broken) {
  if (!broken.was_there) return "no key covers what was not there when it was proved";
  if (broken.covered_by.empty()) return "no key covers a jump so far";
  std::string text = "would have been covered by ";
  for (size_t i = 0; i < broken.covered_by.size(); ++i) {
    text += (i == 0 ? "" : ", or by ") + broken.covered_by[i];
  }
  return text;
}

std::string AllNames(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kTold); ++i) {
    text += (i == 0 ? "" : ", ") + Quote(names[i]);
  }
  return names.size() > kTold ? text + Formatted(" and %zu more", names.size() - kTold) : text;
}

// Precondition: somebody did.
std::string WhoBrokeIt(const Promise& promise) {
  std::vector<std::string> names;
  for (const BrokenPromise& one : promise.broken) names.push_back(one.name);
  return AllNames(names) +
         (names.size() == 1 ? " was not where its error and speed allow"
                            : " were not where their errors and speeds allow") +
         Formatted(", on which the promise rests, from %.3f s on", promise.broken.front().from);
}

}  // namespace

ordered_json PromiseJson(const Promise& promise) {
  ordered_json broken = ordered_json::array(), touched = ordered_json::array();
  for (const BrokenPromise& one : promise.broken) broken.push_back(BrokenJson(one));
  for (const TouchedObstacle& one : promise.touched) {
    touched.push_back({{"obstacle", one.obstacle},
                       {"body", one.body},
                       {"from_s", one.from},
                       {"depth_m", one.depth},
                       {"deepest_s", one.deepest}});
  }
  return {{"status", Name(promise.status())},
          {"judged_by", promise.judged_by},
          {"broken", broken},
          {"touched", touched}};
}

Promise PromiseOf(const nlohmann::json& json) {
  Promise promise;
  promise.judged_by = json.at("judged_by").get<std::string>();
  for (const nlohmann::json& one : json.at("broken")) promise.broken.push_back(BrokenOf(one));
  for (const nlohmann::json& one : json.at("touched")) {
    promise.touched.push_back({.obstacle = one.at("obstacle").get<std::string>(),
                               .body = one.at("body").get<std::string>(),
                               .from = one.at("from_s").get<double>(),
                               .depth = one.at("depth_m").get<double>(),
                               .deepest = one.at("deepest_s").get<double>()});
  }
  return promise;
}

std::string PromiseSentence(const Promise& promise) {
  std::vector<std::string> names;
  if (promise.status() == PromiseStatus::kTouched) {
    for (const TouchedObstacle& one : promise.touched) names.push_back(one.obstacle);
    return "the robot touched " + AllNames(names) + " while it moved" +
           (promise.broken.empty() ? ", although every obstacle kept its r and v"
                                   : "; " + WhoBrokeIt(promise));
  }
  if (promise.broken.empty()) return "the promise held";
  return WhoBrokeIt(promise) + (promise.judged_by == "measurements" ? "" : "; nothing was touched");
}

std::string PromiseText(const Promise& promise) {
  std::string text = "promise      ";
  if (promise.broken.empty()) {
    text += promise.judged_by == "measurements"
                ? "held, as far as measurements tell: no frame contradicts another\n"
                : "held: every obstacle was where its r and v allow\n";
  }
  const size_t told = std::min(promise.broken.size(), kTold);
  for (size_t i = 0; i < told; ++i) {
    const BrokenPromise& one = promise.broken[i];
    text += (i == 0 ? "its condition was not kept: " : "             ") + WhatItDid(one) + "\n";
    text += "             " + WhatWasUnproved(one) + "; " + WhatWouldCover(one) + "\n";
  }
  if (told < promise.broken.size()) {
    text += Formatted("             and %zu more obstacles: manifest.json has all\n",
                      promise.broken.size() - told);
  }
  if (promise.status() == PromiseStatus::kNotKept && promise.judged_by != "measurements") {
    text += "             nothing was touched\n";
  }
  for (const TouchedObstacle& one : promise.touched) {
    text += "touched      " + Quote(one.obstacle) + " with " + one.body +
            Formatted(" from %.3f s on, at most %.4g m deep at %.3f s\n", one.from, one.depth,
                      one.deepest);
  }
  return text;
}

}  // namespace halfstep
