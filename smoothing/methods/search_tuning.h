#pragma once

namespace halfstep {

/// The constants of searches in rounds (RangeSearch), one place for all of them. Source:
/// smoothing/README.md, "The search"; what some of them do to walks:
/// notebooks-data/measurements.md, "Tried and dropped".
struct SearchTuning {
  /// Instants a half-step with rows of their own, where a solver likes many rows.
  int instants = 24;
  double sharpness = 200.0;  ///< of such rows [1 / scale of a slack]
  double reserve = 2.0;      ///< of such rows at first, of what sharpness asks for
  /// How far apart the ends of rounds are sampled [s].
  double look_period = 0.005;
  /// A half-step where less slack is sampled is held back without asking for a proof [of a slack's
  /// scale].
  double promising = -0.02;
  /// A point that violates its rows by more is no place to go on from, nor worth a proof [of a
  /// slack's scale].
  double hopeless = 0.5;
  int attempts = 8;  ///< points that are tried towards a candidate
  int repairs = 3;   ///< of an end that few stretches refuse
  /// Stretches that refuse an end and are few, of all.
  double few_refusals = 0.34;
  /// The trust region of a repair, of the variables' widths.
  double repair_region = 0.02;
  /// A round gains that lowers the cost by more than this part of it.
  double gain = 1e-3;
  int poor_rounds = 5;  ///< in a row end the rounds from a start
  /// How much more the rows keep in reserve where rounds leave walks on whose support points the
  /// robot can rest: no half-step gets its margins back by being slower there.
  double sure_reserve = 4.0;
  /// How much more they keep when rounds begin again at the incumbent, every other time, so that
  /// they go another way.
  double more_reserve = 5.0;
  int poor_starts = 3;  ///< in a row that gain next to nothing end the search
  /// Half-steps above which a search begins in windows of so many, by so many: rounds over the
  /// whole would gain late.
  int long_walk = 60, window = 12, step = 8;
  int window_rounds = 6;  ///< in each of them, before rounds over the whole
  /// Part of the effort that is kept for the dichotomy in the end.
  double last_part = 0.1;
};

}  // namespace halfstep
