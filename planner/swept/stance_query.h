#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/swept/swept_volume_query.h"
#include "wpg/geometry/foothold.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// Asks about many half-steps of one stance at once, and is answered to the bit what
/// SweptVolumeQuery answers about each alone: obstacles near the stance are looked up once, four
/// half-steps lie side by side in vector lanes, and volumes are fetched before they are looked at.
/// Not thread-safe: each thread has its own.
class StanceQuery {
 public:
  /// Borrows the query, which may go on moving its obstacles.
  explicit StanceQuery(const SweptVolumeQuery& query);

  /// By place in `elements`: DownIsFree of that element from the stance. Valid until the next call.
  const std::vector<bool>& DownsAreFree(std::span<const int> elements, Side support,
                                        const Foothold& X_WS);
  /// The same of UpIsFree.
  const std::vector<bool>& UpsAreFree(std::span<const int> elements, Side support,
                                      const Foothold& X_WS);

 private:
  using Bounds = SweptVolumeQuery::Bounds;
  using Placed = SweptVolumeQuery::Placed;
  // A box along the axes, about a sole: none of the set's volumes reaches out of it.
  struct Reach {
    double around = 0.0;                 // [m], seen from above
    double lowest = 0.0, highest = 0.0;  // [m]
    void Add(const Bounds& bounds, double away);
  };
  // An obstacle's place that a half-step's bounds meet.
  struct Pair {
    int32_t half_step, near;  // in `placed_`, in `near_`
  };

  void FindNear(const Foothold& X_WS, const Reach& reach);
  // Of `placed_`, all at one frame or each at its own.
  void Answer(const Foothold& X_WS, const Reach& reach, bool one_frame);
  // Finds the pairs of the half-steps from `first` on, four at most.
  void Compare(size_t first);

  const SweptVolumeQuery& query_;
  Reach down_, up_;  // from the stance's support sole
  std::vector<Placed> placed_;
  std::vector<int32_t> near_;  // slots
  std::vector<OrientedBox> seen_;
  std::vector<Pair> pairs_;
  std::vector<bool> free_;
};

}  // namespace halfstep
