#include "experiments/verify/derived_promise.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "experiments/verify/check_episode_worlds.h"
#include "experiments/verify/derived_touches.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

constexpr double kLookRounding = 1e-9;  // [s], [m], [m/s]

using Window = std::pair<double, double>;

// From when a half-step begins until the next one does or the robot rests, and its world.
struct Stretch {
  Window time;
  int world = 0;
};

std::vector<Stretch> StretchesOf(const PromiseRecord& record) {
  std::vector<Stretch> stretches;
  if (record.executed == nullptr) return stretches;
  double rests = 0;
  for (const BegunRow& begun : record.episode.begun) {
    const auto [begin, end] = record.executed->WindowOf(begun.half_step - 1);
    rests = std::max(rests, end);
    if (!stretches.empty()) {
      double& before = stretches.back().time.second;
      before = std::min(before, begin);
    }
    stretches.push_back(
        {{begin, std::min(rests, record.end)}, Nth(record.episode.grants, begun.grant).world});
  }
  return stretches;
}

// A place where something should not have been: `n` measurements with r each are in it.
struct Excess {
  std::string name;
  int world = -1;  // that did not allow it; −1: none
  bool was_there = true;
  double moved = 0, elapsed = 0, r = 0, n = 1, v = 0;
  double beyond() const { return moved - n * r - v * elapsed; }
};

double RadiusOf(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.obstacles, name, &Obstacle::name);
  return RadiusAboutOrigin(found->shape);
}

const ObstacleRow* RowOf(const EpisodeText& episode, size_t world, const std::string& name) {
  // Rows are in the order of worlds.
  const int number = static_cast<int>(world);
  auto row = std::ranges::lower_bound(episode.obstacles, number, {}, &ObstacleRow::world);
  for (; row != episode.obstacles.end() && row->world == number; ++row) {
    if (row->name == name) return &*row;
  }
  return nullptr;
}

// Of each obstacle and area of a world: the latest world, from `since` on, that did not allow it.
std::vector<Excess> ExcessesOf(const PromiseRecord& record, size_t now) {
  const EpisodeText& episode = record.episode;
  const size_t since = now == 0 ? 0 : static_cast<size_t>(episode.worlds[now - 1].sound_since);
  std::vector<Excess> excesses;
  const auto look = [&](const std::function<bool(size_t, Excess*)>& allowed) {
    for (size_t earlier = now; earlier-- > since;) {
      Excess excess;
      if (allowed(earlier, &excess)) continue;
      excess.world = static_cast<int>(earlier);
      excesses.push_back(excess);
      return;
    }
  };
  // Where nothing is void that was not, nothing contradicts.
  if (static_cast<size_t>(episode.worlds[now].sound_since) == since) return excesses;
  for (const ObstacleRow& row : episode.obstacles) {
    if (row.world != static_cast<int>(now)) continue;
    const double radius = RadiusOf(record.scene, row.name);
    look([&](size_t earlier, Excess* excess) {
      excess->name = row.name;
      const ObstacleRow* before = RowOf(episode, earlier, row.name);
      excess->was_there = before != nullptr;
      if (before == nullptr) return false;
      excess->moved = Moved(*before, row, radius);
      excess->elapsed = episode.worlds[now].measured - episode.worlds[earlier].measured;
      excess->r = (before->error + row.error) / 2;
      excess->n = 2;
      excess->v = before->speed;
      return excess->beyond() <= kLookRounding;
    });
  }
  for (const size_t area : episode.worlds[now].areas) {
    look([&](size_t earlier, Excess* excess) {
      excess->name = "no-step area " + std::to_string(area + 1);
      excess->was_there = false;
      return std::ranges::count(episode.worlds[earlier].areas, area) > 0;
    });
  }
  return excesses;
}

class Derivation {
 public:
  explicit Derivation(const PromiseRecord& record)
      : record_(record), stretches_(StretchesOf(record)) {}

  void FromFrames() {
    const std::vector<WorldRow>& worlds = record_.episode.worlds;
    for (size_t now = 0; now < worlds.size(); ++now) {
      for (const Excess& excess : ExcessesOf(record_, now)) {
        BrokenText& broken = Add(excess, worlds[now].measured);
        if (broken.frames++ == 0) {
          broken.measured = worlds[now].measured;
          broken.known = worlds[now].known;
        }
        const double sure = worlds[now == 0 ? 0 : now - 1].measured;
        for (const Stretch& one : stretches_) {
          const auto& [begin, end] = one.time;
          if (one.world > excess.world || end <= sure + kLookRounding) continue;
          broken.unproved.emplace_back(std::max(begin, sure), end);
        }
      }
    }
  }

  void FromTruth(const EpisodeTruth& truth) {
    for (const Obstacle& one : record_.scene.obstacles) {
      radii_.push_back(RadiusAboutOrigin(one.shape));
    }
    for (const Stretch& one : stretches_) {
      const auto& [begin, end] = one.time;
      long i = std::lround(std::ceil((begin - kLookRounding) / kLook));
      for (; static_cast<double>(i) * kLook < end - kLookRounding; ++i) {
        const double t = static_cast<double>(i) * kLook;
        LookAt(truth, static_cast<size_t>(one.world), {t, std::min(t + kLook, end)});
      }
    }
  }

  // By name.
  std::vector<BrokenText> Result() {
    std::vector<BrokenText> all;
    for (auto& [name, broken] : broken_) {
      Join(&broken.unproved);
      if (broken.was_there) broken.covered_by = KeysFor(broken);
      all.push_back(std::move(broken));
    }
    return all;
  }

 private:
  BrokenText& Add(const Excess& excess, double t) {
    BrokenText& broken = broken_[excess.name];
    broken.name = excess.name;
    broken.from = std::min(broken.from, t);
    if (!excess.was_there) {
      broken.was_there = false;
      return broken;
    }
    broken.beyond = std::max(broken.beyond, excess.beyond());
    const double way = excess.moved - excess.n * excess.r;
    broken.speed =
        std::max(broken.speed, excess.elapsed > 0 ? way / excess.elapsed
                                                  : std::numeric_limits<double>::infinity());
    broken.error = std::max(broken.error, (excess.moved - excess.v * excess.elapsed) / excess.n);
    broken.rested = broken.rested || excess.v < StatedSpeed(excess.name) - kLookRounding;
    return broken;
  }

  // Of an obstacle that is not taken to rest.
  double StatedSpeed(const std::string& name) const {
    return std::ranges::find(record_.scene.obstacles, name, &Obstacle::name)->motion.speed +
           record_.options.drift;
  }

  void LookAt(const EpisodeTruth& truth, size_t world, const Window& look) {
    const double t = look.first;
    for (size_t i = 0; i < radii_.size(); ++i) {
      if (!truth.IsThere(i, t)) continue;
      Excess excess{.name = record_.scene.obstacles[i].name};
      const ObstacleRow* said = RowOf(record_.episode, world, excess.name);
      excess.was_there = said != nullptr;
      if (said != nullptr) {
        const Eigen::Isometry3d X = truth.At(i, t);
        const Eigen::Quaterniond q(X.linear());
        const ObstacleRow is{
            .name = excess.name, .place = X.translation(), .turn = {q.w(), q.x(), q.y(), q.z()}};
        excess.moved = Moved(*said, is, radii_[i]);
        excess.elapsed =
            std::min(std::abs(t - record_.episode.worlds[world].measured), said->horizon);
        excess.r = said->error;
        excess.v = said->speed;
        if (excess.beyond() <= kLookRounding) continue;
      }
      Add(excess, t).unproved.push_back(look);
    }
    const std::vector<size_t>& known = record_.episode.worlds[world].areas;
    for (size_t area = 0; area < record_.scene.no_step.size(); ++area) {
      if (!truth.AreaIsThere(area, t) || std::ranges::count(known, area) > 0) continue;
      Excess excess{.name = "no-step area " + std::to_string(area + 1), .was_there = false};
      Add(excess, t).unproved.push_back(look);
    }
  }

  static void Join(std::vector<Window>* windows) {
    std::ranges::sort(*windows);
    std::vector<Window> joined;
    for (const auto& [begin, end] : *windows) {
      if (joined.empty() || begin > joined.back().second + kLookRounding) {
        joined.emplace_back(begin, end);
      } else {
        joined.back().second = std::max(joined.back().second, end);
      }
    }
    *windows = std::move(joined);
  }

  // What config and scene would have had to say, each enough by itself.
  std::vector<std::string> KeysFor(const BrokenText& broken) const {
    constexpr double kFastest = 10, kLargest = 0.5;  // [m/s], [m]: beyond, nobody would say so
    constexpr char kNoRest[] = "live.sensing.rests_after_s: none";
    const std::ptrdiff_t own = std::ssize(record_.scene.obstacles) - record_.options.spare_boxes;
    const auto obstacle = std::ranges::find(record_.scene.obstacles, broken.name, &Obstacle::name);
    const double speed = broken.speed - record_.options.drift;
    std::vector<std::string> keys;
    if (broken.rested && broken.speed <= StatedSpeed(broken.name) + kLookRounding) {
      keys.emplace_back(kNoRest);
    } else if (obstacle - record_.scene.obstacles.begin() < own && speed <= kFastest) {
      std::string key = "obstacles[" + broken.name + "].motion.speed_m_s: " + ThreeDigitsUp(speed);
      if (broken.rested) key += std::string(" with ") + kNoRest;
      keys.push_back(key);
    }
    if (broken.error <= kLargest) {
      keys.push_back("live.sensing.error_m: " + ThreeDigitsUp(broken.error));
    }
    return keys;
  }

  static std::string ThreeDigitsUp(double x) {
    if (!(x > 0)) return "0";
    const double digit = std::pow(10.0, std::floor(std::log10(x)) - 2);
    return Formatted("%.3g", std::ceil(x / digit - kLookRounding) * digit);
  }

  const PromiseRecord& record_;
  std::vector<Stretch> stretches_;
  std::vector<double> radii_;
  std::map<std::string, BrokenText> broken_;
};

}  // namespace

PromiseText DerivePromise(const PromiseRecord& record, const EpisodeTruth* truth) {
  Derivation derivation(record);
  derivation.FromFrames();
  PromiseText promise;
  if (truth != nullptr && record.executed != nullptr) {
    derivation.FromTruth(*truth);
    promise.touched = TouchesOf(record.episode, *record.executed, record.end, record.scene, *truth);
  }
  promise.broken = derivation.Result();
  return promise;
}

long Contradictions(const PromiseRecord& record, size_t world) {
  return std::ssize(ExcessesOf(record, world));
}

}  // namespace halfstep::verify
