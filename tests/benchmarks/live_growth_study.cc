// How the cost of replanning grows with the obstacles, most of which are far away, with what is
// left of the walk, and with the half-steps that there are to choose from: medians of the time that
// the processor took [ms].
//   live_growth_study obstacles N...
//   live_growth_study way METRES...
//   live_growth_study half_steps N...
// HRP-2's swept volumes from the user's cache, baked when they are not there.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "experiments/live/past_worlds.h"
#include "experiments/live/prepared_world.h"
#include "experiments/live/replanner.h"
#include "experiments/live/thread_seconds.h"
#include "experiments/run/baked_half_steps.h"
#include "tests/places.h"

namespace {

using namespace halfstep;

constexpr int kRepeats = 9;
constexpr double kPeriod = 0.01;  // of frames [s]

// Of the time that `work` takes [ms].
double Median(const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < kRepeats; ++i) {
    const double begin = ThreadSeconds();
    work();
    times.push_back(1e3 * (ThreadSeconds() - begin));
  }
  std::ranges::nth_element(times, times.begin() + kRepeats / 2);
  return times[kRepeats / 2];
}

// One box stands beside the way, every tenth further one along it 2 to 4 m to the side, the others
// 20 to 60 m away.
Scene Boxes(int count, double way) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    Obstacle box{.name = "box " + std::to_string(i), .shape = Box{{0.2, 0.2, 0.3}}};
    const double part = std::fmod(0.618034 * i, 1.0);
    Eigen::Vector3d p(0.5 * way, 0.6, 0.15);
    if (i > 0 && i % 10 == 0) {
      p = {way * part, (i % 20 == 0 ? 1.0 : -1.0) * (2.0 + 2.0 * part), 0.15};
    } else if (i > 0) {
      p = {(20.0 + 40.0 * part) * std::cos(i), (20.0 + 40.0 * part) * std::sin(i), 0.15};
    }
    box.X_WO.translation() = p;
    scene.obstacles.push_back(box);
  }
  return scene;
}

// After half a minute of frames.
struct Known {
  World last;
  PastWorlds past;
};

Known Watch(const TrueWorld& truth, const LiveOptions& options, std::mt19937_64& random) {
  Known known{.last = Measure(truth, 0.0, options, random), .past = PastWorlds()};
  known.past.Add(known.last);
  for (int frame = 1; frame < 3000; ++frame) {
    World measured = Measure(truth, kPeriod * frame, options, random);
    known.last = Updated(known.last, known.past, std::move(measured), options).world;
    known.past.Add(known.last);
  }
  known.last = Since(known.last, known.last.measured_at);
  return known;
}

// So many half-steps of a set that differ: the one that lands most nearly beside the support sole,
// then always the one that is farthest from those taken.
SweptVolumes Few(const SweptVolumes& all, int count) {
  constexpr double kMetresPerRadian = 0.3;
  const std::vector<Foothold>& places = all.set.placements;
  const auto apart = [](const Foothold& a, const Foothold& b) {
    return std::hypot(a.x - b.x, a.y - b.y, kMetresPerRadian * (a.yaw - b.yaw));
  };
  // From those taken, of each [m].
  std::vector<double> distances(places.size(), INFINITY);
  SweptVolumes few{.set = all.set, .down = {}, .up = {}};
  few.set.placements.clear();
  const auto take = [&](size_t i) {
    few.set.placements.push_back(places[i]);
    few.down.push_back(all.down[i]);
    few.up.push_back(all.up[i]);
    for (size_t k = 0; k < places.size(); ++k) {
      distances[k] = std::min(distances[k], apart(places[k], places[i]));
    }
  };
  const auto off = [](const Foothold& X_SF) {
    return std::abs(X_SF.x) + kMetresPerRadian * std::abs(X_SF.yaw) + 0.1 * std::abs(X_SF.y);
  };
  const auto beside = std::ranges::min_element(places, {}, off);
  take(static_cast<size_t>(beside - places.begin()));
  for (int i = 1; i < std::min(count, all.set.size()); ++i) {
    take(static_cast<size_t>(std::ranges::max_element(distances) - distances.begin()));
  }
  return few;
}

constexpr int kAll = 1 << 20;  // half-steps

void PrintRow(LiveConfig config, int obstacles, double way, int half_steps) {
  config.experiment.goal.X_WG = {way, 0.0, 0.0};
  const Place place = LoadPlace(config.experiment);
  const BakedHalfSteps baked = BakeHalfSteps(place.robot, config.experiment, {});
  const SweptVolumes& volumes = *baked.cached.volumes;
  const SweptVolumes few = half_steps < volumes.set.size() ? Few(volumes, half_steps) : volumes;
  const Replanner replanner(place, config, few);
  const TrueWorld truth(Boxes(obstacles, way), config.experiment.goal, config.live);
  std::mt19937_64 random(1);
  const Known known = Watch(truth, config.live, random);
  const double frame = Median([&] {
    World measured = Measure(truth, 30.0, config.live, random);
    measured = Updated(known.last, known.past, std::move(measured), config.live).world;
  });
  const auto held = std::make_shared<const World>(known.last);
  const double prepare = Median([&] { (void)replanner.Prepare(held); });
  const auto start = StartOf(config.experiment, place.robot, *place.scene.ground);
  const Proposal walk = replanner.Begin(start, *replanner.Prepare(known.last), 0, random);
  if (walk.kind != ProposalKind::kChanged) {
    std::printf("no walk: %s\n", walk.reason.c_str());
    return;
  }
  World next = known.last;
  ++next.version;
  const auto propose = [&](const World& world, bool smoothed, ProposalKind kind) {
    const std::shared_ptr<const PreparedWorld> among = replanner.Prepare(world);
    Situation situation{.plan = walk.plan,
                        .smoothed = std::vector<bool>(walk.smoothed.size(), smoothed),
                        .grant = walk.grant,
                        .robot_through = walk.robot_through,
                        .now = 0.1,
                        .hand_over = 0.2,
                        .world = std::make_shared<const World>(world)};
    return Median([&] {
      const Proposal proposal = replanner.Propose(situation, *among, random);
      if (proposal.kind != kind) {
        std::printf("%s: %s\n", std::string(Name(proposal.kind)).c_str(), proposal.reason.c_str());
      }
    });
  };
  const double check = propose(next, true, ProposalKind::kSafe);
  const double smooth = propose(next, false, ProposalKind::kSmoothed) - check;
  World moved = next;
  moved.goal.X_WG.y += 0.4;
  const double change = propose(moved, true, ProposalKind::kChanged) - check;
  moved.goal.X_WG.x = -1000.0;
  const double vain = propose(moved, true, ProposalKind::kUnsafe) - check;
  std::printf("| %d | %d | %d | %.3f | %.2f | %.1f | %.1f | %.1f | %.1f |\n", obstacles,
              few.set.size(), walk.plan.sequence.size(), frame, prepare, check, change, smooth,
              vain);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string grows = argc > 1 ? argv[1] : "";
  LiveConfig config = LoadLiveConfig(InSources("experiments/episodes/live_bar.yaml"), {});
  config.live.script.clear();
  std::printf(
      "| obstacles | of the set | half-steps | frame | prepare | check | plan | smooth | "
      "search in vain |\n|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 2; i < argc; ++i) {
    const bool obstacles = grows == "obstacles", half_steps = grows == "half_steps";
    PrintRow(config, obstacles ? std::stoi(argv[i]) : 10,
             obstacles || half_steps ? 2.4 : std::stod(argv[i]),
             half_steps ? std::stoi(argv[i]) : kAll);
  }
  return 0;
}
