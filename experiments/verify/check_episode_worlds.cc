#include "experiments/verify/check_episode_worlds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

constexpr double kPlaceRounding = 1e-9;  // of places, times and speeds that are computed twice

const Obstacle* Named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.obstacles, name, &Obstacle::name);
  return found == scene.obstacles.end() ? nullptr : &*found;
}

std::string LineOf(const char* file, size_t row) { return Formatted("%s:%zu: ", file, row + 2); }

// What is wrong with a row of obstacles.csv by itself; "": nothing.
std::string FaultOfObstacle(const ObstacleRow& row, const Scene& scene) {
  if (Named(scene, row.name) == nullptr) return Quote(row.name) + " is not in the scene";
  double length = 0;
  for (const double q : row.turn) length += q * q;
  const double sum = row.place.sum() + row.error + row.speed;
  if (!std::isfinite(sum) || std::isnan(row.horizon)) return "a number is not finite";
  if (!(std::abs(length - 1) <= kPlaceRounding)) {
    return Formatted("its quaternion has the length %.9g", std::sqrt(length));
  }
  return "";
}

// The obstacles of one world by name, and the rows that they are in.
using ByName = std::map<std::string, size_t>;

class Worlds {
 public:
  Worlds(const EpisodeText& episode, const LiveOptions& options, const Scene& scene)
      : episode_(episode), options_(options), scene_(scene), of_world_(episode.worlds.size()) {
    for (size_t i = 0; i < episode.obstacles.size(); ++i) {
      const ObstacleRow& row = episode.obstacles[i];
      Nth(of_world_, row.world)[row.name] = i;
      radius_.try_emplace(row.name, RadiusAboutOrigin(Named(scene, row.name)->shape));
    }
  }

  // Whether `now` was not allowed by an earlier world.
  bool Contradicts(size_t earlier, size_t now) const {
    const double elapsed = episode_.worlds[now].measured - episode_.worlds[earlier].measured;
    for (const auto& [name, index] : of_world_[now]) {
      const auto old = of_world_[earlier].find(name);
      if (old == of_world_[earlier].end()) return true;
      const ObstacleRow &a = episode_.obstacles[old->second], &b = episode_.obstacles[index];
      const double allowed = a.error + b.error + a.speed * elapsed;
      if (!(Moved(a, b, radius_.at(name)) <= allowed + kPlaceRounding)) return true;
    }
    const std::vector<size_t>& before = episode_.worlds[earlier].areas;
    return std::ranges::any_of(episode_.worlds[now].areas, [&](size_t area) {
      return std::ranges::find(before, area) == before.end();
    });
  }

  // The speeds of all rows of obstacles.csv.
  std::vector<double> Speeds() const {
    std::vector<double> speeds(episode_.obstacles.size());
    // Of each obstacle: the row with the first of the places that are one up to the errors.
    ByName first;
    for (size_t w = 0; w < of_world_.size(); ++w) {
      ByName stays;
      for (const auto& [name, index] : of_world_[w]) {
        const ObstacleRow& row = episode_.obstacles[index];
        speeds[index] = Named(scene_, name)->motion.speed + options_.drift;
        stays[name] = index;
        const auto stay = first.find(name);
        if (stay == first.end()) continue;
        const ObstacleRow& before = episode_.obstacles[stay->second];
        const double since = Nth(episode_.worlds, before.world).measured;
        const double stayed = episode_.worlds[w].measured - since;
        const double allowed = 2 * options_.sensing.error + options_.drift * stayed;
        if (Moved(before, row, radius_.at(name)) > allowed + kPlaceRounding) continue;
        stays[name] = stay->second;
        const auto& rests_after = options_.sensing.rests_after;
        if (rests_after && stayed >= *rests_after) speeds[index] = options_.drift;
      }
      first = stays;
    }
    return speeds;
  }

 private:
  const EpisodeText& episode_;
  const LiveOptions& options_;
  const Scene& scene_;
  std::vector<ByName> of_world_;
  std::map<std::string, double> radius_;
};

}  // namespace

double Moved(const ObstacleRow& from, const ObstacleRow& to, double radius) {
  // Of the quaternion to · from⁻¹: scalar part and length of the vector part.
  const auto [w, x, y, z] = from.turn;
  const auto [a, b, c, d] = to.turn;
  const double scalar = a * w + b * x + c * y + d * z;
  const Eigen::Vector3d vector(-a * x + b * w - c * z + d * y, -a * y + b * z + c * w - d * x,
                               -a * z - b * y + c * x + d * w);
  const double angle = 2 * std::atan2(vector.norm(), std::abs(scalar));
  return (to.place - from.place).norm() + angle * radius;
}

bool CheckEpisodeNumbers(const EpisodeText& episode, const Scene& scene, Findings* findings) {
  Faults worlds, obstacles;
  if (episode.worlds.empty()) findings->Disagree("worlds.csv: no world");
  for (size_t i = 0; i < episode.worlds.size(); ++i) {
    const WorldRow& row = episode.worlds[i];
    const std::string line = LineOf("worlds.csv", i);
    if (row.world != static_cast<int>(i)) {
      worlds.Add(line + Formatted("world %d instead of %zu", row.world, i));
    }
    if (!std::isfinite(row.known + row.measured + row.goal.sum())) {
      worlds.Add(line + "a number is not finite");
    }
    const std::set<size_t> areas(row.areas.begin(), row.areas.end());
    if (areas.size() != row.areas.size() ||
        (!areas.empty() && *areas.rbegin() >= scene.no_step.size())) {
      worlds.Add(line + "its areas are not no-step areas of the scene");
    }
  }
  std::set<std::string> names;
  for (size_t i = 0; i < episode.obstacles.size(); ++i) {
    const ObstacleRow& row = episode.obstacles[i];
    const std::string line = LineOf("obstacles.csv", i);
    const int before = i == 0 ? 0 : episode.obstacles[i - 1].world;
    if (row.world < before || row.world >= static_cast<int>(episode.worlds.size())) {
      obstacles.Add(line +
                    Formatted("world %d is not one of worlds.csv, in their order", row.world));
    }
    if (row.world != before) names.clear();
    if (!names.insert(row.name).second) {
      obstacles.Add(line + Quote(row.name) + " is there twice");
    }
    const std::string fault = FaultOfObstacle(row, scene);
    if (!fault.empty()) obstacles.Add(line + fault);
  }
  const long so_far = findings->disagreements();
  worlds.Conclude(findings);
  obstacles.Conclude(findings);
  return findings->disagreements() == so_far && !episode.worlds.empty();
}

void CheckEpisodeWorlds(const EpisodeText& episode, const LiveOptions& options, const Scene& scene,
                        Findings* findings) {
  const Worlds all(episode, options, scene);
  Faults times, sound, stated;
  long voided = 0;
  for (size_t i = 0; i < episode.worlds.size(); ++i) {
    const WorldRow& row = episode.worlds[i];
    const std::string line = LineOf("worlds.csv", i);
    if (!(row.known >= row.measured - kPlaceRounding)) {
      times.Add(line +
                Formatted("known at %.9g s, but measured at %.9g s", row.known, row.measured));
    }
    if (i > 0 && (!(row.known >= episode.worlds[i - 1].known) ||
                  !(row.measured > episode.worlds[i - 1].measured))) {
      times.Add(line + "its times are before those of the world before it");
    }
  }
  // All pairs of worlds that are not void are compared, once.
  size_t since = 0;
  for (size_t now = 0; now < episode.worlds.size(); ++now) {
    const size_t before = since;
    for (size_t earlier = now; earlier-- > since;) {
      if (!all.Contradicts(earlier, now)) continue;
      since = earlier + 1;
      break;
    }
    voided += since > before;
    const int said = episode.worlds[now].sound_since;
    if (said == static_cast<int>(since)) continue;
    sound.Add(LineOf("worlds.csv", now) +
              Formatted("sound_since is %d, but by the measured places it is %zu", said, since));
  }
  const std::vector<double> speeds = all.Speeds();
  for (size_t i = 0; i < episode.obstacles.size(); ++i) {
    const ObstacleRow& row = episode.obstacles[i];
    const auto compare = [&](const char* column, double is, double demanded) {
      if (std::abs(is - demanded) <= kPlaceRounding || is == demanded) return;
      stated.Add(LineOf("obstacles.csv", i) +
                 Formatted("%s is %.9g, but %.9g by config and scene", column, is, demanded));
    };
    compare("error_m", row.error, options.sensing.error);
    compare("speed_m_s", row.speed, speeds[i]);
    compare("horizon_s", row.horizon, options.horizon);
  }
  for (const Faults* faults : {&times, &sound, &stated}) faults->Conclude(findings);
  findings->Say("worlds: " + Count(std::ssize(episode.worlds)) + ", " +
                Count(std::ssize(episode.obstacles)) + " measured obstacles; " + Count(voided) +
                " contradict earlier ones");
}

Scene SceneOfWorld(const EpisodeText& episode, const Scene& scene, size_t version) {
  Scene known = scene.Emptied();
  const WorldRow& world = episode.worlds[version];
  for (const ObstacleRow& row :
       std::ranges::equal_range(episode.obstacles, world.world, {}, &ObstacleRow::world)) {
    Obstacle obstacle = *Named(scene, row.name);
    const auto [w, x, y, z] = row.turn;
    obstacle.X_WO = Eigen::Isometry3d::Identity();
    obstacle.X_WO.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
    obstacle.X_WO.translation() = row.place;
    obstacle.motion = {.waypoints = {},
                       .error = row.error,
                       .speed = row.speed,
                       .measured_at = world.measured,
                       .horizon = row.horizon};
    known.obstacles.push_back(std::move(obstacle));
  }
  for (const size_t area : world.areas) known.no_step.push_back(scene.no_step[area]);
  return known;
}

}  // namespace halfstep::verify
