#include "experiments/plot/ticks.h"

#include <algorithm>
#include <cmath>

#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep::plot {
namespace {

/// A step between ticks: factor · 10^power.
struct TickStep {
  int factor = 1, power = 0;
  double size() const { return factor * Pow(10.0, power); }
  TickStep Next() const {
    if (factor == 5) return {1, power + 1};
    return {factor == 1 ? 2 : 5, power};
  }
};

std::vector<Tick> Multiples(const Axis& axis, const TickStep& step) {
  std::vector<Tick> ticks;
  const double slack = 1e-9 * (axis.high - axis.low);
  const long first = std::lround(std::ceil((axis.low - slack) / step.size()));
  const long last = std::lround(std::floor((axis.high + slack) / step.size()));
  for (long i = first; i <= last; ++i) {
    const double at = static_cast<double>(i) * step.size();
    ticks.push_back({at, DecimalText(at, std::max(0, -step.power))});
  }
  return ticks;
}

std::vector<Tick> Logarithmic(const Axis& axis, int most) {
  std::vector<Tick> all;
  for (const std::vector<int>& factors : {std::vector{1, 2, 5}, {1, 3}, {1}}) {
    all.clear();
    const int first = static_cast<int>(std::floor(Log10(axis.low))) - 1;
    const int last = static_cast<int>(std::ceil(Log10(axis.high)));
    for (int power = first; power <= last; ++power) {
      for (const int factor : factors) {
        const double at = TickStep{factor, power}.size();
        if (at < axis.low * (1 - 1e-9) || at > axis.high * (1 + 1e-9)) continue;
        all.push_back({at, ShortestText(Shortened(at, 3))});
      }
    }
    if (static_cast<int>(all.size()) <= most) break;
  }
  return all;
}

}  // namespace

std::string DecimalText(double value, int digits) {
  std::string text = Formatted("%.*f", digits, value == 0.0 ? 0.0 : value);
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return text.front() == '-' ? "−" + text.substr(1) : text;
}

std::vector<Tick> ChosenTicks(const Axis& axis, int most) {
  HALFSTEP_CHECK(std::isfinite(axis.low) && std::isfinite(axis.high) && axis.low < axis.high,
                 "axis from " << axis.low << " to " << axis.high);
  if (axis.logarithmic) return Logarithmic(axis, most);
  const int power = static_cast<int>(std::floor(Log10(axis.high - axis.low))) - 2;
  std::vector<Tick> ticks, before;
  for (TickStep step{1, power};; step = step.Next()) {
    ticks = Multiples(axis, step);
    if (static_cast<int>(ticks.size()) <= std::max(most, 2)) break;
    before = ticks;
  }
  // One tick alone gives no scale: then the next finer ones, or their ends.
  if (ticks.size() < 2 && static_cast<int>(before.size()) <= most + 2) return before;
  if (ticks.size() < 2 && before.size() >= 2) return {before.front(), before.back()};
  return ticks;
}

}  // namespace halfstep::plot
