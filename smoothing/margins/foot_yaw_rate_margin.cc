#include "smoothing/margins/foot_yaw_rate_margin.h"

#include <cmath>

namespace halfstep {

int FootYawRateMargin::count() const { return 1; }

std::string FootYawRateMargin::Subject(const Margin& margin) const { return FootName(margin); }

Margin FootYawRateMargin::Least(Instant* at, double) const {
  Margin least = Of(kUnlimited, -1);
  const std::optional<double>& limit = at->limits().foot_yaw_rate;
  if (at->step_in_air() < 0 || !limit) return least;
  const double rate = at->jet().first[FootIndex(at->swing()) + 3];
  Lower(Of(*limit - std::abs(rate), Index(at->swing())), &least);
  return least;
}

void FootYawRateMargin::AddRows(Instant* at, SlackSink* rows) const {
  const std::optional<double>& limit = at->limits().foot_yaw_rate;
  if (at->step_in_air() < 0 || !limit) return;
  const int yaw = FootIndex(at->swing()) + 3;
  const double rate = at->jet().first[yaw];
  if (rate == 0.0) return;
  rows->Add(*limit - std::abs(rate), [&](size_t i) {
    const double change = rows->sensitivities[i].jet.first[yaw];
    return rate < 0.0 ? change : -change;
  });
}

void FootYawRateMargin::AddBounds(const MarginInterval& interval,
                                  TightestStatement* tightest) const {
  const Margin margin = Least(&interval.mid, kUnlimited);
  double change = 0.0;
  if (margin.subject >= 0) {
    change = interval.motion.RateChange(FootIndex(interval.mid.swing()) + 3);
  }
  tightest->Add(margin, change + interval.mid.rounding());
}

}  // namespace halfstep
