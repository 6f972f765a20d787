#include "experiments/run/watched_query.h"

#include <algorithm>

namespace halfstep {
namespace {

bool HaveAllOf(const TimeInterval& within, const TimeIntervals& times) {
  return std::ranges::any_of(times, [&](const TimeInterval& one) {
    return one.begin <= within.begin && within.end <= one.end;
  });
}

}  // namespace

void NearestRefused::Add(int i, bool up, Side support, const Foothold& X_WS) {
  constexpr size_t kKept = 1000;
  const double left = Left(X_WS);
  if (left > farthest_kept_) return;
  const AskedHalfStep asked{i, up, support, X_WS, left};
  if (!all_.empty() && all_.back() == asked) return;  // in time it is asked about again and again
  all_.push_back(asked);
  if (all_.size() < 2 * kKept) return;
  std::ranges::stable_sort(all_, {}, &AskedHalfStep::left);
  all_.resize(kKept);
  farthest_kept_ = all_.back().left;
}

bool WatchedQuery::DownIsFree(int i, Side support, const Foothold& X_WS) const {
  return Note(query_.DownIsFree(i, support, X_WS), false, i, support, X_WS);
}

bool WatchedQuery::UpIsFree(int i, Side support, const Foothold& X_WS) const {
  return Note(query_.UpIsFree(i, support, X_WS), true, i, support, X_WS);
}

bool WatchedQuery::Note(bool free, bool up, int i, Side support, const Foothold& X_WS) const {
  nearest_ = std::min(nearest_, refused_.Left(X_WS));
  if (!free) refused_.Add(i, up, support, X_WS);
  return free;
}

TimeIntervals WatchedTimes::DownStarts(int i, Side support, const Foothold& X_WS,
                                       const Foothold& X_WF, const TimeInterval& within) const {
  return Note(times_.DownStarts(i, support, X_WS, X_WF, within), within, i, false, support, X_WS);
}

TimeIntervals WatchedTimes::UpStarts(int i, Side support, const Foothold& X_WS,
                                     const Foothold& X_WF, const TimeInterval& within) const {
  return Note(times_.UpStarts(i, support, X_WS, X_WF, within), within, i, true, support, X_WS);
}

TimeIntervals WatchedTimes::OnBothFeet(int i, Side support, const Foothold& X_WS,
                                       const Foothold& X_WF, const TimeInterval& within) const {
  return Note(times_.OnBothFeet(i, support, X_WS, X_WF, within), within, i, false, support, X_WS);
}

TimeIntervals WatchedTimes::OnOneFoot(Side support, const Foothold& X_WS,
                                      const TimeInterval& within) const {
  constexpr int kAny = 0;  // all that begin there begin like that
  return Note(times_.OnOneFoot(support, X_WS, within), within, kAny, false, support, X_WS);
}

TimeIntervals WatchedTimes::Note(TimeIntervals times, const TimeInterval& within, int i, bool up,
                                 Side support, const Foothold& X_WS) const {
  if (!HaveAllOf(within, times)) refused_.Add(i, up, support, X_WS);
  return times;
}

}  // namespace halfstep
