#pragma once

#include <Eigen/Core>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "wpg/motion/half_step_shape.h"
#include "wpg/motion/profile.h"
#include "wpg/motion/walk_state.h"

namespace halfstep {

/// What proposes how the CoM and the ZMP of half-steps move. Proofs do not trust it: they ask the
/// whole robot what the ground gives. Superposition takes the relation of CoM and ZMP to be linear
/// and the same in all half-steps. Immutable.
class MotionModel {
 public:
  /// Profiles of both axes of the CoM, and of the ZMP, which rests while the foot is in the air.
  struct Proposal {
    std::shared_ptr<const Profile> com;  ///< of the CoM
    std::shared_ptr<const Profile> zmp;  ///< of the ZMP
  };

  virtual ~MotionModel() = default;
  /// For a half-step of this kind, shape and duration T [s]. Precondition: T in the range of the
  /// model (std::logic_error).
  virtual Proposal Propose(HalfStepKind kind, const HalfStepShape& shape,
                           double duration) const = 0;
  /// Second and third time derivative of the CoM [m/s²], [m/s³] from the quantities of a walk and
  /// their first derivatives: linear in these, so that they serve sensitivities, too.
  virtual Eigen::Vector2d ComAcceleration(const WalkJet& jet) const = 0;
  virtual Eigen::Vector2d ComJerk(const WalkJet& jet) const = 0;  ///< see ComAcceleration
  /// All that tells the model from others, by names that begin with its own: for provenance.
  virtual std::vector<std::pair<std::string_view, double>> numbers() const = 0;
};

}  // namespace halfstep
