#include "smoothing/margins/friction_margin.h"

#include <algorithm>
#include <optional>

#include "wpg/motion/dynamics_slope.h"
#include "wpg/motion/foot_friction.h"

namespace halfstep {
namespace {

// None where nothing can be said.
std::optional<FootFriction> FrictionAt(Instant* at) {
  const RobotDynamics* dynamics = at->dynamics();
  if (dynamics == nullptr) return std::nullopt;
  return FootFriction::Of(*dynamics,
                          SupportAt(at->walk(), at->at(), at->jet().value, at->robot().sole_size));
}

}  // namespace

int FrictionMargin::count() const { return 1; }

std::string FrictionMargin::Subject(const Margin& margin) const {
  return margin.subject < 0 ? "both soles" : "support sole";
}

Margin FrictionMargin::Least(Instant* at, double) const {
  const auto friction = FrictionAt(at);
  return Of(friction ? place_.scene.friction - friction->needed() : -kUnlimited, at->step_in_air());
}

void FrictionMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (at->demanded(family()) == kNotDemanded) return;
  const auto friction = FrictionAt(at);
  if (!friction) return;
  rows->Add(place_.scene.friction - friction->needed(), [&](size_t i) {
    const PostureTangent& tangent = rows->tangents[i];
    const DynamicsSlope slope(at->robot(), at->jet(), at->posture(), *at->dynamics(),
                              {rows->sensitivities[i].jet, tangent.q, tangent.speeds});
    return -friction->Slope(slope.contact());
  });
}

void FrictionMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  Instant& mid = interval.mid;
  if (mid.demanded(family()) == kNotDemanded) {
    tightest->Add(Of(kUnlimited, mid.step_in_air()), place_.rounding.friction);
    return;
  }
  const Margin margin = Least(&mid, kUnlimited);
  double change = 0.0;
  if (margin.value >= mid.demanded(family())) {
    const auto friction = FrictionAt(&mid);
    const double spare = margin.value - mid.demanded(family()) - place_.rounding.friction;
    change = friction->Drift(interval.drift(), interval.zmp_drift());
    const ContactRate* rate = change <= spare ? nullptr : interval.contact_rate();
    if (rate != nullptr) change = std::min(change, friction->Drift(*rate));
    change += place_.rounding.friction;
  }
  tightest->Add(margin, change);
}

}  // namespace halfstep
