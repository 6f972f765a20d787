#include "experiments/verify/check_walk.h"

#include <algorithm>
#include <cmath>

#include "experiments/verify/tolerances.h"

namespace halfstep::verify {
namespace {

// The largest difference, and the name of the columns that it is in.
struct Difference {
  double size = 0;
  const char* columns = "";
};

Difference LargestDifference(const PlayedRow& a, const PlayedRow& b) {
  Difference largest;
  const auto compare = [&largest](const char* columns, const auto& x, const auto& y) {
    const double size = (x - y).allFinite() ? (x - y).cwiseAbs().maxCoeff() : HUGE_VAL;
    if (!(size <= largest.size)) largest = {size, columns};
  };
  compare("com", a.com, b.com);
  compare("com_v", a.com_velocity, b.com_velocity);
  compare("com_a", a.com_acceleration, b.com_acceleration);
  compare("zmp", a.zmp, b.zmp);
  compare("waist", a.waist, b.waist);
  compare("left_foot", a.soles[0], b.soles[0]);
  compare("right_foot", a.soles[1], b.soles[1]);
  compare("q of the left leg", a.q[0], b.q[0]);
  compare("q of the right leg", a.q[1], b.q[1]);
  return largest;
}

}  // namespace

void CheckRowsOnWalk(const std::vector<PlayedRow>& rows, const DescribedWalk& walk, double period,
                     double end, Findings* findings) {
  const auto expected = static_cast<size_t>(std::floor(end / period * (1 - 1e-12))) + 2;
  if (rows.size() != expected) {
    findings->Disagree(Formatted("trajectory.csv: %zu rows, the walk has %zu every %.9g s",
                                 rows.size(), expected, period));
  }
  const Tolerances near(walk.robot());
  // Instants this close to a change of support or half-step belong to either side [s].
  const double instant = near.inside;
  double largest = 0;
  Faults times, places, supports, half_steps;
  for (size_t i = 0; i < rows.size(); ++i) {
    const PlayedRow& row = rows[i];
    const std::string line = Formatted("trajectory.csv:%zu: ", i + 2);
    const double t = i + 1 == rows.size() ? end : static_cast<double>(i) * period;
    if (!(std::abs(row.t - t) <= instant)) {
      times.Add(line + Formatted("t_s is %.9g instead of %.9g", row.t, t));
    }
    const Difference difference = LargestDifference(row, walk.Row(row.t));
    largest = std::max(largest, difference.size);
    if (!(difference.size <= near.row)) {
      places.Add(line + difference.columns +
                 Formatted(" is off the walk of half_steps.csv by %.6g", difference.size));
    }
    const double before = row.t - instant, after = row.t + instant;
    if (row.support != walk.SupportAt(before) && row.support != walk.SupportAt(row.t) &&
        row.support != walk.SupportAt(after)) {
      supports.Add(line + "another support than the walk of half_steps.csv has");
    }
    if (row.half_step < walk.HalfStepAt(before) || row.half_step > walk.HalfStepAt(after)) {
      half_steps.Add(line + "another half-step than half_steps.csv has");
    }
  }
  for (const Faults* faults : {&times, &places, &supports, &half_steps}) {
    faults->Conclude(findings);
  }
  findings->Say("rows on the walk of half_steps.csv: " + Count(std::ssize(rows)) +
                Formatted(", every %.6g s, off by %.3g at most", period, largest));
}

}  // namespace halfstep::verify
