#include "smoothing/margins/zmp_robot_margin.h"

#include <algorithm>

#include "smoothing/margins/support_edges.h"
#include "wpg/motion/zmp_slopes.h"

namespace halfstep {
namespace {

// What bears the robot at an instant.
SupportEdges EdgesAt(const Instant& at) {
  return {at.walk(), at.at(), at.jet().value, at.robot().sole_size};
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
  Lower(Of(EdgesAt(*at).polygon().Margin(*zmp), at->step_in_air()), &least);
  return least;
}

void ZmpRobotMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (at->demanded(family()) == kNotDemanded) return;
  const auto zmp = ZmpAt(at);
  if (!zmp) return;
  std::vector<Eigen::Vector2d> slopes;  // along each parameter, made when a row needs them
  const SupportEdges edges = EdgesAt(*at);
  edges.ForEach([&](int i, const Eigen::Vector2d& inward) {
    rows->Add(edges.Inside(i, inward, *zmp), [&](size_t p) {
      if (slopes.empty()) {
        const ZmpSlopes all(at->robot(), at->jet(), at->posture(), *at->dynamics());
        for (size_t k = 0; k < rows->sensitivities.size(); ++k) {
          const PostureTangent& tangent = rows->tangents[k];
          slopes.push_back(all.Along({rows->sensitivities[k].jet, tangent.q, tangent.speeds}));
        }
      }
      return edges.Slope(i, inward, *zmp, slopes[p], rows->sensitivities[p]);
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
  const SupportEdges edges = EdgesAt(mid);
  const double margin = edges.polygon().Margin(*zmp);
  double least = margin;
  if (margin >= mid.demanded(family())) {
    const auto least_over = [&](const ZmpDrift& drift) {
      double over = margin;
      edges.ForEach([&](int i, const Eigen::Vector2d& inward) {
        over = std::min(over, edges.Inside(i, inward, *zmp) - drift.Along(inward));
      });
      return over;
    };
    least = least_over(interval.zmp_drift());
    const bool decided = least - mid.place().rounding.zmp >= mid.demanded(family());
    const ContactRate* rate = decided ? nullptr : interval.contact_rate();
    if (rate != nullptr) {
      least = std::max(least, least_over(ZmpDrift::At(*rate, mid.dynamics()->contact()[5])));
    }
  }
  tightest->Add(Of(margin, step), margin - least + mid.place().rounding.zmp);
}

}  // namespace halfstep
