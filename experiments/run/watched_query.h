#pragma once

#include <limits>
#include <vector>

#include "planner/search/goal_region.h"
#include "planner/search/half_step_query.h"
#include "wpg/geometry/foothold.h"

namespace halfstep {

/// Answers as another query does, and remembers what a planner came to: for telling why it found no
/// way. To be asked by one thread.
class WatchedQuery : public HalfStepQuery {
 public:
  /// A half-step that was not free.
  struct Refused {
    int element = 0;             ///< of the set
    bool up = false;             ///< its up half-step, else the one down
    Side support = Side::kLeft;  ///< as DownIsFree has it
    Foothold X_WS;               ///< as DownIsFree has it
    double left = 0.0;           ///< from that sole to the goal [m]
  };

  /// `query` is borrowed.
  WatchedQuery(const HalfStepQuery& query, const GoalRegion& goal) : query_(query), goal_(goal) {}

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override;
  bool Bears(const Foothold& X_WF) const override { return query_.Bears(X_WF); }

  /// The least distance to the goal of a supporting sole that was asked about [m]; ∞: there was
  /// none.
  double nearest() const { return nearest_; }
  /// Half-steps that were not free, of those the ones that began nearest to the goal: at most 1000.
  const std::vector<Refused>& refused() const { return refused_; }

 private:
  bool Note(bool free, bool up, int i, Side support, const Foothold& X_WS) const;

  const HalfStepQuery& query_;
  GoalRegion goal_;
  mutable double nearest_ = std::numeric_limits<double>::infinity();
  mutable double farthest_kept_ = std::numeric_limits<double>::infinity();
  mutable std::vector<Refused> refused_;
};

}  // namespace halfstep
