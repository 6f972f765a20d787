#include "experiments/live/judged_promise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "experiments/live/episode_touch.h"
#include "experiments/live/past_worlds.h"
#include "experiments/live/spare_boxes.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kRoundingOfLooks = 1e-9;  // [s], [m]
constexpr double kFastestStated = 10.0;    // no obstacle is said to be faster [m/s]
constexpr double kLargestError = 0.5;      // that live.sensing.error_m may be [m]

// To three digits, not less.
std::string RoundedUp(double x) {
  if (!(x > 0.0)) return "0";
  const double digit = Pow(10.0, std::floor(Log10(x)) - 2.0);
  return Formatted("%.3g", std::ceil(x / digit - kRoundingOfLooks) * digit);
}

// From when a half-step begins until the next one does, or the robot rests.
struct UnderWay {
  TimeSpan time;
  int version = 0;  // of the world that it was proved against
};

std::vector<UnderWay> HalfStepsOf(const Episode& episode) {
  std::vector<UnderWay> all;
  if (episode.walks.empty()) return all;
  const SuperposedWalk walk = episode.Executed();
  double rests = 0.0;
  for (const BegunHalfStep& begun : episode.begun) {
    const double begin = walk.start_of(begun.half_step);
    if (!all.empty()) all.back().time.end = std::min(all.back().time.end, begin);
    rests = std::max(rests, walk.end_of(begun.half_step));
    const Grant& grant = Nth(episode.grants, begun.grant).grant;
    all.push_back({{begin, std::min(rests, episode.end)}, grant.version});
  }
  return all;
}

// Spans in order, those that meet as one.
std::vector<TimeSpan> Merged(std::vector<TimeSpan> spans) {
  std::ranges::sort(spans, {}, &TimeSpan::begin);
  std::vector<TimeSpan> merged;
  for (const TimeSpan& one : spans) {
    if (!merged.empty() && one.begin <= merged.back().end + kRoundingOfLooks) {
      merged.back().end = std::max(merged.back().end, one.end);
    } else {
      merged.push_back(one);
    }
  }
  return merged;
}

class Judge {
 public:
  Judge(const Episode& episode, const Scene& scene, const LiveOptions& options)
      : episode_(episode), options_(options), half_steps_(HalfStepsOf(episode)) {
    for (const Obstacle& obstacle : scene.obstacles) {
      speeds_[obstacle.name] = obstacle.motion.speed + options.drift;
    }
  }

  // Compares each frame with the worlds before it that were not void.
  void CompareFrames() {
    PastWorlds past;
    for (size_t n = 0; n < episode_.worlds.size(); ++n) {
      const World& now = episode_.worlds[n];
      const int since = n == 0 ? 0 : episode_.worlds[n - 1].sound_since;
      for (const Contradiction& one : past.Latest(now, since)) {
        BrokenPromise& broken = Add(one, now.measured_at, 2);
        ++broken.frames;
        if (!broken.measured) {
          broken.measured = now.measured_at;
          broken.known = episode_.known[n];
        }
        const double sure = n == 0 ? now.measured_at : episode_.worlds[n - 1].measured_at;
        for (const UnderWay& half_step : half_steps_) {
          // Nothing that was proved against such worlds begins later.
          if (half_step.version > one.version) continue;
          if (half_step.time.end <= sure + kRoundingOfLooks) continue;
          broken.unproved.push_back({std::max(half_step.time.begin, sure), half_step.time.end});
        }
      }
      past.Add(now);
    }
  }

  // Compares what is true with the world of each half-step while it is under way.
  void CompareTruth(const TrueWorld& truth) {
    std::vector<double> radii;
    for (const Obstacle& one : truth.scene().obstacles) {
      radii.push_back(RadiusAboutOrigin(one.shape));
    }
    for (const UnderWay& half_step : half_steps_) {
      const World& world = Nth(episode_.worlds, half_step.version);
      const auto [begin, end] = half_step.time;
      long i = std::lround(std::ceil((begin - kRoundingOfLooks) / kLook));
      for (; static_cast<double>(i) * kLook < end - kRoundingOfLooks; ++i) {
        const double t = static_cast<double>(i) * kLook;
        LookAt(truth, radii, world, {t, std::min(t + kLook, end)});
      }
    }
  }

  std::vector<BrokenPromise> Result() {
    std::vector<BrokenPromise> all;
    for (auto& [name, broken] : broken_) {
      broken.unproved = Merged(std::move(broken.unproved));
      if (broken.was_there) broken.covered_by = CoveredBy(broken);
      all.push_back(std::move(broken));
    }
    std::ranges::stable_sort(all, {}, &BrokenPromise::from);
    return all;
  }

 private:
  BrokenPromise& Add(const Contradiction& one, double t, int measurements) {
    BrokenPromise& broken = broken_[one.name];
    broken.name = one.name;
    broken.from = std::min(broken.from, t);
    broken.Add(one, measurements);
    const auto speed = speeds_.find(one.name);
    const bool rested =
        one.was_there && speed != speeds_.end() && one.speed < speed->second - kRoundingOfLooks;
    broken.rested = broken.rested || rested;
    return broken;
  }

  std::vector<std::string> CoveredBy(const BrokenPromise& broken) const {
    std::vector<std::string> keys;
    const std::vector<std::string> spare = SpareNames(options_);
    const bool in_file = std::ranges::find(spare, broken.name) == spare.end();
    if (broken.rested && broken.speed <= speeds_.at(broken.name) + kRoundingOfLooks) {
      keys.push_back("live.sensing.rests_after_s: none");
    } else if (in_file && broken.speed - options_.drift <= kFastestStated) {
      keys.push_back("obstacles[" + broken.name +
                     "].motion.speed_m_s: " + RoundedUp(broken.speed - options_.drift) +
                     (broken.rested ? " with live.sensing.rests_after_s: none" : ""));
    }
    if (broken.error <= kLargestError) {
      keys.push_back("live.sensing.error_m: " + RoundedUp(broken.error));
    }
    return keys;
  }

  void LookAt(const TrueWorld& truth, const std::vector<double>& radii, const World& world,
              const TimeSpan& look) {
    const double t = look.begin;
    const std::vector<Obstacle>& stated = world.scene.obstacles;
    for (size_t i = 0; i < radii.size(); ++i) {
      if (!truth.IsThere(i, t)) continue;
      Contradiction one{.name = truth.scene().obstacles[i].name, .version = world.version};
      const auto said = std::ranges::find(stated, one.name, &Obstacle::name);
      one.was_there = said != stated.end();
      if (one.was_there) {
        const ObstacleMotion& motion = said->motion;
        one.moved = Displacement(said->X_WO, truth.PoseAt(i, t), radii[i]);
        one.elapsed = std::min(std::abs(t - motion.measured_at), motion.horizon);
        one.errors = motion.error;
        one.speed = motion.speed;
        if (one.beyond() <= kRoundingOfLooks) continue;
      }
      Add(one, t, 1).unproved.push_back(look);
    }
    for (size_t area = 0; area < truth.scene().no_step.size(); ++area) {
      if (!truth.AreaIsThere(area, t) || std::ranges::count(world.areas, area) > 0) continue;
      const std::string name = "no-step area " + std::to_string(area + 1);
      Add({.name = name, .version = world.version, .was_there = false}, t, 1)
          .unproved.push_back(look);
    }
  }

  const Episode& episode_;
  const LiveOptions& options_;
  std::vector<UnderWay> half_steps_;
  std::map<std::string, double> speeds_;  // that worlds state unless an obstacle is taken to rest
  std::map<std::string, BrokenPromise> broken_;
};

}  // namespace

Promise JudgePromise(const Episode& episode, const TrueWorld* truth, const Place& place,
                     const LiveOptions& options) {
  Judge judge(episode, place.scene, options);
  judge.CompareFrames();
  Promise promise;
  if (truth != nullptr) {
    promise.judged_by = "script";
    judge.CompareTruth(*truth);
    promise.touched = FindTouches(episode, *truth, place.robot);
  }
  promise.broken = judge.Result();
  return promise;
}

}  // namespace halfstep
