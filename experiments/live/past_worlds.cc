#include "experiments/live/past_worlds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"

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

Contradiction PastWorlds::Between(const Track& track, const Place& before, const Obstacle& now) {
  const Like& like = Nth(track.likes, before.like);
  return {.name = {},
          .version = before.version,
          .was_there = true,
          .moved = (now.X_WO.translation() - before.p_WO).norm() +
                   TurnBetween(like.axes, now.X_WO.linear()) * track.radius,
          .elapsed = now.motion.measured_at - before.measured_at,
          .errors = like.error + now.motion.error,
          .speed = like.speed};
}

bool PastWorlds::MayContradict(const Run& run, const Obstacle& now, double radius) {
  const double elapsed = now.motion.measured_at - run.last_measured_at;
  const double allowed = run.error + now.motion.error + run.speed * elapsed;
  const double turn = TurnBetween(run.axes, now.X_WO.linear()) + run.turn;
  const double way = (now.X_WO.translation() - run.center).norm() + run.radius;
  return way + turn * radius > allowed;
}

void PastWorlds::Run::Widen(const Like& like) {
  turn = std::max(turn, TurnBetween(axes, like.axes));
  error = std::min(error, like.error);
  speed = std::min(speed, like.speed);
}

// Around the mean of the places: of an obstacle that rests that is where it is, of one that is
// carried the middle of its way.
PastWorlds::Run PastWorlds::Track::Together(std::span<const Place> some) const {
  int as = some.front().like;
  const Like& first = Nth(likes, as);
  Run run{.center = Eigen::Vector3d::Zero(),
          .radius = 0.0,
          .axes = first.axes,
          .turn = 0.0,
          .error = first.error,
          .speed = first.speed,
          .last_measured_at = some.back().measured_at};
  for (const Place& place : some) run.center += place.p_WO;
  run.center /= static_cast<double>(some.size());
  for (const Place& place : some) {
    run.radius = std::max(run.radius, (place.p_WO - run.center).norm());
    if (place.like != as) run.Widen(Nth(likes, place.like));
    as = place.like;
  }
  return run;
}

// What takes long is done now for some tracks and now for others.
void PastWorlds::Track::Add(const Place& place) {
  places.push_back(place);
  const size_t size = places.size();
  const std::span<const Place> every = places;
  if (size >= refit) {
    all = Together(every);
    refit = 2 * size + number % size;
  } else {
    all.radius = std::max(all.radius, (place.p_WO - all.center).norm());
    if (place.like != every[size - 2].like) all.Widen(Nth(likes, place.like));
    all.last_measured_at = place.measured_at;
  }
  const auto add = [&](size_t length, std::vector<Run>* to) {
    const size_t from = to->size() * length;
    if ((size + number) % length != 0 || from + length > size) return;
    to->push_back(Together(every.subspan(from, length)));
  };
  add(kRun, &runs);
  add(kRun * kRun, &long_runs);
}

PastWorlds::PastWorlds(std::span<const World> worlds) {
  for (const World& world : worlds) Add(world);
}

PastWorlds::Track* PastWorlds::Find(const std::string& name, size_t* likely) const {
  constexpr size_t kMostlyWithin = 4;  // of an order in which some vanished
  for (size_t k = *likely; k < std::min(*likely + kMostlyWithin, recent_.size()); ++k) {
    if (recent_[k]->name != name) continue;
    *likely = k + 1;
    return recent_[k];
  }
  const auto it = tracks_.find(name);
  const bool was_there = it != tracks_.end() && it->second->places.back().version == last_;
  return was_there ? it->second.get() : nullptr;
}

void PastWorlds::Fetch(size_t likely) const {
  constexpr size_t kAhead = 6, kLine = 64;  // tracks; bytes
  if (likely + kAhead >= recent_.size()) return;
  const char* const track = reinterpret_cast<const char*>(recent_[likely + kAhead]);
  for (size_t at = 0; at < sizeof(Track); at += kLine) __builtin_prefetch(track + at);
}

void PastWorlds::Add(const World& world) {
  std::vector<Track*> now;
  now.reserve(world.scene.obstacles.size());
  size_t likely = 0;
  for (const Obstacle& obstacle : world.scene.obstacles) {
    Fetch(likely);
    Track* track = Find(obstacle.name, &likely);
    if (track == nullptr) {
      std::unique_ptr<Track>& begun = tracks_[obstacle.name];
      begun = std::make_unique<Track>();
      track = begun.get();
      track->name = obstacle.name;
      track->absent = last_;
      track->radius = RadiusAboutOrigin(obstacle.shape);
      track->number = begun_++;
    }
    now.push_back(track);
    const ObstacleMotion& motion = obstacle.motion;
    const Like like{obstacle.X_WO.linear(), motion.error, motion.speed};
    if (track->likes.empty() || !(track->likes.back() == like)) track->likes.push_back(like);
    track->Add({.version = world.version,
                .like = static_cast<int>(track->likes.size()) - 1,
                .measured_at = motion.measured_at,
                .p_WO = obstacle.X_WO.translation()});
  }
  recent_ = std::move(now);
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
  const auto add = [&](const std::string& name, Contradiction found) {
    if (found.version < std::max(since, 0)) return;
    found.name = name;
    latest.push_back(std::move(found));
  };
  const auto absent = [](int version) {
    return Contradiction{.name = {}, .version = version, .was_there = false};
  };
  size_t likely = 0;
  for (const Obstacle& obstacle : now.scene.obstacles) {
    Fetch(likely);
    const Track* track = Find(obstacle.name, &likely);
    const Place* place = track ? Latest(*track, obstacle, since) : nullptr;
    add(obstacle.name, place   ? Between(*track, *place, obstacle)
                       : track ? absent(track->absent)
                               : absent(last_));
  }
  for (const size_t area : now.areas) {
    const auto before = areas_absent_.find(area);
    add("no-step area " + std::to_string(area + 1),
        absent(before == areas_absent_.end() ? last_ : before->second));
  }
  return latest;
}

const PastWorlds::Place* PastWorlds::Latest(const Track& track, const Obstacle& now, int since) {
  if (!MayContradict(track.all, now, track.radius)) return nullptr;
  const auto clears = [&](size_t end, size_t length, const std::vector<Run>& runs) {
    return end % length == 0 && end / length <= runs.size() &&
           !MayContradict(runs[end / length - 1], now, track.radius);
  };
  for (size_t end = track.places.size(); end > 0;) {
    if (track.places[end - 1].version < since) return nullptr;
    if (clears(end, kRun * kRun, track.long_runs)) {
      end -= kRun * kRun;
    } else if (clears(end, kRun, track.runs)) {
      end -= kRun;
    } else {
      // One by one to the beginning of the run: Between().beyond(), without making it.
      const size_t begin = (end - 1) / kRun * kRun;
      const Like* like = nullptr;
      double turned = 0.0;
      for (; end > begin; --end) {
        const Place& place = track.places[end - 1];
        if (place.version < since) return nullptr;
        if (const Like& its = Nth(track.likes, place.like); like != &its) {
          like = &its;
          turned = TurnBetween(its.axes, now.X_WO.linear()) * track.radius;
        }
        const double moved = (now.X_WO.translation() - place.p_WO).norm() + turned;
        const double elapsed = now.motion.measured_at - place.measured_at;
        const double allowed = like->error + now.motion.error + like->speed * elapsed;
        if (moved - allowed > kRoundingOfPlaces) return &place;
      }
    }
  }
  return nullptr;
}

}  // namespace halfstep
