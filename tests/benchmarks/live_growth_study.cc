// How the cost of replanning grows with the obstacles, most of which are far away, and with what is
// left of the walk: medians of the time that the processor took [ms].
//   live_growth_study obstacles N...
//   live_growth_study way METRES...
// HRP-2's swept volumes from the user's cache, baked when they are not there.

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "experiments/live/past_worlds.h"
#include "experiments/live/prepared_world.h"
#include "experiments/live/replanner.h"
#include "experiments/run/baked_half_steps.h"
#include "tests/places.h"

namespace {

using namespace halfstep;

constexpr int kRepeats = 9;
constexpr double kPeriod = 0.01;  // of frames [s]

double ProcessorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Of the time that `work` takes [ms].
double Median(const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < kRepeats; ++i) {
    const double begin = ProcessorSeconds();
    work();
    times.push_back(1e3 * (ProcessorSeconds() - begin));
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

void PrintRow(LiveConfig config, int obstacles, double way) {
  config.experiment.goal.X_WG = {way, 0.0, 0.0};
  const Place place = LoadPlace(config.experiment);
  const BakedHalfSteps baked = BakeHalfSteps(place.robot, config.experiment, {});
  const Replanner replanner(place, config, *baked.cached.volumes);
  const TrueWorld truth(Boxes(obstacles, way), config.experiment.goal, config.live);
  std::mt19937_64 random(1);
  const Known known = Watch(truth, config.live, random);
  const double frame = Median([&] {
    World measured = Measure(truth, 30.0, config.live, random);
    measured = Updated(known.last, known.past, std::move(measured), config.live).world;
  });
  const double prepare = Median([&] { (void)replanner.Prepare(known.last); });
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
  std::printf("| %d | %d | %.3f | %.2f | %.1f | %.1f | %.1f | %.1f |\n", obstacles,
              walk.plan.sequence.size(), frame, prepare, check, change, smooth, vain);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bool obstacles = argc > 1 && std::string(argv[1]) == "obstacles";
  LiveConfig config = LoadLiveConfig(InSources("experiments/episodes/live_bar.yaml"), {});
  config.live.script.clear();
  std::printf(
      "| obstacles | half-steps | frame | prepare | check | plan | smooth | search in vain |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (int i = 2; i < argc; ++i) {
    PrintRow(config, obstacles ? std::stoi(argv[i]) : 10, obstacles ? 2.4 : std::stod(argv[i]));
  }
  return 0;
}
