#include "experiments/verify/double_support.h"

#include <array>
#include <cmath>
#include <limits>

#include "experiments/verify/tolerances.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

constexpr double kRounding = 1e-9;  // of a duration from two sides [s]

double Duration(const DescribedWalk& walk, int half_step) {
  const auto [begin, end] = walk.ShiftOf(half_step);
  return end - begin;
}

// Whether the ZMP of a half-step goes from foot to foot at t, by at least `inside`.
bool Shifts(const DescribedWalk& walk, int half_step, double t, double inside) {
  const auto [begin, end] = walk.ShiftOf(half_step);
  return t >= begin + inside && t <= end - inside;
}

}  // namespace

std::string FaultOfShift(const DescribedWalk& walk, const ClaimRow& row, int half_step) {
  const double middle = 0.5 * (row.begin + row.end), inside = Tolerances(walk.robot()).inside;
  if (half_step >= walk.num_half_steps()) return "the walk has no " + row.subject;
  double least = std::numeric_limits<double>::infinity();
  if (half_step >= 0) {
    least = Duration(walk, half_step);
    if (!Shifts(walk, half_step, middle, -inside)) return row.subject + " changes no support there";
    if (!(std::abs(least - row.margin) <= kRounding)) {
      return Formatted("margin %.9g, but %.9g by the walk", row.margin, least);
    }
  } else if (row.margin != least) {
    return "no half-step is named";
  }
  for (const double t : {middle, row.begin, row.end}) {
    for (int i = 0; i < walk.num_half_steps(); ++i) {
      if (Shifts(walk, i, t, inside) && Duration(walk, i) < least - row.bound - kRounding) {
        return Formatted("half-step %d changes support in %.9g s at t = %.6g s", i + 1,
                         Duration(walk, i), t);
      }
    }
  }
  return "";
}

}  // namespace halfstep::verify
