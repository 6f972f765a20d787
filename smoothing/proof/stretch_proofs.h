#pragma once

#include <utility>
#include <vector>

#include "smoothing/proof/feasibility_test.h"
#include "smoothing/walk/stretch_range.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// Proves walks of one sequence stretch by stretch: [t_k, t_{k+1}], and the last one to the end.
/// What a walk does on a stretch depends only on the half-steps under way there, so a stretch with
/// the parameters of an earlier proof is not proved again. Instants at which earlier proofs failed
/// are checked first. Source: smoothing/README.md, "The incumbent".
class StretchProofs {
 public:
  /// `test` is borrowed. Stretches outside of `range` are taken for proved.
  StretchProofs(const FeasibilityTest& test, int num_half_steps, const StretchRange& range = {});

  /// Witnesses of the stretches that are not proved, at most one each, in their order. Empty: the
  /// walk is proved for all t, or all in the range.
  std::vector<Margin> Refusals(const SuperposedWalk& walk, MarginEvaluator::Scratch* scratch);

  /// Records that the walk has been proved as a whole.
  void Remember(const SuperposedWalk& walk);

 private:
  using Key = std::vector<double>;
  struct Stretch {
    std::vector<Key> proved;       // the latest ones
    std::vector<double> suspects;  // τ as fractions of T_k
  };
  static void Keep(Key key, Stretch* stretch);
  // What a proof of the stretch of half-step k is remembered by; among obstacles that move also
  // when the stretch begins.
  Key KeyOf(const SuperposedWalk& walk, int k) const;

  const FeasibilityTest& test_;
  StretchRange range_;
  bool rests_;  // the scene; asking costs as much as there are obstacles
  std::vector<Stretch> stretches_;
};

/// The parameters of the stretch [t_k, t_{k+1}] of half-step k: the posture and its rates, as
/// functions of the time since t_k, and the length of the stretch depend on no others. They are
/// those that are carried by the half-steps i ≤ k that are under way at some time of the stretch.
std::vector<double> StretchParameters(const SuperposedWalk& walk, int half_step);

}  // namespace halfstep
