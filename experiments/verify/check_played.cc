#include "experiments/verify/check_played.h"

#include "experiments/verify/check_clearance.h"
#include "experiments/verify/check_rows.h"

namespace halfstep::verify {
void CheckPlayed(const PlayedMotion& motion, const WalkFloor& floor,
                 const CertificateText& certificate, double tolerance, Distances* distances,
                 Findings* findings) {
  Findings played;
  CheckFloor(motion, floor, certificate, tolerance, &played);
  CheckClearances(motion, certificate, tolerance, distances, &played);
  for (const std::string& line : played.lines()) findings->Say(line);
  if (played.disagreements() == 0) return;
  findings->TooCoarse("played straight from row to row the walk leaves its margins by more than " +
                      Formatted("%.3g m: ", tolerance) + played.reasons().front());
}

}  // namespace halfstep::verify
