#include "smoothing/margins/zmp_robot_margin.h"

#include <algorithm>

#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/zmp_slopes.h"

namespace halfstep {
namespace {

// What bears the robot at an instant, and calls visit(corner, inward unit normal) for each edge.
SupportPolygon PolygonAt(const Instant& at) {
  return SupportAt(at.walk(), at.at(), at.jet().value, at.robot().sole_size);
}

template <typename Visit>
void ForEachEdge(const SupportPolygon& polygon, const Visit& visit) {
  for (int i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon.corner(i);
    const Eigen::Vector2d edge = polygon.corner((i + 1) % polygon.size()) - a;
    if (edge.norm() < 1e-9) continue;
    visit(a, Eigen::Vector2d(-edge.y(), edge.x()).normalized());
  }
}

// None where nothing can be said, or the floor does not push.
std::optional<Eigen::Vector2d> ZmpAt(Instant* at) {
  const RobotDynamics* dynamics = at->dynamics();
  return dynamics == nullptr ? std::nullopt : dynamics->Zmp();
}

}  // namespace

int ZmpRobotMargin::count() const { return 1; }

std::string ZmpRobotMargin::Subject(const Margin& margin) const {
  return margin.subject < 0 ? "both soles" : "support sole";
}

Margin ZmpRobotMargin::Least(Instant* at, double) const {
  const auto zmp = ZmpAt(at);
  if (!zmp) return Of(-kUnlimited, at->step_in_air());
  Margin least = Of(kUnlimited, -1);
  Lower(Of(PolygonAt(*at).Margin(*zmp), at->step_in_air()), &least);
  return least;
}

void ZmpRobotMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (at->demanded(family()) == kNotDemanded) return;
  const auto zmp = ZmpAt(at);
  if (!zmp) return;
  std::vector<Eigen::Vector2d> slopes;  // along each parameter, made when a row needs them
  ForEachEdge(PolygonAt(*at), [&](const Eigen::Vector2d& a, const Eigen::Vector2d& inward) {
    rows->Add(inward.dot(*zmp - a), [&](size_t p) {
      if (slopes.empty()) {
        const ZmpSlopes all(at->robot(), at->jet(), at->posture(), *at->dynamics());
        for (size_t i = 0; i < rows->sensitivities.size(); ++i) {
          const PostureTangent& tangent = rows->tangents[i];
          slopes.push_back(all.Along({rows->sensitivities[i].jet, tangent.q, tangent.speeds}));
        }
      }
      return inward.dot(slopes[p]);
    });
  });
}

void ZmpRobotMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  Instant& mid = interval.mid;
  const int step = mid.step_in_air();
  if (mid.demanded(family()) == kNotDemanded) {
    tightest->Add(Of(kUnlimited, step), 0.0);
    return;
  }
  const auto zmp = ZmpAt(&mid);
  if (!zmp) {
    tightest->Add(Of(-kUnlimited, step), 0.0);
    return;
  }
  const SupportPolygon polygon = PolygonAt(mid);
  const double margin = polygon.Margin(*zmp);
  double least = margin;
  if (margin >= mid.demanded(family())) {
    const ZmpDrift& drift = interval.zmp_drift();
    ForEachEdge(polygon, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& inward) {
      least = std::min(least, inward.dot(*zmp - a) - drift.Along(inward));
    });
  }
  tightest->Add(Of(margin, step), margin - least + kDynamicsRounding);
}

}  // namespace halfstep
