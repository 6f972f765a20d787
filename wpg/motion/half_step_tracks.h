#pragma once

#include <array>
#include <memory>
#include <vector>

#include "wpg/motion/half_step.h"
#include "wpg/motion/motion_model.h"
#include "wpg/motion/profile.h"
#include "wpg/motion/swing_profiles.h"
#include "wpg/motion/walk_state.h"
#include "wpg/motion/walk_thirds.h"

namespace halfstep {

/// The profiles of a half-step: the model's two, that of the waist's yaw, that of x, y and yaw of
/// the swing foot, that of its height, and that of the waist's.
enum ProfileIndex : int {
  kComProfile,
  kZmpProfile,
  kYawProfile,
  kFootProfile,
  kLiftProfile,
  kRiseProfile,
  kNumProfiles
};
/// A jet of each, by ProfileIndex.
using ProfileJets = std::array<ProfileJet, kNumProfiles>;

/// How one quantity moves in a half-step: x(τ) = from + π(τ)·change, π one of the profiles.
struct Track {
  Quantity quantity;     ///< which one
  ProfileIndex profile;  ///< which π
  double change = 0.0;   ///< to − from, in its unit
};

/// A half-step as a function of time: the tracks of all quantities that move in it. The others
/// rest. Immutable; copies share the profiles.
class HalfStepTracks {
 public:
  static constexpr int kNumTracks = 10;  ///< CoM, ZMP, waist's yaw, swing foot, waist's z

  /// Seen from the frame in which the support sole stands at X_WS. Preconditions: those of the
  /// model and of the profiles (std::logic_error).
  HalfStepTracks(const HalfStep& half_step, const MotionModel& model, const Foothold& X_WS = {});

  const std::array<Track, kNumTracks>& tracks() const { return tracks_; }  ///< in no order
  const WalkState& start() const { return start_; }  ///< all quantities at τ = 0
  bool waist_rises() const { return rises_; }        ///< whether the waist's height changes

  /// All quantities at local time τ [s], clamped to [0, T].
  WalkJet At(double tau) const;
  /// Adds what the tracks have moved since τ = 0, x − from, and its derivatives.
  void AddMotion(double tau, WalkJet* jet) const;
  /// Adds sup |ẍ| over local times [from, to] [s].
  void AddSecondBounds(double from, double to, WalkState* bounds) const;
  /// Adds all values of the third derivatives over local times [from, to] [s], of the quantities
  /// for which QuantityTraits asks, and what local times that are off by at most `time` [s] do to
  /// second derivatives: that is shared out to the third ones so that, seen from the middle, second
  /// derivatives change by no more than they let them.
  void AddThirdRanges(double from, double to, double time, WalkThirds* thirds) const;

  /// Adds how far rounding may carry what AddMotion adds from the exact walk on these footholds,
  /// local times off by at most `time` [s] besides, and the largest sizes of what it adds: both by
  /// value, first and second. `places`: how often footholds were computed one from another.
  void AddRounding(double time, double places, WalkJet* error, WalkJet* size) const;
  /// The same of start().
  WalkState StartRounding(double places) const { return places * place_error_; }

  /// The profile that a quantity follows when it moves.
  const Profile& of(Quantity quantity) const;
  /// The profiles at local time τ [s].
  ProfileJets Profiles(double tau) const;
  /// Their derivatives along a number of the shape: value, first and second.
  ProfileJets ProfilesByShape(double HalfStepShape::*number, double tau) const;

  double duration() const { return duration_; }          ///< T [s]
  double t1() const { return shape_.t1() * duration_; }  ///< end of the ZMP's first rest [s]
  double t2() const { return shape_.t2() * duration_; }  ///< begin of its second rest [s]
  /// The swing foot moves horizontally between these local times [s].
  double horizontal_begin() const { return foot_.begin * duration_; }
  double horizontal_end() const { return foot_.end * duration_; }  ///< and ends here [s]
  /// The swing foot rises (up) or sinks (down) between these local times [s].
  double lift_begin() const { return lift_.begin * duration_; }
  double lift_end() const { return lift_.end * duration_; }  ///< and ends here [s]
  /// Local times at which a track changes its formula, 0 left out, in no order [s].
  std::vector<double> Knots() const;

 private:
  // Of the profiles that move something.
  size_t num_profiles() const { return rises_ ? kNumProfiles : kRiseProfile; }

  HalfStepShape shape_;
  double duration_;
  RampedStep foot_;
  Smoothstep lift_;
  std::array<std::shared_ptr<const Profile>, kNumProfiles> profiles_;
  std::array<Track, kNumTracks> tracks_;
  WalkState start_;
  WalkState place_error_;  // of a state at rest, seen from X_WS, for footholds that are exact
  bool rises_ = false;     // whether the waist's height changes; if not, kRiseProfile is not asked
};

}  // namespace halfstep
