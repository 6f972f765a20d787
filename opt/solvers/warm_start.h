#pragma once

namespace halfstep::opt {

/// What a solver has learned about a problem beside a point, for a later solve of a similar one
/// with as many variables: sizes of steps, penalties, an estimate of curvature.
struct WarmStart {
  virtual ~WarmStart() = default;
};

}  // namespace halfstep::opt
