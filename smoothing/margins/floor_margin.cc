#include "smoothing/margins/floor_margin.h"

#include <cmath>

namespace halfstep {

int FloorMargin::count() const { return 1; }

std::string FloorMargin::Subject(const Margin& margin) const { return FootName(margin); }

Margin FloorMargin::Least(Instant* at, double) const {
  Margin least = Of(kUnlimited, -1);
  const int step = at->step_in_air();
  if (step >= 0 && at->walk().MovesHorizontally(step, at->at())) {
    Lower(Of(at->jet().value[FootIndex(at->swing()) + 2] - floor_, Index(at->swing())), &least);
  }
  return least;
}

void FloorMargin::AddRows(Instant* at, SlackSink* rows) const {
  const int step = at->step_in_air();
  if (step < 0 || !at->walk().MovesHorizontally(step, at->at())) return;
  const int z = FootIndex(at->swing()) + 2;
  rows->Add(at->jet().value[z] - floor_,
            [&](size_t i) { return rows->sensitivities[i].jet.value[z]; });
}

void FloorMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  const Margin margin = Least(&interval.mid, kUnlimited);
  const bool moves = margin.subject >= 0;
  const int z = moves ? FootIndex(interval.mid.swing()) + 2 : 0;
  tightest->Add(margin, (moves ? interval.motion.Change(z) : 0.0) + interval.mid.rounding());
}

}  // namespace halfstep
