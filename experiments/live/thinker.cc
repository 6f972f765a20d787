#include "experiments/live/thinker.h"

#include <algorithm>
#include <utility>

#include "experiments/live/prepared_world.h"

namespace halfstep {

const PreparedWorld& PreparedWorlds::Of(const std::shared_ptr<const World>& world) {
  if (!prepared_ || prepared_->held != world) prepared_ = replanner_.Prepare(world);
  return *prepared_;
}

LockstepThinker::LockstepThinker(const Replanner& replanner, std::uint64_t seed)
    : replanner_(replanner), worlds_(replanner), random_(seed) {}

void LockstepThinker::Ask(Situation situation) {
  question_ = std::move(situation);
  before_ = random_;
  proposal_ = replanner_.Propose(question_, worlds_.Of(question_.world), random_);
  ready_ = ReadyAt();
}

double LockstepThinker::ReadyAt() const {
  const BudgetConfig& budget = replanner_.config().live.budget;
  if (budget.effort > 0.0) return question_.now + budget.effort * proposal_->effort.all();
  const bool planned = proposal_->planned.status != PlanStatus::kNotRun;
  return question_.now + budget.check + (planned ? budget.plan : 0.0) +
         (proposal_->kind == ProposalKind::kSmoothed ? budget.smooth : 0.0);
}

void LockstepThinker::Hurry(double now) {
  if (!proposal_ || now >= ready_ || replanner_.config().live.budget.effort == 0.0) return;
  std::stop_source hurry;
  hurry.request_stop();
  question_.hurry = hurry.get_token();
  random_ = before_;
  proposal_ = replanner_.Propose(question_, worlds_.Of(question_.world), random_);
  ready_ = std::max(now, ReadyAt());
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
    hurry_ = {};
    situation.hurry = hurry_.get_token();
    question_ = std::move(situation);
  }
  asked_.notify_one();
}

std::optional<Proposal> ThreadThinker::Answer(double /*now*/) {
  const std::lock_guard lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

void ThreadThinker::Hurry(double /*now*/) {
  const std::lock_guard lock(mutex_);
  hurry_.request_stop();
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
