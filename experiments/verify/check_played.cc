#include "experiments/verify/check_played.h"

#include <algorithm>
#include <cmath>

#include "experiments/verify/check_clearance.h"
#include "experiments/verify/check_levels.h"
#include "experiments/verify/check_rows.h"
#include "experiments/verify/check_walk.h"
#include "experiments/verify/double_support.h"
#include "experiments/verify/joint_accelerations.h"
#include "experiments/verify/tolerances.h"

namespace halfstep::verify {
void CheckPlayed(const PlayedMotion& motion, const DescribedWalk& walk,
                 const CertificateText& certificate, double tolerance, Distances* distances,
                 Findings* findings) {
  const auto check = [&](const PlayedMotion& of, Findings* into) {
    CheckRowMargins(of, walk.floor(), certificate, tolerance, into);
    CheckLanding(of, walk, certificate, into);
    CheckDynamics(of.rows(), walk, distances->scene().friction, certificate, into);
    CheckJointAccelerations(of.rows(), walk, certificate, into);
    CheckFloor(of, walk.floor(), distances->scene(), certificate, tolerance, into);
    CheckLevels(of, certificate, tolerance, distances, into);
    CheckClearances(of, certificate, tolerance, distances, into);
  };
  CheckDoubleSupport(walk, certificate, findings);
  Findings played;
  check(motion, &played);
  if (played.disagreements() == 0) {
    findings->Take(played);
    return;
  }
  // Rows of the walk itself, where those of the trajectory are too coarse to be played.
  const double finest = Tolerances(motion.robot()).fine_rows;
  const std::vector<PlayedRow> rows = FinerRows(motion.rows(), walk, finest);
  const bool finite =
      std::all_of(rows.begin(), rows.end(), [](const PlayedRow& row) { return row.AllFinite(); });
  if (!finite) {
    findings->Take(played);
    return;
  }
  Findings fine;
  check(PlayedMotion(motion.robot(), rows), &fine);
  findings->Take(fine);
  if (fine.disagreements() > 0) return;
  findings->TooCoarse("played straight from row to row the walk leaves its margins by more than " +
                      Formatted("%.3g; rows every %.3g s keep them: ", tolerance, finest) +
                      played.reasons().front());
}

void CheckStopBranch(const DescribedWalk& walk, int last, double begin, double period,
                     const CertificateText& certificate, double tolerance, Distances* distances,
                     Findings* findings) {
  const double end = walk.WindowOf(last).second;
  const double from = std::max(begin, walk.WindowOf(last).first);
  if (!(end > from)) return;
  const DescribedWalk branch = walk.StopBranch(last);
  std::vector<PlayedRow> rows = {branch.Row(from)};
  // Rows closer than this to an end say little about speeds.
  const double least = 1e-3 * period;
  const double first = std::floor(from / period);
  for (int k = 0;; ++k) {
    const double t = (first + k) * period;
    if (t >= end - least) break;
    if (t > from + least) rows.push_back(branch.Row(t));
  }
  rows.push_back(branch.Row(end));
  if (!std::ranges::all_of(rows, [](const PlayedRow& row) { return row.AllFinite(); })) {
    findings->Disagree("a leg does not reach");
    return;
  }
  CheckPlayed(PlayedMotion(walk.robot(), rows), branch, certificate, tolerance, distances,
              findings);
}

}  // namespace halfstep::verify
