// Episodes drawn at random, in lockstep: one row an episode, then what the bench asks.
//   live_study [FIRST [COUNT [POLICY [events]]]]
// Default: seeds 1 … 100, policy replan. The policy `wall` is replan by the wall clock.
// HRP-2's swept volumes from the user's cache, baked when they are not there.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/live/episode_summary.h"
#include "experiments/run/planning.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/benchmarks/random_episode.h"

namespace {

using namespace halfstep;

// The duration of a walk that knew from the beginning how everything ends; 0: there is none.
// `exactly`: without what the robot must assume of errors and speeds.
double Clairvoyant(const Replanner& replanner, const TrueWorld& truth,
                   const std::array<Footprint, 2>& start, std::uint64_t seed, bool exactly) {
  LiveOptions options = replanner.config().live;
  options.sensing.noise = 0.0;
  std::mt19937_64 random(seed);
  World world = Measure(truth, truth.end() + 1.0, options, random);
  for (Obstacle& obstacle : world.scene.obstacles) {
    if (exactly) obstacle.motion = {};
    if (options.sensing.rests_after) obstacle.motion.speed = 0.0;
  }
  const Proposal walk =
      replanner.Begin(start, *replanner.Prepare(Since(world, world.measured_at)), 1000, random);
  return walk.kind == ProposalKind::kUnsafe ? 0.0 : DurationOf(walk.plan.parameters);
}

struct Physics {
  double jump = 0.0;      // of value, first and second derivative where walks meet
  double residual = 0.0;  // of p = c − c̈/ω² [m]
};

Physics Examine(const Episode& episode) {
  Physics physics;
  const SuperposedWalk walk = episode.Executed();
  const double omega = walk.lipm().omega();
  const auto jump = [&](double t) {
    // The change over 2h, less what the derivatives of either side make of it: twice the change
    // over 2h less that over 4h.
    const double h = 1e-12;
    const WalkJet a = walk.At(t - h), b = walk.At(t + h);
    const WalkJet c = walk.At(t - 2 * h), d = walk.At(t + 2 * h);
    const auto of = [](const WalkState& near, const WalkState& far) {
      return (2.0 * near - far).cwiseAbs().maxCoeff();
    };
    physics.jump = std::max({physics.jump, of(b.value - a.value, d.value - c.value),
                             of(b.first - a.first, d.first - c.first),
                             of(b.second - a.second, d.second - c.second)});
  };
  for (const ExecutedWalk& one : episode.walks) jump(one.t);
  for (int i = 0; i < walk.num_half_steps(); ++i) jump(walk.start_of(i));
  for (double t = 0.0; t < walk.duration(); t += 0.01) {
    const WalkJet jet = walk.At(t);
    for (int axis = 0; axis < 2; ++axis) {
      const double zmp = jet.value[kComX + axis] - jet.second[kComX + axis] / (omega * omega);
      physics.residual = std::max(physics.residual, std::abs(zmp - jet.value[kZmpX + axis]));
    }
  }
  return physics;
}

// Whether an obstacle did what was not to be expected of it shortly before t: it jumped, or was
// taken to rest and moved.
bool BrokeItsBounds(const Episode& episode, const std::string& obstacle, double t) {
  constexpr double kBefore = 3.0;  // [s] a half-step, and what it takes to notice
  bool known = false;
  for (const EpisodeEvent& event : episode.events) {
    known = known || (event.what == "contradicted" && event.text == obstacle &&
                      event.t > t - kBefore && event.t < t + kBefore);
  }
  return known;
}

// Stops at random times: how many of them come to rest with every margin kept in the world that
// allowed the latest half-step to begin. Proved, half-step by half-step.
int SafeStops(const Episode& episode, const Place& place, const LiveConfig& config, int stops,
              std::mt19937_64& random) {
  const SuperposedWalk walk = episode.Executed();
  std::vector<int> safe(episode.begun.size(), -1);  // by half-step; −1: not looked at
  std::uniform_real_distribution<double> time(0.0, std::min(walk.duration(), episode.end));
  int kept = 0;
  for (int i = 0; i < stops; ++i) {
    const auto k = static_cast<size_t>(walk.Locate(time(random)).half_step);
    if (safe[k] < 0) {
      const Grant& grant = episode.grants[static_cast<size_t>(episode.begun[k].grant)].grant;
      const auto world = std::ranges::find(episode.worlds, grant.version, &World::version);
      const MarginEvaluator evaluator(place.robot, world->scene,
                                      config.experiment.smoothing.limits);
      const CertifiedFeasibility test(evaluator, config.experiment.smoothing.certification);
      MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
      const SuperposedWalk branch = walk.StopBranch(static_cast<int>(k));
      const double from = std::max(grant.proved_at, branch.start_of(static_cast<int>(k)));
      safe[k] =
          test.Check(branch, {from, branch.duration()}, &scratch).verdict == Verdict::kFeasible;
    }
    kept += safe[k];
  }
  return kept;
}

double At(std::vector<double> values, double part) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  return values[std::min(values.size() - 1,
                         static_cast<size_t>(part * static_cast<double>(values.size())))];
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::stoull(argv[1]) : 1;
  const std::uint64_t count = argc > 2 ? std::stoull(argv[2]) : 100;
  LiveConfig base = LoadLiveConfig(HALFSTEP_SOURCE_DIR "/experiments/episodes/live_bar.yaml", {});
  base.live.policy = argc > 3 ? argv[3] : "replan";
  if (base.live.policy == "wall") {
    base.live.policy = "replan";
    base.live.clock = "wall";
  }
  base.live.longest = 90.0;
  const bool wall = base.live.clock == "wall";
  const Place place = LoadPlace(base.experiment);
  const BakedHalfSteps baked = BakeHalfSteps(place.robot, base.experiment, {});
  const auto start = StartOf(base.experiment, place.robot);
  std::vector<double> latencies, longer;
  int reachable = 0, arrived = 0, touched = 0, excused = 0, changes = 0, quick = 0, against = 0,
      free = 0, free_arrived = 0;
  constexpr int kStops = 100;  // an episode
  int stops = 0, safe_stops = 0;
  Physics worst;
  std::printf(
      "seed,ending,reachable,duration_s,clairvoyant_s,changed,stops,unsafe,nearest_m,nearest,cpu_"
      "s\n");
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const RandomEpisode drawn = DrawEpisode(base, seed);
    const TrueWorld truth(drawn.scene, drawn.config.experiment.goal, drawn.config.live);
    const Replanner replanner(place.robot, drawn.config, *baked.cached.volumes);
    const double ideal = Clairvoyant(replanner, truth, start, seed, true);
    const bool can = Clairvoyant(replanner, truth, start, seed, false) > 0.0;
    const std::clock_t begin = std::clock();
    const Episode episode =
        wall ? RunWallClock(replanner, truth, start, {}) : RunLockstep(replanner, truth, start, {});
    const double cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (argc > 4) {
      for (const EpisodeEvent& event : episode.events) {
        if (event.what == "measured") continue;
        std::printf("# %.3f %s world %d walk %d half-step %d %s\n", event.t, event.what.c_str(),
                    event.version, event.walk, event.half_step + 1, event.text.c_str());
      }
    }
    const EpisodeSummary summary = Summarize(episode, truth, place.robot);
    if (!episode.walks.empty()) {
      std::mt19937_64 random(seed);
      safe_stops += SafeStops(episode, place, drawn.config, kStops, random);
      stops += kStops;
      const Physics physics = Examine(episode);
      worst.jump = std::max(worst.jump, physics.jump);
      worst.residual = std::max(worst.residual, physics.residual);
    }
    const bool touches = summary.nearest.distance <= 0.0;
    const bool broken =
        touches && BrokeItsBounds(episode, summary.nearest.obstacle, summary.nearest.t);
    touched += touches && !broken;
    excused += broken;
    reachable += can;
    const bool pressed =
        NearestApproach(episode, truth.Since(episode.waited), place.robot, 0.05, 0.3, true)
            .distance <= 0.0;
    against += pressed;
    const bool there = episode.ending == EpisodeEnding::kArrived;
    arrived += there && can;
    if (can && !pressed && drawn.config.live.sensing.rests_after) {
      ++free;
      free_arrived += there;
    }
    if (there && ideal > 0.0) longer.push_back(summary.duration / ideal - 1.0);
    latencies.insert(latencies.end(), summary.latencies.begin(), summary.latencies.end());
    for (const int begun : summary.begun_meanwhile) {
      ++changes;
      quick += begun <= 1;
    }
    std::printf("%llu,%s,%d,%.2f,%.2f,%d,%d,%d,%.4f,%s%s,%.2f\n",
                static_cast<unsigned long long>(seed), summary.ending.c_str(), can,
                summary.duration, ideal, summary.changed, summary.stops, summary.unsafe,
                summary.nearest.distance, summary.nearest.obstacle.c_str(),
                broken ? " (broke its bounds)" : "", cpu);
    std::fflush(stdout);
  }
  std::printf("touched %d, by obstacles that broke their bounds %d\n", touched, excused);
  std::printf("latency median %.3f s, p99 %.3f s of %zu\n", At(latencies, 0.5), At(latencies, 0.99),
              latencies.size());
  std::printf("begun meanwhile: at most 1 in %d of %d\n", quick, changes);
  std::printf("arrived %d of %d that can be reached\n", arrived, reachable);
  std::printf(
      "of these, where what stays is taken to rest and nothing was put against the robot: "
      "%d of %d\n",
      free_arrived, free);
  std::printf("an obstacle was put against the standing or walking robot: %d\n", against);
  std::printf("longer than clairvoyant: median %.1f %%, p90 %.1f %%\n", 100.0 * At(longer, 0.5),
              100.0 * At(longer, 0.9));
  std::printf("stops at random times that come to rest, certified: %d of %d\n", safe_stops, stops);
  std::printf("largest jump %.2g, LIPM residual %.2g m\n", worst.jump, worst.residual);
  return touched == 0 ? 0 : 1;
}
