#pragma once

#include <memory>

#include "smoothing/proof/feasibility_test.h"
#include "wpg/geometry/foothold.h"
#include "wpg/motion/half_step.h"
#include "wpg/motion/motion_model.h"

namespace halfstep {

/// Whether a test accepts one isolated half-step, its support sole at X_WS, for all of its time:
/// that of the step in place that holds it, up from its place and down to it again. `scratch` is
/// the evaluator's. False as well where the test is undecided.
bool AcceptsHalfStep(const FeasibilityTest& test, const HalfStep& half_step, const Foothold& X_WS,
                     const std::shared_ptr<const MotionModel>& model,
                     MarginEvaluator::Scratch* scratch);

}  // namespace halfstep
