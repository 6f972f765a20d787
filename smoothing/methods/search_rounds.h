#pragma once

#include <vector>

#include "opt/solvers/solver.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/proof/feasibility_test.h"

namespace halfstep {

/// What searches in rounds have in common, over a whole walk (OptimizeOverlaps) or a window of it
/// (SearchWindow): in each round a solver takes a few steps, where it ends is a candidate, and the
/// program learns where to look.

/// Points tried towards a candidate.
inline constexpr int kAttempts = 8;
/// A candidate whose rows are violated by more than this [of a slack's scale] is not worth a proof,
/// nor a place to go on from.
inline constexpr double kHopeless = 0.5;
/// How far apart the program looks for small slacks [s].
inline constexpr double kLookPeriod = 0.005;
/// A point where less slack is seen is not worth a proof [of its scale].
inline constexpr double kPromising = -0.02;

/// `given` with what suits the solver: where it likes many rows, each of `instants` in a half-step
/// has rows of its own, which are sharp from the first round on.
WatchOptions RowsFor(const opt::SolverTraits& traits, const FeasibilityTest& test, int instants,
                     const WatchOptions& given);

/// Options of a round with at most `iterations` of the solver.
opt::SolverOptions RoundOptions(const opt::SolverTraits& traits, ProgramKind kind, int iterations);

/// Rows as sharp as at first, with `more` times the reserve.
void ResetRows(double sharpness, double more, WatchedInstants* watched);

/// After a round whose end was proved but for `refusals`, or was not `tried`. Rows by instant stay
/// as sharp as they are, and keep more or less in reserve where that is needed. Rows by half-step
/// grow sharper by a factor, up to a bound, where all is proved, and else softer, so that more is
/// left in reserve.
void AdaptRows(bool tried, const std::vector<Margin>& refusals, WatchedInstants* watched);

}  // namespace halfstep
