#include "experiments/live/past_worlds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wpg/geometry/rotation.h"

namespace halfstep {
namespace {

constexpr size_t kRun = 32;
constexpr double kRoundingOfPlaces = 1e-9;  // [m]

// The angle between two orientations [rad], 0 when they are equal to the bit.
double TurnBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  if (a == b) return 0.0;
  return AngleOf(b * a.transpose());
}

}  // namespace

double Displacement(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                    const Shape& shape) {
  const bool turns = TurnBetween(from.linear(), to.linear()) != 0.0;
  return Displacement(from, to, turns ? RadiusAboutOrigin(shape) : 0.0);
}

double Displacement(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double radius) {
  return (to.translation() - from.translation()).norm() +
         TurnBetween(from.linear(), to.linear()) * radius;
}

Contradiction PastWorlds::Between(const Place& before, const Obstacle& now, double radius) {
  return {.name = now.name,
          .version = before.version,
          .was_there = true,
          .moved = Displacement(before.X_WO, now.X_WO, radius),
          .elapsed = now.motion.measured_at - before.measured_at,
          .errors = before.error + now.motion.error,
          .speed = before.speed};
}

bool PastWorlds::MayContradict(const Run& run, const Obstacle& now, double radius) {
  const double elapsed = now.motion.measured_at - run.last_measured_at;
  const double allowed = run.error + now.motion.error + run.speed * elapsed;
  const double turn = TurnBetween(run.axes, now.X_WO.linear()) + run.turn;
  const double way = (now.X_WO.translation() - run.center).norm() + run.radius;
  return way + turn * radius > allowed;
}

PastWorlds::Run PastWorlds::Together(std::span<const Place> places) {
  Run run{.center = places.front().X_WO.translation(),
          .radius = 0.0,
          .axes = places.front().X_WO.linear(),
          .turn = 0.0,
          .error = places.front().error,
          .speed = places.front().speed,
          .last_measured_at = places.back().measured_at};
  // Towards the farthest place by a part of the way that shrinks: ends near the smallest ball.
  const auto farthest = [&] {
    return std::ranges::max_element(places, {}, [&](const Place& place) {
      return (place.X_WO.translation() - run.center).squaredNorm();
    });
  };
  constexpr int kMoves = 60;
  for (int i = 2; i < kMoves; ++i) {
    run.center += (farthest()->X_WO.translation() - run.center) / i;
  }
  run.radius = (farthest()->X_WO.translation() - run.center).norm();
  for (const Place& place : places) {
    run.turn = std::max(run.turn, TurnBetween(run.axes, place.X_WO.linear()));
    run.error = std::min(run.error, place.error);
    run.speed = std::min(run.speed, place.speed);
  }
  return run;
}

PastWorlds::PastWorlds(std::span<const World> worlds) {
  for (const World& world : worlds) Add(world);
}

void PastWorlds::Add(const World& world) {
  for (const Obstacle& obstacle : world.scene.obstacles) {
    Track& track = tracks_[obstacle.name];
    if (track.places.empty() || track.places.back().version != last_) {
      track = {.absent = last_, .radius = RadiusAboutOrigin(obstacle.shape)};
    }
    track.places.push_back({.version = world.version,
                            .X_WO = obstacle.X_WO,
                            .error = obstacle.motion.error,
                            .speed = obstacle.motion.speed,
                            .measured_at = obstacle.motion.measured_at});
    const std::span<const Place> all = track.places;
    if (all.size() % kRun == 0) track.runs.push_back(Together(all.last(kRun)));
    if (all.size() % (kRun * kRun) == 0) {
      track.long_runs.push_back(Together(all.last(kRun * kRun)));
    }
  }
  std::map<size_t, int> absent;
  for (const size_t area : world.areas) {
    const auto before = areas_absent_.find(area);
    absent[area] = before == areas_absent_.end() ? last_ : before->second;
  }
  areas_absent_ = std::move(absent);
  last_ = world.version;
}

std::vector<Contradiction> PastWorlds::Latest(const World& now, int since) const {
  std::vector<Contradiction> latest;
  const auto add = [&](Contradiction found) {
    if (found.version >= std::max(since, 0)) latest.push_back(std::move(found));
  };
  for (const Obstacle& obstacle : now.scene.obstacles) add(Latest(obstacle, since));
  for (const size_t area : now.areas) {
    const auto before = areas_absent_.find(area);
    add({.name = "no-step area " + std::to_string(area + 1),
         .version = before == areas_absent_.end() ? last_ : before->second,
         .was_there = false});
  }
  return latest;
}

Contradiction PastWorlds::Latest(const Obstacle& now, int since) const {
  const auto absent = [&](int version) {
    return Contradiction{.name = now.name, .version = version, .was_there = false};
  };
  const auto it = tracks_.find(now.name);
  if (it == tracks_.end() || it->second.places.back().version != last_) return absent(last_);
  const Track& track = it->second;
  for (size_t end = track.places.size(); end > 0;) {
    if (track.places[end - 1].version < since) return {};
    const size_t i = end / kRun;
    if (end % (kRun * kRun) == 0 &&
        !MayContradict(track.long_runs[i / kRun - 1], now, track.radius)) {
      end -= kRun * kRun;
    } else if (end % kRun == 0 && !MayContradict(track.runs[i - 1], now, track.radius)) {
      end -= kRun;
    } else {
      // One by one to the beginning of the run.
      const size_t begin = (end - 1) / kRun * kRun;
      for (; end > begin; --end) {
        const Place& place = track.places[end - 1];
        if (place.version < since) return {};
        Contradiction found = Between(place, now, track.radius);
        if (found.beyond() > kRoundingOfPlaces) return found;
      }
    }
  }
  return absent(track.absent);
}

}  // namespace halfstep
