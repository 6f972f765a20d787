#include "experiments/run/watched_query.h"

#include <algorithm>

namespace halfstep {

bool WatchedQuery::DownIsFree(int i, Side support, const Foothold& X_WS) const {
  return Note(query_.DownIsFree(i, support, X_WS), false, i, support, X_WS);
}

bool WatchedQuery::UpIsFree(int i, Side support, const Foothold& X_WS) const {
  return Note(query_.UpIsFree(i, support, X_WS), true, i, support, X_WS);
}

bool WatchedQuery::Note(bool free, bool up, int i, Side support, const Foothold& X_WS) const {
  const double left = goal_.Distance(X_WS.Planar().position());
  nearest_ = std::min(nearest_, left);
  if (free || left > farthest_kept_) return free;
  constexpr size_t kKept = 1000;
  refused_.push_back({i, up, support, X_WS, left});
  if (refused_.size() == 2 * kKept) {
    std::ranges::stable_sort(refused_, {}, &Refused::left);
    refused_.resize(kKept);
    farthest_kept_ = refused_.back().left;
  }
  return free;
}

}  // namespace halfstep
