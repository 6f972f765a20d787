#include "experiments/live/episode_loop.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "experiments/live/near_rest.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr int kTries = 3;  // to find a shorter way, after each clear change of the world
// After a search that found no way, when the robot rests in much the same world [s].
constexpr double kLongestRetry = 3.2;
constexpr double kAhead = 0.3;  // proofs are renewed so long before they are needed [s]

}  // namespace

EpisodeLoop::EpisodeLoop(const Replanner& replanner, Sensor* sensor, Thinker* thinker,
                         EpisodeClock* clock, const EpisodeHooks& hooks)
    : replanner_(replanner),
      options_(replanner.config().live),
      sensor_(*sensor),
      thinker_(*thinker),
      clock_(*clock),
      hooks_(hooks),
      patience_(options_.budget.check + std::max(options_.budget.plan, options_.budget.smooth)) {}

Episode EpisodeLoop::Run(const std::array<Foothold, 2>& start) {
  const Proposal first = Wait(start);
  if (first.kind == ProposalKind::kUnsafe) {
    record_.message = first.reason;
    if (IsToEnd()) record_.message += "; it was ended before there was a walk";
    return std::move(record_);
  }
  executor_.emplace(first.plan, first.grant);
  asked_about_ = checked_ = world_;
  HandOver(first, 0.0);
  TellCommand(0.0, nullptr);
  Begins(0);
  for (long tick = 0;; ++tick) {
    const double now = static_cast<double>(tick) * options_.period;
    clock_.WaitUntil(now);
    Sense(now);
    if (thinking_) {
      // Not twice in a row, or a world that never rests would never let the walk be smoothed.
      if (!hurried_ && !hurried_before_ && Differs(asked_about_, &from_asked_)) {
        thinker_.Hurry(now);
        hurried_ = true;
      }
      if (const std::optional<Proposal> proposal = thinker_.Answer(now)) Take(*proposal, now);
    }
    Advance(now);
    if (!thinking_ && NeedsWork(now)) Ask(now);
    const bool over = Ends(now);
    if (hooks_.on_tick) hooks_.on_tick({now, record_, *executor_});
    if (over) return std::move(record_);
  }
}

void EpisodeLoop::Sense(double now) {
  while (std::optional<Frame> frame = sensor_.Next(now)) {
    if (!frame->world) {
      Tell(now, "lost", Formatted("frame of %.3f s", frame->taken));
      continue;
    }
    const std::shared_ptr<const Course> before = world_->course;
    WorldUpdate update = Updated(*world_, past_, std::move(*frame->world), options_);
    world_ = std::make_shared<const World>(std::move(update.world));
    Know(now);
    Tell(now, "measured", Formatted("frame of %.3f s", frame->taken));
    TellCommand(now, before);
    for (const Contradiction& one : update.contradictions) {
      Tell(now, "contradicted", one.Text());
    }
    if (executor_->grant().version < world_->sound_since) executor_->Revoke();
  }
}

void EpisodeLoop::Advance(double now) {
  if (hooks_.felt) {
    for (const EpisodeEvent& event : hooks_.felt()) {
      Tell(now, event.what, event.text, event.half_step);
    }
  }
  const bool held = IsToEnd() || (hooks_.held && hooks_.held());
  const std::string awaited = Awaited(now);
  if (held || !awaited.empty()) executor_->Revoke();
  if ((held_ && !held) || (!awaited_.empty() && awaited.empty())) again_ = true;
  held_ = held;
  awaited_ = awaited;
  const bool stopped = executor_->stopped();
  for (const int half_step : executor_->Advance(now + options_.period)) Begins(half_step);
  if (!executor_->stopped() || stopped) return;
  const std::string text = Formatted("at rest from %.3f s on", executor_->rests_from());
  Tell(now, "stopped", text + (awaited.empty() ? "" : ": ") + awaited, executor_->begun());
  again_ = true;
}

std::string EpisodeLoop::Awaited(double now) const {
  const SuperposedWalk& walk = executor_->walk();
  const int next = executor_->begun() + 1;
  const bool lifts = next % 2 == 0 && next < walk.num_half_steps();
  if (!hooks_.waits || !lifts) return "";
  if (!executor_->stopped() && walk.start_of(next) >= now + options_.period) return "";
  return hooks_.waits(walk.half_step(next).support);
}

void EpisodeLoop::Begins(int half_step) {
  record_.begun.push_back(
      {executor_->first() + half_step, static_cast<int>(record_.grants.size()) - 1});
  Tell(executor_->walk().start_of(half_step), "begins", "", half_step);
  const SuperposedWalk& executed = executor_->walk();
  const bool near = std::ranges::count(executor_->grant().near, half_step) > 0;
  if (near && BeginsAtRest(executed, half_step)) {
    Tell(executed.start_of(half_step), "near",
         "from rest nearer to an obstacle than demanded, and no nearer than there or than 0",
         half_step);
  }
  again_ = true;  // more junctions are near
}

bool EpisodeLoop::Differs(const std::shared_ptr<const World>& from, Difference* known) const {
  if (known->from != from || known->to != world_) {
    *known = {from, world_, DiffersClearly(*from, *world_)};
  }
  return known->clear;
}

bool EpisodeLoop::NeedsWork(double now) {
  if (held_ || !awaited_.empty()) return false;
  if (again_ || world_->sound_since > checked_->version) return true;
  if (world_->version == checked_->version) return false;
  if (stuck_) {
    return now >= asked_ + retry_ || (now >= asked_ + kRetry && Differs(checked_, &from_checked_));
  }
  if (Differs(checked_, &from_checked_)) return true;
  // What was proved runs out, for a half-step that begins soon.
  const SuperposedWalk& walk = executor_->walk();
  const int next = std::min(executor_->begun() + 1, walk.num_half_steps() - 1);
  return walk.start_of(next) < now + kAhead &&
         executor_->grant().valid_until < walk.end_of(next) + options_.period;
}

void EpisodeLoop::Ask(double now) {
  // Where nothing can move, a later world that is much the same says no more, and what is proved
  // against the one that was looked at last stays. Where no way was found, another noise may help.
  const bool same = !stuck_ && checked_->version >= world_->sound_since &&
                    checked_->valid_until() == std::numeric_limits<double>::infinity() &&
                    !Differs(checked_, &from_checked_);
  asked_about_ = same ? checked_ : world_;
  const int less = executor_->Forget();
  smoothed_.erase(smoothed_.begin(), smoothed_.begin() + less);
  robot_through_ -= less;
  thinker_.Ask({.plan = executor_->plan(),
                .first = executor_->first(),
                .smoothed = smoothed_,
                .grant = executor_->grant(),
                .robot_through = robot_through_,
                .begun = executor_->begun(),
                .stopped = executor_->stopped(),
                .now = now,
                .hand_over = now + patience_ + 2.0 * options_.period,
                .world = asked_about_,
                .course = course_,
                .refused = refused_,
                .shorten = tries_ > 0,
                .used_up = used_up_});
  thinking_ = true;
  hurried_before_ = std::exchange(hurried_, false);
  asked_ = now;
  again_ = false;
}

void EpisodeLoop::Take(const Proposal& proposal, double now) {
  thinking_ = false;
  const bool differs = DiffersClearly(*checked_, *asked_about_);
  if (differs) tries_ = kTries;
  const bool at_end = world_->course && executor_->rests_from() <= now;
  const bool in_vain = stuck_ && (executor_->stopped() || at_end) && !differs;
  retry_ = in_vain ? std::min(2.0 * retry_, kLongestRetry) : kRetry;
  checked_ = asked_about_;
  stuck_ = proposal.kind == ProposalKind::kUnsafe && !proposal.refuses;
  const bool used_up = proposal.nodes >= replanner_.config().experiment.planner.max_nodes;
  used_up_ = stuck_ && used_up ? used_up_ + 1 : 0;
  const bool searched = proposal.planned.status != PlanStatus::kNotRun;
  if (world_->sound_since > asked_about_->version) {
    Tell(now, "refused", "the world has changed meanwhile");
    again_ = true;
  } else if (proposal.first_changed < 0 || stuck_ || proposal.refuses) {
    if (stuck_) Tell(now, "unsafe", proposal.reason, proposal.grant.through);
    if (proposal.refuses) {
      Tell(now, "refused", proposal.reason);
      refused_ = asked_about_->course->number;
      again_ = true;
    } else if (!stuck_) {
      course_ = proposal.course;
    }
    robot_through_ = proposal.robot_through;
    executor_->Take(proposal.grant);
    Record(proposal.grant, now);
    const bool shortens = !asked_about_->course;
    if (searched && shortens && !stuck_ && --tries_ > 0) again_ = true;
  } else {
    again_ = true;
    const std::string refused = executor_->TakeOver(proposal.plan, proposal.grant, now);
    if (refused.empty()) {
      HandOver(proposal, now);
    } else {
      Tell(now, "refused", refused);
      patience_ = std::max(patience_, 2.0 * (now - asked_));
    }
  }
}

void EpisodeLoop::HandOver(const Proposal& proposal, double now) {
  smoothed_ = proposal.smoothed;
  robot_through_ = proposal.robot_through;
  course_ = proposal.course;
  const int changed = std::max(0, std::min(proposal.first_changed, executor_->common()));
  const int kept = std::min(changed / 2 * 2, executor_->plan().sequence.size() - 2);
  WalkTail tail = TailOf(executor_->plan(), executor_->walk(), kept);
  tail.first += executor_->first();
  record_.walks.push_back({.t = now,
                           .kind = proposal.kind,
                           .reason = proposal.reason,
                           .tail = std::move(tail),
                           .first_changed = executor_->first() + proposal.first_changed,
                           .asked = asked_,
                           .measured = asked_about_->measured_at,
                           .check_s = proposal.seconds.check,
                           .plan_s = proposal.seconds.plan,
                           .smooth_s = proposal.seconds.smooth,
                           .effort = proposal.effort.all()});
  Record(proposal.grant, now);
  Tell(now, "handed_over", std::string(Name(proposal.kind)) + ": " + proposal.reason,
       proposal.first_changed);
}

bool EpisodeLoop::Ends(double now) {
  const bool at_rest = executor_->rests_from() <= now;
  const bool over = now >= options_.longest;
  const bool ended = at_rest && IsToEnd();
  const std::array<Foothold, 2> stance =
      StanceAfter(executor_->plan().sequence, executor_->begun());
  const bool on_both = executor_->begun() % 2 == 1;
  const bool arrived = at_rest && on_both && !world_->course && now > sensor_.QuietFrom() &&
                       world_->goal.ContainsStance(stance);
  const bool fell = hooks_.fallen && hooks_.fallen();
  const std::string lost = hooks_.lost ? hooks_.lost() : "";
  if (!arrived && !over && !ended && !fell && lost.empty()) return false;
  if (!lost.empty()) record_.message = lost;
  if (fell) record_.message = Formatted("the robot fell at %.3f s", now);
  record_.ending = fell                           ? EpisodeEnding::kFell
                   : !lost.empty()                ? EpisodeEnding::kUncontrolled
                   : arrived                      ? EpisodeEnding::kArrived
                   : !ended                       ? (!at_rest         ? EpisodeEnding::kTooLong
                                                     : world_->course ? EpisodeEnding::kEnded
                                                                      : EpisodeEnding::kStuck)
                   : hooks_.stop.stop_requested() ? EpisodeEnding::kInterrupted
                                                  : EpisodeEnding::kEnded;
  if (record_.ending == EpisodeEnding::kEnded) {
    record_.message = ended ? "a client ended it, and the robot has come to rest"
                            : "the time was up, and the robot rests as it was commanded";
  }
  record_.end = now;
  record_.stopped = executor_->stopped();
  return true;
}

void EpisodeLoop::TellCommand(double t, const std::shared_ptr<const Course>& before) {
  const std::shared_ptr<const Course>& now = world_->course;
  if ((before ? before->number : 0) == (now ? now->number : 0)) return;
  Tell(t, "commanded", now ? now->Text() : "walk to the goal");
}

void EpisodeLoop::Record(Grant grant, double t) {
  grant.through += executor_->first();
  for (int& near : grant.near) near += executor_->first();
  record_.grants.push_back({t, walk(), std::move(grant)});
}

void EpisodeLoop::Know(double t) {
  past_.Add(*world_);
  record_.worlds.push_back(*world_);
  record_.known.push_back(t);
}

void EpisodeLoop::Tell(double t, const std::string& what, const std::string& text, int half_step) {
  record_.events.push_back({.t = t,
                            .what = what,
                            .version = world_->version,
                            .walk = walk(),
                            .half_step = half_step < 0 ? -1 : executor_->first() + half_step,
                            .text = text});
}

}  // namespace halfstep
