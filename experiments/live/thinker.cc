#include "experiments/live/thinker.h"

#include <utility>

namespace halfstep {

const PreparedWorld& PreparedWorlds::Of(const std::shared_ptr<const World>& world) {
  if (!prepared_ || world_ != world) prepared_ = replanner_.Prepare(*world);
  world_ = world;
  return *prepared_;
}

LockstepThinker::LockstepThinker(const Replanner& replanner, std::uint64_t seed)
    : replanner_(replanner), worlds_(replanner), random_(seed) {}

void LockstepThinker::Ask(Situation situation) {
  const BudgetConfig& budget = replanner_.config().live.budget;
  proposal_ = replanner_.Propose(situation, worlds_.Of(situation.world), random_);
  const bool planned = proposal_->planned.status != PlanStatus::kNotRun;
  ready_ = situation.now + budget.check + (planned ? budget.plan : 0.0) +
           (proposal_->kind == ProposalKind::kSmoothed ? budget.smooth : 0.0);
}

std::optional<Proposal> LockstepThinker::Answer(double now) {
  if (!proposal_ || now < ready_) return std::nullopt;
  return std::exchange(proposal_, std::nullopt);
}

ThreadThinker::ThreadThinker(const Replanner& replanner, std::uint64_t seed)
    : replanner_(replanner),
      seed_(seed),
      thread_([this](const std::stop_token& stop) { Work(stop); }) {}

void ThreadThinker::Ask(Situation situation) {
  {
    const std::lock_guard lock(mutex_);
    question_ = std::move(situation);
  }
  asked_.notify_one();
}

std::optional<Proposal> ThreadThinker::Answer(double /*now*/) {
  const std::lock_guard lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

void ThreadThinker::Work(const std::stop_token& stop) {
  PreparedWorlds worlds(replanner_);
  std::mt19937_64 random(seed_);
  while (true) {
    std::optional<Situation> question;
    {
      std::unique_lock lock(mutex_);
      if (!asked_.wait(lock, stop, [this] { return question_.has_value(); })) return;
      question = std::exchange(question_, std::nullopt);
    }
    Proposal proposal = replanner_.Propose(*question, worlds.Of(question->world), random);
    const std::lock_guard lock(mutex_);
    answer_ = std::move(proposal);
  }
}

}  // namespace halfstep
