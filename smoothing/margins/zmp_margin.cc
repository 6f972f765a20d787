#include "smoothing/margins/zmp_margin.h"

#include <limits>

#include "smoothing/margins/support_edges.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {

int ZmpMargin::count() const { return 1; }

std::string ZmpMargin::Subject(const Margin& margin) const {
  return margin.subject < 0 ? "both soles" : "support sole";
}

Margin ZmpMargin::Least(Instant* at, double) const {
  const WalkState& x = at->jet().value;
  const SupportPolygon polygon = SupportAt(at->walk(), at->at(), x, at->robot().sole_size);
  Margin least = Of(std::numeric_limits<double>::infinity(), -1);
  Lower(Of(polygon.Margin(x.segment<2>(kZmpX)), at->step_in_air()), &least);
  return least;
}

void ZmpMargin::AddRows(Instant* at, SlackSink* rows) const {
  const WalkState& x = at->jet().value;
  const SupportEdges edges(at->walk(), at->at(), x, at->robot().sole_size);
  const Eigen::Vector2d zmp = x.segment<2>(kZmpX);
  edges.ForEach([&](int i, const Eigen::Vector2d& inward) {
    rows->Add(edges.Inside(i, inward, zmp), [&](size_t p) {
      const WalkSensitivity& along = rows->sensitivities[p];
      return edges.Slope(i, inward, zmp, along.jet.value.segment<2>(kZmpX), along);
    });
  });
}

void ZmpMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  const IntervalMotion& motion = interval.motion;
  const double h = motion.half_width;
  const double change = h * (motion.jet.first.segment<2>(kZmpX).norm() +
                             0.5 * h * motion.second.segment<2>(kZmpX).norm());
  const WalkState& x = motion.jet.value;
  const SupportPolygon polygon =
      SupportAt(interval.mid.walk(), interval.mid.at(), x, interval.mid.robot().sole_size);
  tightest->Add(Of(polygon.Margin(x.segment<2>(kZmpX)), interval.mid.step_in_air()),
                change + interval.mid.rounding());
}

}  // namespace halfstep
