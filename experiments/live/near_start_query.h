#pragma once

#include "experiments/run/certified_half_steps.h"
#include "planner/search/half_step_query.h"
#include "planner/search/step_set.h"

namespace halfstep {

/// Asks swept volumes, and where these are in the way of the first steps from a place, proves the
/// half-step itself. Volumes are larger than what the robot sweeps, so a robot that stands close to
/// an obstacle may be free to go where they say no. Slow where they do: for a robot that rests and
/// found no other way, and only so many times. For one search in one thread.
class NearStartQuery : public HalfStepQuery {
 public:
  /// All are borrowed; the query and the certifier are of the same scene, the query of the set.
  NearStartQuery(const StepSet& set, const HalfStepQuery& query, const HalfStepCertifier& certifier,
                 const Eigen::Vector2d& start)
      : set_(set), query_(query), certifier_(certifier), start_(start) {}

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override {
    return query_.DownIsFree(i, support, X_WS) || Certifies(set_.Down(i, support), X_WS, X_WS);
  }
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override {
    if (query_.UpIsFree(i, support, X_WS)) return true;
    const Foothold X_WF = X_WS * set_.Placement(i, support);
    return Certifies(set_.Up(i, support), X_WF, X_WS);
  }

 private:
  // Of a half-step whose sole stands at `support`; `from` is where the robot comes from.
  bool Certifies(const HalfStep& half_step, const Foothold& support, const Foothold& from) const {
    constexpr double kNear = 0.25;  // [m]
    if (left_ == 0 || (from.Planar().position() - start_).norm() > kNear) return false;
    --left_;
    return certifier_.Certifies(half_step, support);
  }

  const StepSet& set_;
  const HalfStepQuery& query_;
  const HalfStepCertifier& certifier_;
  Eigen::Vector2d start_;
  mutable int left_ = 300;  // certificates
};

}  // namespace halfstep
