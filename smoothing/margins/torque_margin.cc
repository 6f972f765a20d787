#include "smoothing/margins/torque_margin.h"

#include <cmath>
#include <optional>
#include <vector>

#include "wpg/motion/leg_torques.h"
#include "wpg/motion/torque_drift.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

int SubjectOf(Side side, Eigen::Index joint) { return 6 * Index(side) + static_cast<int>(joint); }

// How the feet carry the robot; none where nothing can be said.
std::optional<FootLoads> LoadsAt(Instant* at) {
  const RobotDynamics* dynamics = at->dynamics();
  const auto zmp = dynamics == nullptr ? std::nullopt : dynamics->Zmp();
  if (!zmp) return std::nullopt;
  if (at->step_in_air() >= 0) return FootLoads::OneFoot(Opposite(at->swing()));
  const WalkState& x = at->jet().value;
  return FootLoads::BothFeet(FootPose(x, Side::kLeft), FootPose(x, Side::kRight),
                             at->robot().sole_size, *zmp);
}

Vector6d TorquesAt(Instant* at, const FootLoads& loads, Side side) {
  const RobotDynamics& dynamics = *at->dynamics();
  return LegTorques(dynamics, side, loads.On(side, dynamics.contact()));
}

// Of both legs by Index(Side), along each parameter.
std::vector<std::array<Vector6d, 2>> SlopesAt(Instant* at, const FootLoads& loads,
                                              const SlackSink& rows) {
  const RobotDynamics& dynamics = *at->dynamics();
  const Vector6d& contact = dynamics.contact();
  std::vector<std::array<Vector6d, 2>> slopes;
  for (size_t i = 0; i < rows.sensitivities.size(); ++i) {
    const PostureTangent& tangent = rows.tangents[i];
    const DynamicsSlope slope(at->robot(), at->jet(), at->posture(), dynamics,
                              {rows.sensitivities[i].jet, tangent.q, tangent.speeds});
    const Eigen::Vector2d zmp = dynamics.ZmpSlope(slope.contact());
    auto& of_legs = slopes.emplace_back();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      Nth(of_legs, Index(side)) =
          LegTorqueSlopes(dynamics, slope, side, loads.On(side, contact),
                          loads.SlopeOn(side, contact, slope.contact(), zmp));
    }
  }
  return slopes;
}

}  // namespace

int TorqueMargin::count() const { return 12; }

std::string TorqueMargin::Subject(const Margin& margin) const {
  return JointName(place_.robot, margin);
}

double TorqueMargin::Limit(Side side, Eigen::Index joint) const {
  return Nth(Nth(place_.robot.legs, Index(side)).joints, joint).max_torque;
}

Margin TorqueMargin::Least(Instant* at, double) const {
  const auto loads = LoadsAt(at);
  return loads ? LeastOf(at, *loads) : Of(-kUnlimited, -1);
}

Margin TorqueMargin::LeastOf(Instant* at, const FootLoads& loads) const {
  Margin least = Of(kUnlimited, -1);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector6d torques = TorquesAt(at, loads, side);
    for (Eigen::Index j = 0; j < 6; ++j) {
      Lower(Of(Limit(side, j) - std::abs(torques[j]), SubjectOf(side, j)), &least);
    }
  }
  return least;
}

void TorqueMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (at->demanded(family()) == kNotDemanded) return;
  const auto loads = LoadsAt(at);
  if (!loads) return;
  std::vector<std::array<Vector6d, 2>> slopes;  // made when a row needs them
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector6d torques = TorquesAt(at, *loads, side);
    for (Eigen::Index j = 0; j < 6; ++j) {
      const double sign = torques[j] < 0.0 ? -1.0 : 1.0;
      rows->Add(Limit(side, j) - std::abs(torques[j]), [&](size_t i) {
        if (slopes.empty()) slopes = SlopesAt(at, *loads, *rows);
        return -sign * Nth(slopes[i], Index(side))[j];
      });
    }
  }
}

void TorqueMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  Instant& mid = interval.mid;
  const bool demanded = mid.demanded(family()) != kNotDemanded;
  const auto loads = demanded ? LoadsAt(&mid) : std::nullopt;
  if (!loads) {
    for (int i = 0; i < count(); ++i) {
      tightest->Add(Of(demanded ? -kUnlimited : kUnlimited, i), place_.rounding.torque);
    }
    return;
  }
  const Margin least = LeastOf(&mid, *loads);
  if (!(least.value >= mid.demanded(family()))) {
    tightest->Add(least, 0.0);
    return;
  }
  const bool both = mid.step_in_air() < 0;
  const TorqueDrift drift(interval.motion, interval.drift(), *mid.dynamics(), *loads,
                          both ? interval.zmp_drift().Most() : 0.0, kGravity);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector6d torques = TorquesAt(&mid, *loads, side), drifts = drift.Of(side);
    for (Eigen::Index j = 0; j < 6; ++j) {
      tightest->Add(Of(Limit(side, j) - std::abs(torques[j]), SubjectOf(side, j)),
                    drifts[j] + place_.rounding.torque);
    }
  }
}

}  // namespace halfstep
