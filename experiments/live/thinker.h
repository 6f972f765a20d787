#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stop_token>
#include <thread>

#include "experiments/live/replanner.h"

namespace halfstep {

/// Where a replanner computes while the robot walks: one question at a time.
class Thinker {
 public:
  virtual ~Thinker() = default;
  /// Precondition: the last question has been answered.
  virtual void Ask(Situation situation) = 0;
  /// The answer, once; none as long as it is not there at `now` [s].
  virtual std::optional<Proposal> Answer(double now) = 0;
  /// The world has changed at `now` [s]: the answer comes without what only improves a safe walk,
  /// as soon as that is left.
  virtual void Hurry(double /*now*/) {}
};

/// Remembers what is prepared for a world as long as the same world is asked about.
class PreparedWorlds {
 public:
  /// `replanner` is borrowed.
  explicit PreparedWorlds(const Replanner& replanner) : replanner_(replanner) {}
  /// What belongs to the world; prepared at the first question. Not null.
  const PreparedWorld& Of(const std::shared_ptr<const World>& world);

 private:
  const Replanner& replanner_;
  std::shared_ptr<const PreparedWorld> prepared_;
};

/// Computes when it is asked, while time stands still, and answers when the budget of what it did
/// has passed. It hurries where its effort is what is charged.
class LockstepThinker final : public Thinker {
 public:
  /// `replanner` is borrowed.
  LockstepThinker(const Replanner& replanner, std::uint64_t seed);
  void Ask(Situation situation) override;
  std::optional<Proposal> Answer(double now) override;
  void Hurry(double now) override;

 private:
  double ReadyAt() const;

  const Replanner& replanner_;
  PreparedWorlds worlds_;
  std::mt19937_64 random_, before_;  // now, and before the question
  Situation question_;
  std::optional<Proposal> proposal_;
  double ready_ = 0.0;  // [s]
};

/// Computes in a thread of its own, and answers when it is done.
class ThreadThinker final : public Thinker {
 public:
  /// `replanner` is borrowed.
  ThreadThinker(const Replanner& replanner, std::uint64_t seed);
  void Ask(Situation situation) override;
  std::optional<Proposal> Answer(double now) override;
  void Hurry(double now) override;

 private:
  void Work(const std::stop_token& stop);

  const Replanner& replanner_;
  std::uint64_t seed_;
  std::mutex mutex_;  // of the three that follow; held for a swap only
  std::optional<Situation> question_;
  std::optional<Proposal> answer_;
  std::stop_source hurry_;  // of the latest question
  std::condition_variable_any asked_;
  std::jthread thread_;  // last: it ends before the others go
};

}  // namespace halfstep
