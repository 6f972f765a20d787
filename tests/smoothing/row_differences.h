#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "smoothing/margins/slack_evaluator.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {

/// What was compared: slopes that are not nearly 0, and instants at which there was no row.
struct RowDifferences {
  int compared = 0, without_row = 0;
};

/// Expects the slopes of a family's least row below `cutoff` to be those of differences, at random
/// instants of random walks of a sequence.
inline RowDifferences CompareLeastRow(const MarginEvaluator& evaluator,
                                      const HalfStepSequence& sequence, MarginFamily family,
                                      double cutoff, unsigned seed) {
  SlackEvaluator slacks(evaluator, cutoff);
  WalkDraw draw(seed);
  RowDifferences found;
  const auto least_of = [family](const InstantSlacks& instant) {
    size_t least = instant.rows.size();
    for (size_t r = 0; r < instant.rows.size(); ++r) {
      if (instant.rows[r].family != family) continue;
      if (least == instant.rows.size() || instant.rows[r].slack < instant.rows[least].slack) {
        least = r;
      }
    }
    return least;
  };
  for (int i = 0; i < Draws(60); ++i) {
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.1, 0.8);
    const SuperposedWalk walk(sequence, parameters);
    const double t = draw.Uniform(0, walk.duration());
    if (NearKnot(walk, t, 1e-3)) continue;
    const LocalTime at = walk.Locate(t);
    InstantSlacks here, sides[2];
    slacks.At(walk, at, {}, true, &here);
    const size_t row = least_of(here);
    if (row == here.rows.size()) {
      ++found.without_row;
      continue;
    }
    for (size_t p = 0; p < here.parameters.size(); ++p) {
      constexpr double h = 1e-6;
      for (int s : {0, 1}) {
        HomotopyParameters moved = parameters;
        here.parameters[p].in(moved) += s == 0 ? -h : h;
        slacks.At(SuperposedWalk(sequence, moved), at, {}, false, &sides[s]);
      }
      const double slope =
          (sides[1].rows[least_of(sides[1])].slack - sides[0].rows[least_of(sides[0])].slack) /
          (2 * h);
      const double analytic =
          here.gradient(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(p));
      EXPECT_NEAR(analytic, slope, 1e-4 * (1 + std::abs(slope)));
      found.compared += std::abs(slope) > 1e-3;
    }
  }
  return found;
}

}  // namespace halfstep
