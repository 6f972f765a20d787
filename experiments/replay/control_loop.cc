#include "experiments/replay/control_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfstep::replay {
namespace {

using control::JointCommand;
using control::kControlPeriod;

// The cubic with the values and slopes of both commands; x ∈ [0, 1] of the period.
JointTargets Between(const JointCommand& a, const JointCommand& b, double x) {
  JointTargets targets;
  for (size_t s = 0; s < 2; ++s) {
    const Vector6d va = kControlPeriod * a.speeds[s], vb = kControlPeriod * b.speeds[s];
    const Vector6d rise = b.q[s] - a.q[s];
    const Vector6d c = 3 * rise - 2 * va - vb, d = va + vb - 2 * rise;
    targets.q[s] = a.q[s] + x * (va + x * (c + x * d));
    targets.speed[s] = (va + x * (2 * c + 3 * x * d)) / kControlPeriod;
  }
  return targets;
}

}  // namespace

ControlLoop::ControlLoop(std::shared_ptr<const PlannedStates> plan,
                         const control::TrackingController& controller,
                         const control::Sensors& sensors)
    : plan_(std::move(plan)), controller_(controller.Clone()), sensors_(sensors) {}

ControlLoop::ControlLoop(const ControlLoop& other)
    : plan_(other.plan_),
      controller_(other.controller_ ? other.controller_->Clone() : nullptr),
      sensors_(other.sensors_),
      under_way_(other.under_way_),
      arrived_(other.arrived_),
      step_(other.step_),
      begun_(other.begun_),
      from_(other.from_),
      to_(other.to_) {}

bool ControlLoop::Receives(double now) {
  if (under_way_.empty() || under_way_.front().t > now - sensors_.delay() + 1e-9) return false;
  arrived_ = std::move(under_way_.front());
  under_way_.pop_front();
  return true;
}

void ControlLoop::CommandNext(double now, bool measured) {
  const control::PlannedState next = plan_->At(now + kControlPeriod);
  if (step_ == 0) {
    const control::PlannedState first = plan_->At(now);
    to_ = {first.q, first.speeds};
  }
  begun_ = now;
  from_ = to_;
  to_ = {next.q, next.speeds};
  if (measured) to_ = controller_->Command(*arrived_, plan_->At(arrived_->t), next);
}

std::optional<JointTargets> ControlLoop::TargetsAt(double t, const Simulation& robot) {
  const double dt = robot.timestep(), now = t - dt;
  const long period = std::lround(kControlPeriod / dt), delay = std::lround(sensors_.delay() / dt);
  if ((step_ + delay) % period == 0) {
    control::MeasuredState state = robot.Measure();
    state.t = now;
    under_way_.push_back(sensors_.Measured(std::move(state)));
  }
  if (step_ % period == 0) {
    const bool measured = Receives(now);
    if (controller_) CommandNext(now, measured);
  }
  ++step_;
  if (!controller_) return std::nullopt;
  return Between(from_, to_, (t - begun_) / kControlPeriod);
}

}  // namespace halfstep::replay
