#include "tests/benchmarks/studied_episode.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "experiments/live/episode_clock.h"
#include "experiments/live/episode_loop.h"
#include "experiments/live/episode_summary.h"
#include "experiments/live/episode_tables.h"
#include "experiments/live/episode_touch.h"
#include "experiments/live/near_rest.h"
#include "experiments/live/sensor.h"
#include "experiments/live/thinker.h"
#include "experiments/live/thread_seconds.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/benchmarks/random_episode.h"
#include "wpg/files/sha256.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

// Keeps what every answer cost.
class MeteredThinker final : public Thinker {
 public:
  MeteredThinker(Thinker* of, std::vector<Answered>* answers) : of_(*of), answers_(*answers) {}

  void Ask(Situation situation) override {
    const double begin = ThreadSeconds();
    of_.Ask(std::move(situation));
    asking_ = ThreadSeconds() - begin;
  }
  std::optional<Proposal> Answer(double now) override {
    std::optional<Proposal> answer = of_.Answer(now);
    if (answer) answers_.push_back({answer->kind, answer->effort, answer->seconds, asking_});
    return answer;
  }
  void Hurry(double now) override { of_.Hurry(now); }

 private:
  Thinker& of_;
  std::vector<Answered>& answers_;
  double asking_ = 0.0;
};

// RunLockstep or RunWallClock, as the config has it, and what the answers cost.
Episode Run(const Replanner& replanner, Sensor* sensor, const std::array<Foothold, 2>& start,
            std::vector<Answered>* answers) {
  const auto seed = static_cast<std::uint64_t>(replanner.config().experiment.seed);
  const EpisodeHooks hooks{};
  if (replanner.config().live.clock == "wall") {
    ThreadThinker thinker(replanner, seed);
    MeteredThinker metered(&thinker, answers);
    WallClock clock;
    return EpisodeLoop(replanner, sensor, &metered, &clock, hooks).Run(start);
  }
  LockstepThinker thinker(replanner, seed);
  MeteredThinker metered(&thinker, answers);
  EpisodeClock clock;
  return EpisodeLoop(replanner, sensor, &metered, &clock, hooks).Run(start);
}

// The duration of a walk that knew from the beginning how everything ends, with the overlaps of so
// many junctions; 0: there is none. `exactly`: without what the robot must assume of errors and
// speeds.
double Clairvoyant(const Replanner& replanner, const TrueWorld& truth,
                   const std::array<Foothold, 2>& start, std::uint64_t seed, bool exactly,
                   int junctions) {
  LiveOptions options = replanner.config().live;
  options.sensing.noise = 0.0;
  std::mt19937_64 random(seed);
  World world = Measure(truth, truth.end() + 1.0, options, random);
  for (Obstacle& obstacle : world.scene.obstacles) {
    if (exactly) obstacle.motion = {};
    if (options.sensing.rests_after) obstacle.motion.speed = 0.0;
  }
  const Proposal walk = replanner.Begin(start, *replanner.Prepare(Since(world, world.measured_at)),
                                        junctions, random);
  return walk.kind == ProposalKind::kUnsafe ? 0.0 : DurationOf(walk.plan.parameters);
}

// How smooth the executed motion is.
void ExamineMotion(const Episode& episode, StudiedEpisode* studied) {
  const SuperposedWalk walk = episode.Executed();
  const double omega = dynamic_cast<const Lipm&>(walk.model()).omega();
  const auto jump = [&](double t) {
    // The change over 2h, less what the derivatives of either side make of it: twice the change
    // over 2h less that over 4h.
    const double h = 1e-12;
    const WalkJet a = walk.At(t - h), b = walk.At(t + h);
    const WalkJet c = walk.At(t - 2 * h), d = walk.At(t + 2 * h);
    const auto of = [](const WalkState& near, const WalkState& far) {
      return (2.0 * near - far).cwiseAbs().maxCoeff();
    };
    studied->jump = std::max({studied->jump, of(b.value - a.value, d.value - c.value),
                              of(b.first - a.first, d.first - c.first),
                              of(b.second - a.second, d.second - c.second)});
  };
  for (const ExecutedWalk& one : episode.walks) jump(one.t);
  for (int i = 0; i < walk.num_half_steps(); ++i) jump(walk.start_of(i));
  for (double t = 0.0; t < walk.duration(); t += 0.01) {
    const WalkJet jet = walk.At(t);
    for (int axis = 0; axis < 2; ++axis) {
      const double zmp = jet.value[kComX + axis] - jet.second[kComX + axis] / (omega * omega);
      studied->residual = std::max(studied->residual, std::abs(zmp - jet.value[kZmpX + axis]));
    }
  }
}

// Whether an obstacle did what was not to be expected of it shortly before t: it jumped, or was
// taken to rest and moved.
bool BrokeItsBounds(const Episode& episode, const std::string& obstacle, double t) {
  constexpr double kBefore = 3.0;  // [s] a half-step, and what it takes to notice
  bool known = false;
  for (const EpisodeEvent& event : episode.events) {
    known = known || (event.what == "contradicted" && event.text.starts_with(obstacle + ": ") &&
                      event.t > t - kBefore && event.t < t + kBefore);
  }
  return known;
}

// Whether the walk that is cut after half-step k, which has begun, comes to rest with every margin
// kept in the world that allowed that half-step to begin: proved. A half-step that draws away from
// an obstacle is held to what NearRest demands of it.
bool ComesToRest(const Episode& episode, const SuperposedWalk& branch, size_t k,
                 const LiveStudy& study) {
  const Grant& grant = episode.grants[static_cast<size_t>(episode.begun[k].grant)].grant;
  const auto world = std::ranges::find(episode.worlds, grant.version, &World::version);
  const ExperimentConfig& config = study.base.experiment;
  const int half_step = static_cast<int>(k);
  const double from = branch.start_of(half_step);
  const SafetyCheck among(study.place.robot, world->scene, config);
  const bool draws_away = std::ranges::count(grant.near, half_step) > 0;
  const std::optional<NearRest> near =
      draws_away ? NearRest::At(among, config, branch, half_step, from) : std::nullopt;
  const MarginEvaluator& evaluator = near ? near->safety().evaluator() : among.evaluator();
  const CertifiedFeasibility test(evaluator, config.smoothing.certification);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  return test.Check(branch, {from, branch.duration()}, &scratch).verdict == Verdict::kFeasible;
}

// Stops at random times while the robot walks: nothing more begins from then on.
void StopAtRandom(const Episode& episode, const LiveStudy& study, StudiedEpisode* studied) {
  std::mt19937_64 random(studied->seed);
  const SuperposedWalk walk = episode.Executed();
  enum class Branch { kNotLookedAt, kSafe, kUnsafe };
  std::vector<Branch> branches(episode.begun.size(), Branch::kNotLookedAt);
  std::uniform_real_distribution<double> time(0.0, std::min(walk.duration(), episode.end));
  for (int i = 0; i < study.stops; ++i) {
    const double t = time(random);
    size_t k = 0;  // the latest half-step that has begun at t
    while (k + 1 < branches.size() && walk.start_of(static_cast<int>(k) + 1) <= t) ++k;
    const SuperposedWalk branch = walk.StopBranch(static_cast<int>(k));
    if (branches[k] == Branch::kNotLookedAt) {
      branches[k] = ComesToRest(episode, branch, k, study) ? Branch::kSafe : Branch::kUnsafe;
    }
    ++studied->stops;
    studied->safe_stops += branches[k] == Branch::kSafe;
    studied->longest_stop = std::max(studied->longest_stop, branch.duration() - t);
  }
}

// When the world was measured against which the first of the searches failed that found nothing
// before the hand-over at t [s]; `otherwise` when there was none.
double UnsafeSince(const Episode& episode, double t, double otherwise) {
  double since = otherwise;
  bool in_vain = false;
  for (const EpisodeEvent& event : episode.events) {
    if (event.t >= t) break;
    if (event.what == "handed_over") in_vain = false;
    if (event.what != "unsafe" || in_vain) continue;
    in_vain = true;
    const auto grant = std::ranges::find(episode.grants, event.t, &EpisodeGrant::t);
    since = std::ranges::find(episode.worlds, grant->grant.version, &World::version)->measured_at;
  }
  return in_vain ? since : otherwise;
}

void Time(const Episode& episode, StudiedEpisode* studied) {
  for (size_t k = 1; k < episode.walks.size(); ++k) {
    const ExecutedWalk& walk = episode.walks[k];
    if (walk.kind == ProposalKind::kSmoothed) studied->smoothing.push_back(walk.smooth_s);
    if (walk.kind != ProposalKind::kChanged) continue;
    studied->latencies.push_back(
        {.whole = walk.t - walk.measured,
         .age = walk.asked - walk.measured,
         .answer = walk.t - walk.asked,
         .check = walk.check_s,
         .plan = walk.plan_s,
         .since_unsafe = walk.t - UnsafeSince(episode, walk.t, walk.measured)});
  }
}

}  // namespace

WalkedEpisode WalkOnly(const LiveStudy& study, std::uint64_t seed) {
  const RandomEpisode drawn = DrawEpisode(study.base, seed);
  const LiveOptions& live = drawn.config.live;
  const TrueWorld truth(drawn.scene, drawn.config.experiment.goal, live);
  const Replanner replanner(study.place, drawn.config, *study.baked.cached.volumes);
  StandInSensor sensor(truth, live, static_cast<std::uint64_t>(drawn.config.experiment.seed) + 1);
  WalkedEpisode walked;
  walked.episode = Run(replanner, &sensor, study.start, &walked.answers);
  std::string text;
  for (const EpisodeTable& table : EpisodeTables(walked.episode, {})) {
    if (table.name != "timings") text += table.file.text;
  }
  for (size_t walk = 0; walk < walked.episode.walks.size(); ++walk) {
    for (const EpisodeTable& table : WalkTables(walked.episode, walk)) text += table.file.text;
  }
  walked.tables = Sha256(text);
  return walked;
}

StudiedEpisode WalkEpisode(const LiveStudy& study, std::uint64_t seed) {
  const RandomEpisode drawn = DrawEpisode(study.base, seed);
  const LiveOptions& live = drawn.config.live;
  const TrueWorld truth(drawn.scene, drawn.config.experiment.goal, live);
  const Replanner replanner(study.place, drawn.config, *study.baked.cached.volumes);
  StandInSensor sensor(truth, live, static_cast<std::uint64_t>(drawn.config.experiment.seed) + 1);
  StudiedEpisode studied;
  studied.seed = seed;
  studied.rests = live.sensing.rests_after.has_value();
  studied.clairvoyant = Clairvoyant(replanner, truth, study.start, seed, true, 1000);
  studied.reachable = Clairvoyant(replanner, truth, study.start, seed, false, 0) > 0.0;
  const double begin = ThreadSeconds();
  const Episode episode = Run(replanner, &sensor, study.start, &studied.answers);
  studied.cpu = ThreadSeconds() - begin;
  const TrueWorld seen = truth.Since(episode.waited);
  const EpisodeSummary summary = Summarize(episode, &seen, study.place.robot);
  studied.ending = episode.ending;
  studied.waited = episode.waited;
  studied.duration = episode.end;
  studied.changed = summary.changed;
  studied.stopped = summary.stops;
  studied.unsafe = summary.unsafe;
  studied.nearest = summary.nearest->distance;
  studied.nearest_obstacle = summary.nearest->obstacle;
  studied.begun_meanwhile = summary.begun_meanwhile;
  studied.events = episode.events;
  if (episode.walks.empty()) return studied;
  studied.excused =
      studied.touched() && BrokeItsBounds(episode, summary.nearest->obstacle, summary.nearest->t);
  studied.pressed =
      NearestApproach(episode, seen, study.place.robot, 0.05, 0.3, /*also_at_rest=*/true)
          .distance <= 0.0;
  Time(episode, &studied);
  StopAtRandom(episode, study, &studied);
  ExamineMotion(episode, &studied);
  return studied;
}

}  // namespace halfstep
