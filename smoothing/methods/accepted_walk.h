#pragma once

#include <utility>

#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// A walk that the test of a problem accepted for all its time, and so may be an incumbent. No
/// method can make one of parameters that nobody judged: SmoothingMonitor::Accept makes one by
/// asking the test, and methods of this library that prove a walk in parts make one of these proofs
/// (AcceptedInParts, which is not installed).
class AcceptedWalk {
 public:
  const HomotopyParameters& parameters() const { return parameters_; }  ///< as they were judged

 private:
  friend class SmoothingMonitor;
  friend struct AcceptedInParts;
  explicit AcceptedWalk(HomotopyParameters parameters) : parameters_(std::move(parameters)) {}

  HomotopyParameters parameters_;
};

}  // namespace halfstep
