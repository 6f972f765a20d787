#include "experiments/live/episode.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "wpg/files/text.h"

namespace halfstep {

std::string_view Name(EpisodeEnding ending) {
  switch (ending) {
    case EpisodeEnding::kArrived:
      return "arrived";
    case EpisodeEnding::kStuck:
      return "stuck";
    case EpisodeEnding::kTooLong:
      return "too_long";
    case EpisodeEnding::kNoPlan:
      return "no_plan";
    case EpisodeEnding::kInterrupted:
      return "interrupted";
  }
  return "";
}

SuperposedWalk Episode::Executed() const {
  const SuperposedWalk walk = walks.back().plan.Walk();
  return stopped ? walk.StopBranch(begun.back().half_step) : walk;
}

namespace {

bool SameGoal(const GoalRegion& a, const GoalRegion& b) {
  return a.X_WG.x == b.X_WG.x && a.X_WG.y == b.X_WG.y;
}

// Whether the world is so different from the one that was looked at last that it has to be looked
// at again, although nothing is void.
bool DiffersClearly(const World& a, const World& b) {
  constexpr double kClear = 0.01;  // [m]
  if (a.scene.obstacles.size() != b.scene.obstacles.size() || !SameGoal(a.goal, b.goal))
    return true;
  for (size_t i = 0; i < a.scene.obstacles.size(); ++i) {
    const Obstacle &x = a.scene.obstacles[i], &y = b.scene.obstacles[i];
    const double moved = (x.X_WO.translation() - y.X_WO.translation()).norm();
    if (x.name != y.name || x.motion.speed != y.motion.speed ||
        moved > x.motion.error + y.motion.error + kClear)
      return true;
  }
  return false;
}

class Lockstep {
 public:
  Lockstep(const Replanner& replanner, const TrueWorld& truth, const EpisodeHooks& hooks)
      : replanner_(replanner),
        options_(replanner.config().live),
        truth_(truth),
        hooks_(hooks),
        noise_(static_cast<std::uint64_t>(replanner.config().experiment.seed) + 1),
        random_(static_cast<std::uint64_t>(replanner.config().experiment.seed)) {}

  Episode Run(const std::array<Footprint, 2>& start) {
    const Proposal first = Wait(start);
    if (first.kind == ProposalKind::kUnsafe) {
      record_.message = first.reason;
      return std::move(record_);
    }
    executor_.emplace(first.plan, first.grant);
    smoothed_ = first.smoothed;
    robot_through_ = first.robot_through;
    checked_ = last_tried_ = world_;
    HandOver(first, 0.0, 0.0);
    Begins(0);
    for (long tick = 0;; ++tick) {
      const double now = static_cast<double>(tick) * options_.period;
      if (hooks_.progress) hooks_.progress(now);
      Sense(now);
      if (job_ && now >= job_->ready) Finish(now);
      Advance(now);
      if (!job_ && NeedsWork(now)) Start(now);
      if (Ends(now)) break;
    }
    return std::move(record_);
  }

 private:
  struct Job {
    double asked = 0.0, ready = 0.0;
    std::shared_ptr<const World> world;
    Proposal proposal = {};
  };

  // Measures until there is a walk, which begins at the time that is t = 0 from then on.
  Proposal Wait(const std::array<Footprint, 2>& start) {
    std::vector<World> worlds = {Measure(truth_, 0.0, options_, noise_)};
    std::optional<World> tried;
    Proposal first{.kind = ProposalKind::kUnsafe};
    for (long frame = 0; first.kind == ProposalKind::kUnsafe; ++frame) {
      const double now = static_cast<double>(frame) * options_.sensing.period;
      if (now > options_.longest || hooks_.stop.stop_requested()) break;
      if (frame > 0) {
        worlds.push_back(Updated(worlds, Measure(truth_, now, options_, noise_), options_).world);
      }
      if (tried && !DiffersClearly(*tried, worlds.back())) continue;
      tried = worlds.back();
      world_ = std::make_shared<const World>(Since(worlds.back(), now));
      first = replanner_.Begin(start, *replanner_.Prepare(*world_), options_.smooth_ahead, random_);
      record_.waited = now;
    }
    truth_ = truth_.Since(record_.waited);
    // What obstacles may do at t = 0 follows from where they were before.
    for (World& world : worlds) {
      record_.worlds.push_back(Since(std::move(world), record_.waited));
      record_.known.push_back(record_.worlds.back().measured_at);
    }
    return first;
  }

  void Tell(double t, const std::string& what, const std::string& text, int half_step = -1) {
    record_.events.push_back({.t = t,
                              .what = what,
                              .version = world_->version,
                              .walk = static_cast<int>(record_.walks.size()) - 1,
                              .half_step = half_step,
                              .text = text});
  }

  void Know(double t) {
    record_.worlds.push_back(*world_);
    record_.known.push_back(t);
  }

  // Frames that were taken and have arrived by now.
  void Sense(double now) {
    const SensingConfig& sensing = options_.sensing;
    std::uniform_real_distribution<double> part(0.0, 1.0);
    while (true) {
      const double taken = static_cast<double>(frame_ + 1) * sensing.period;
      if (taken + sensing.delay > now) return;
      ++frame_;
      World frame = Measure(truth_, taken, options_, noise_);
      const bool lost = part(noise_) < sensing.lost;
      if (lost || !truth_.IsSeen(taken)) {
        Tell(now, "lost", Formatted("frame of %.3f s", taken));
        continue;
      }
      WorldUpdate update = Updated(record_.worlds, std::move(frame), options_);
      world_ = std::make_shared<const World>(std::move(update.world));
      Know(now);
      Tell(now, "measured", Formatted("frame of %.3f s", taken));
      for (const std::string& name : update.contradictions) Tell(now, "contradicted", name);
      if (executor_->grant().version < world_->sound_since) executor_->Revoke();
    }
  }

  void Advance(double now) {
    const bool stopped = executor_->stopped();
    for (const int half_step : executor_->Advance(now + options_.period)) Begins(half_step);
    if (executor_->stopped() && !stopped) {
      Tell(now, "stopped", Formatted("at rest from %.3f s on", executor_->rests_from()),
           executor_->begun());
    }
  }

  void Begins(int half_step) {
    record_.begun.push_back({half_step, static_cast<int>(record_.grants.size()) - 1});
    Tell(executor_->walk().start_of(half_step), "begins", "", half_step);
    again_ = true;  // more junctions are near
  }

  bool NeedsWork(double now) const {
    if (again_ || world_->sound_since > checked_->version) return true;
    if (world_->version == checked_->version) return false;
    if (DiffersClearly(*checked_, *world_)) return true;
    if (stuck_) return now >= asked_ + kRetry;
    // What was proved runs out, for a half-step that begins soon.
    const SuperposedWalk& walk = executor_->walk();
    const int next = std::min(executor_->begun() + 1, walk.num_half_steps() - 1);
    return walk.start_of(next) < now + kAhead &&
           executor_->grant().valid_until < walk.end_of(next) + options_.period;
  }

  // Prepared once for each version that is asked about.
  std::shared_ptr<const PreparedWorld> Prepared() {
    if (!prepared_ || prepared_for_ != world_) prepared_ = replanner_.Prepare(*world_);
    prepared_for_ = world_;
    return prepared_;
  }

  void Start(double now) {
    const BudgetConfig& budget = options_.budget;
    const double longest = budget.check + std::max(budget.plan, budget.smooth);
    const Situation situation{.plan = executor_->plan(),
                              .smoothed = smoothed_,
                              .grant = executor_->grant(),
                              .robot_through = robot_through_,
                              .begun = executor_->begun(),
                              .stopped = executor_->stopped(),
                              .now = now,
                              .hand_over = now + longest + 2.0 * options_.period,
                              .world = Prepared(),
                              .shorten = tries_ > 0};
    job_.emplace(Job{.asked = now, .world = world_});
    job_->proposal = replanner_.Propose(situation, random_);
    const Proposal& proposal = job_->proposal;
    const bool planned = proposal.planned.status != PlanStatus::kNotRun;
    job_->ready = now + budget.check + (planned ? budget.plan : 0.0) +
                  (proposal.kind == ProposalKind::kSmoothed ? budget.smooth : 0.0);
    asked_ = now;
  }

  void Finish(double now) {
    const Job job = std::move(*job_);
    job_.reset();
    checked_ = job.world;
    const Proposal& proposal = job.proposal;
    again_ = false;
    stuck_ = proposal.kind == ProposalKind::kUnsafe;
    if (world_->sound_since > job.world->version) {
      Tell(now, "refused", "the world has changed meanwhile");
      again_ = true;
      return;
    }
    if (DiffersClearly(*last_tried_, *job.world)) tries_ = kTries;
    last_tried_ = job.world;
    const bool successor = proposal.first_changed >= 0 && !stuck_;
    if (!successor) {
      const bool tried = proposal.planned.status != PlanStatus::kNotRun;
      if (tried && !stuck_) --tries_;
      again_ = tried && !stuck_ && tries_ > 0;
      if (stuck_) Tell(now, "unsafe", proposal.reason, proposal.grant.through);
      robot_through_ = proposal.robot_through;
      executor_->Take(proposal.grant);
      record_.grants.push_back({now, static_cast<int>(record_.walks.size()) - 1, proposal.grant});
      return;
    }
    const std::string refused = executor_->TakeOver(proposal.plan, proposal.grant, now);
    again_ = true;
    if (!refused.empty()) {
      Tell(now, "refused", refused);
      return;
    }
    smoothed_ = proposal.smoothed;
    robot_through_ = proposal.robot_through;
    HandOver(proposal, now, job.asked);
  }

  void HandOver(const Proposal& proposal, double now, double asked) {
    record_.walks.push_back({.t = now,
                             .kind = proposal.kind,
                             .reason = proposal.reason,
                             .plan = proposal.plan,
                             .first_changed = proposal.first_changed,
                             .asked = asked,
                             .measured = checked_->measured_at,
                             .check_s = proposal.check_s,
                             .plan_s = proposal.plan_s,
                             .smooth_s = proposal.smooth_s});
    record_.grants.push_back({now, static_cast<int>(record_.walks.size()) - 1, proposal.grant});
    Tell(now, "handed_over", std::string(Name(proposal.kind)) + ": " + proposal.reason,
         proposal.first_changed);
  }

  bool Ends(double now) {
    const bool at_rest = executor_->rests_from() <= now;
    const bool over = now >= options_.longest;
    const bool interrupted = hooks_.stop.stop_requested();
    const std::array<Footprint, 2> stance =
        StanceAfter(executor_->plan().sequence, executor_->begun());
    const bool on_both = executor_->begun() % 2 == 1;
    const bool arrived = at_rest && on_both && now > truth_.end() + options_.sensing.period &&
                         truth_.GoalAt(now).ContainsStance(stance) &&
                         world_->goal.ContainsStance(stance);
    if (!arrived && !over && !interrupted) return false;
    record_.ending = arrived       ? EpisodeEnding::kArrived
                     : interrupted ? EpisodeEnding::kInterrupted
                     : at_rest     ? EpisodeEnding::kStuck
                                   : EpisodeEnding::kTooLong;
    record_.end = now;
    record_.stopped = executor_->stopped();
    return true;
  }

  static constexpr int kTries = 3;       // to find a shorter way, after each change of the world
  static constexpr double kRetry = 0.5;  // after a search that found no way [s]
  static constexpr double kAhead = 0.3;  // proofs are renewed so long before they are needed [s]

  const Replanner& replanner_;
  const LiveOptions& options_;
  TrueWorld truth_;
  const EpisodeHooks& hooks_;
  std::mt19937_64 noise_, random_;
  Episode record_;
  std::shared_ptr<const World> world_, checked_, last_tried_;
  std::shared_ptr<const World> prepared_for_;
  std::shared_ptr<const PreparedWorld> prepared_;
  std::optional<Executor> executor_;
  std::vector<bool> smoothed_;
  int robot_through_ = -1;
  std::optional<Job> job_;
  long frame_ = 0;
  bool again_ = true, stuck_ = false;
  int tries_ = 0;
  double asked_ = 0.0;
};

}  // namespace

Episode RunLockstep(const Replanner& replanner, const TrueWorld& truth,
                    const std::array<Footprint, 2>& start, const EpisodeHooks& hooks) {
  return Lockstep(replanner, truth, hooks).Run(start);
}

}  // namespace halfstep
