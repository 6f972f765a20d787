#include "smoothing/margins/foot_speed_margin.h"

namespace halfstep {

int FootSpeedMargin::count() const { return 1; }

std::string FootSpeedMargin::Subject(const Margin& margin) const { return FootName(margin); }

Margin FootSpeedMargin::Least(Instant* at, double) const {
  Margin least = Of(kUnlimited, -1);
  const std::optional<double>& limit = at->limits().foot_speed;
  if (at->step_in_air() < 0 || !limit) return least;
  const Side swing = at->swing();
  const double speed = at->jet().first.segment<3>(FootIndex(swing)).norm();
  Lower(Of(*limit - speed, Index(swing)), &least);
  return least;
}

void FootSpeedMargin::AddRows(Instant* at, SlackSink* rows) const {
  const std::optional<double>& limit = at->limits().foot_speed;
  if (at->step_in_air() < 0 || !limit) return;
  const int foot = FootIndex(at->swing());
  const Eigen::Vector3d velocity = at->jet().first.segment<3>(foot);
  const double speed = velocity.norm();
  if (speed <= 1e-6) return;
  rows->Add(*limit - speed, [&](size_t i) {
    return -velocity.dot(rows->sensitivities[i].jet.first.segment<3>(foot)) / speed;
  });
}

void FootSpeedMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  const Margin margin = Least(&interval.mid, kUnlimited);
  const IntervalMotion& motion = interval.motion;
  double change = 0.0;
  if (margin.subject >= 0) {
    const int foot = FootIndex(interval.mid.swing());
    change = motion.half_width * motion.second.segment<3>(foot).norm();
  }
  tightest->Add(margin, change + interval.mid.rounding());
}

}  // namespace halfstep
