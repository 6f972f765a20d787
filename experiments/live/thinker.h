#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
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
  std::shared_ptr<const World> world_;
  std::shared_ptr<const PreparedWorld> prepared_;
};

/// Computes when it is asked, while time stands still, and answers when the budget of what it did
/// has passed.
class LockstepThinker final : public Thinker {
 public:
  /// `replanner` is borrowed.
  LockstepThinker(const Replanner& replanner, std::uint64_t seed);
  void Ask(Situation situation) override;
  std::optional<Proposal> Answer(double now) override;

 private:
  const Replanner& replanner_;
  PreparedWorlds worlds_;
  std::mt19937_64 random_;
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

 private:
  void Work(const std::stop_token& stop);

  const Replanner& replanner_;
  std::uint64_t seed_;
  std::mutex mutex_;  // of the two that follow; held for a swap only
  std::optional<Situation> question_;
  std::optional<Proposal> answer_;
  std::condition_variable_any asked_;
  std::jthread thread_;  // last: it ends before the others go
};

}  // namespace halfstep
