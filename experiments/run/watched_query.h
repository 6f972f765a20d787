#pragma once

#include <limits>
#include <vector>

#include "planner/search/goal_region.h"
#include "planner/search/half_step_query.h"
#include "planner/search/half_step_times.h"
#include "wpg/geometry/foothold.h"

namespace halfstep {

/// A half-step that a planner asked about.
struct AskedHalfStep {
  int element = 0;             ///< of the set
  bool up = false;             ///< its up half-step, else the one down
  Side support = Side::kLeft;  ///< as HalfStepQuery::DownIsFree has it
  Foothold X_WS;               ///< as HalfStepQuery::DownIsFree has it
  double left = 0.0;           ///< from that sole to the goal [m]
  bool operator==(const AskedHalfStep&) const = default;
};

/// Of half-steps that a planner was refused, those that begin nearest to the goal.
class NearestRefused {
 public:
  /// None yet.
  explicit NearestRefused(const GoalRegion& goal) : goal_(goal) {}

  /// From the support sole to the goal [m].
  double Left(const Foothold& X_WS) const { return goal_.Distance(X_WS.Planar().position()); }
  /// Takes element i from `support`, which stands at X_WS.
  void Add(int i, bool up, Side support, const Foothold& X_WS);
  /// At least the 1000 nearest, if there are so many.
  const std::vector<AskedHalfStep>& all() const { return all_; }

 private:
  GoalRegion goal_;
  double farthest_kept_ = std::numeric_limits<double>::infinity();
  std::vector<AskedHalfStep> all_;
};

/// Answers as another query does, and remembers what a planner came to: for telling why it found no
/// way. To be asked by one thread.
class WatchedQuery : public HalfStepQuery {
 public:
  /// `query` is borrowed.
  WatchedQuery(const HalfStepQuery& query, const GoalRegion& goal)
      : query_(query), refused_(goal) {}

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool Bears(const Foothold& X_WF) const override { return query_.Bears(X_WF); }

  /// The least distance to the goal of a supporting sole that was asked about [m]; ∞: there was
  /// none.
  double nearest() const { return nearest_; }
  /// Half-steps that were not free.
  const NearestRefused& refused() const { return refused_; }

 private:
  bool Note(bool free, bool up, int i, Side support, const Foothold& X_WS) const;

  const HalfStepQuery& query_;
  mutable double nearest_ = std::numeric_limits<double>::infinity();
  mutable NearestRefused refused_;
};

/// The same of times.
class WatchedTimes : public HalfStepTimes {
 public:
  /// `times` is borrowed.
  WatchedTimes(const HalfStepTimes& times, const GoalRegion& goal)
      : times_(times), refused_(goal) {}

  TimeIntervals DownStarts(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                           const TimeInterval& within) const override;
  TimeIntervals UpStarts(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                         const TimeInterval& within) const override;
  TimeIntervals OnBothFeet(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                           const TimeInterval& within) const override;
  TimeIntervals OnOneFoot(Side support, const Foothold& X_WS,
                          const TimeInterval& within) const override;
  double settled() const override { return times_.settled(); }
  double effort() const override { return times_.effort(); }

  /// Half-steps that are not free at some time that was asked about, themselves or at an end.
  const NearestRefused& refused() const { return refused_; }

 private:
  TimeIntervals Note(TimeIntervals times, const TimeInterval& within, int i, bool up, Side support,
                     const Foothold& X_WS) const;

  const HalfStepTimes& times_;
  mutable NearestRefused refused_;
};

}  // namespace halfstep
