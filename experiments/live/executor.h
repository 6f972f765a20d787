#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "smoothing/walk/splice.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// What was proved of a walk: its half-steps up to `through` may begin, as long as they end by
/// `valid_until` [s].
struct Grant {
  int version = 0;         ///< of the world that it was proved against
  double proved_at = 0.0;  ///< from this time of the walk on [s]
  int through = -1;        ///< the latest half-step that may begin; −1: none
  /// Every half-step that begins ends by then [s].
  double valid_until = std::numeric_limits<double>::infinity();
  /// Half-steps that are proved to keep less than the demanded clearance from what is near where
  /// they begin (NearRest).
  std::vector<int> near{};
};

/// Holds the walk that is being executed, and lets a half-step begin only when it is safe. A value;
/// time is told to it. Half-steps count from first().
class Executor {
 public:
  /// The walk begins at t = 0 with its half-step 0.
  Executor(WalkPlan plan, const Grant& grant);

  const WalkPlan& plan() const { return plan_; }        ///< the walk as data, or its recent part
  const SuperposedWalk& walk() const { return walk_; }  ///< the same walk as a function of time
  const Grant& grant() const { return grant_; }         ///< what may begin
  int begun() const { return begun_; }                  ///< the latest half-step that has begun
  int first() const { return first_; }  ///< half-step of the whole walk that plan()'s 0 is; even
  /// Half-steps that the walk has in common with the one that it took over from.
  int common() const { return common_; }
  /// Whether nothing more begins: the walk ends with half-step begun().
  bool stopped() const { return stopped_; }
  /// When the motion comes to rest, as far as is known now [s].
  double rests_from() const { return stopped_ ? walk_.end_of(begun_) : walk_.duration(); }
  /// The motion that is being executed: the walk, or its stop branch.
  SuperposedWalk executed() const { return stopped_ ? walk_.StopBranch(begun_) : walk_; }

  /// Whether another half-step begins before `until` [s] and may: it is granted and ends in time.
  /// When it may not, nothing more begins: stopped(). Returns the half-steps that begin. To be
  /// called in the order of time.
  std::vector<int> Advance(double until);

  /// What is proved against a newer world; takes the place of the old grant.
  void Take(const Grant& grant) { grant_ = grant; }
  /// What was proved is void: nothing more begins until the next grant.
  void Revoke() { grant_.through = begun_; }

  /// Takes another walk in place of this one. Returns why not, "" when it does: a successor has the
  /// half-steps in common that have begun, and changes nothing before `now` [s].
  std::string TakeOver(const WalkPlan& plan, const Grant& grant, double now);

  /// Forgets what is long past (RecentPart). Returns by how much half-steps count less from then
  /// on.
  int Forget();

 private:
  WalkPlan plan_;
  SuperposedWalk walk_;
  Grant grant_;
  int begun_ = 0;
  int first_ = 0, common_ = 0;
  bool stopped_ = false;
};

}  // namespace halfstep
