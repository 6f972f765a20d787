#pragma once

#include <utility>
#include <vector>

#include "smoothing/walk/homotopy_parameters.h"
#include "wpg/geometry/foothold.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/half_step_sequence.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/moved_footsteps.h"
#include "wpg/motion/walk_state.h"
#include "wpg/motion/walk_thirds.h"
#include "wpg/nth.h"

namespace halfstep {

/// An instant of a walk, named by a half-step and the time since it began. The name stays when an
/// overlap elsewhere changes, while the absolute time moves. One instant may have several names.
struct LocalTime {
  int half_step = 0;  ///< index, from 0
  double tau = 0.0;   ///< [s]
};

/// Derivative of a WalkJet with respect to one homotopy parameter, at fixed (half-step, τ).
struct WalkSensitivity {
  HomotopyParameter parameter;  ///< with respect to which
  WalkJet jet;                  ///< per unit of the parameter
};

/// The walk of a sequence at a point of the homotopy: a pure function of time. Half-step i starts
/// at t_0 = 0, t_{i+1} = t_i + T_i − Δ_i, and every quantity is superposed in W:
///
///     f(t) = f_0(0) + Σ_i [ f_i(clamp(t − t_i, 0, T_i)) − f_i(0) ].
///
/// For all t: the walk is C², its CoM and ZMP are related as the model has it, and Δ = 0 is the
/// concatenation of the isolated half-steps. Starts and ends of half-steps are in order, whatever
/// the overlaps. Source: [Perrin2011] §IV; smoothing/README.md, "The homotopy".
class SuperposedWalk {
 public:
  /// Throws std::logic_error when the parameters are not in bounds (CheckParameters).
  SuperposedWalk(const HalfStepSequence& sequence, const HomotopyParameters& parameters);

  int num_half_steps() const { return static_cast<int>(pieces_.size()); }  ///< n
  /// D = Σ T_i − Σ Δ_i [s].
  double duration() const { return pieces_.back().start + pieces_.back().tracks.duration(); }
  double start_of(int half_step) const { return piece(half_step).start; }  ///< t_i [s]
  double end_of(int half_step) const {                                     ///< t_i + T_i [s]
    return piece(half_step).start + piece(half_step).tracks.duration();
  }
  const HomotopyParameters& parameters() const { return parameters_; }  ///< as given
  /// Half-step i, with its own duration, heights, form and footsteps.
  const HalfStep& half_step(int i) const { return piece(i).half_step; }
  const HalfStepTracks& tracks(int i) const { return piece(i).tracks; }  ///< its tracks, in W
  const Foothold& X_WS(int i) const { return piece(i).X_WS; }  ///< place of its support sole, in W
  const MotionModel& model() const { return *model_; }         ///< the same for all half-steps

  /// The latest half-step that has begun at t [s] (clamped to the walk), and the time since.
  LocalTime Locate(double t) const;
  /// Absolute time of a local one [s].
  double Absolute(const LocalTime& at) const { return start_of(at.half_step) + at.tau; }

  /// All quantities and two time derivatives, in W.
  WalkJet At(double t) const { return At(Locate(t)); }
  /// The same at a local time, which may lie beyond its half-step.
  WalkJet At(const LocalTime& at) const;

  /// Derivatives at fixed (half-step, τ) with respect to every parameter on which the instant
  /// depends: the half-steps under way there, the junctions between them and the footsteps that
  /// they stand on. Where τ itself moves with some parameters, `moving` has the rate dτ/dparameter
  /// of each. Parameters for which `wanted` returns false are left out. Replaces `out`.
  void Sensitivities(const LocalTime& at, std::vector<WalkSensitivity>* out,
                     const ParameterFilter& wanted = {}, const ParameterRates& moving = {}) const;

  /// Derivatives of start_of(half_step): −1 along every earlier overlap, +1 along every earlier
  /// duration. Replaces `out`.
  void StartSensitivities(int half_step, ParameterRates* out) const;

  /// Bounds of the |second time derivative| of every quantity, for all t in the absolute times
  /// [begin, end] [s]: the bounds of all half-steps under way there, added up.
  WalkState SecondBounds(double begin, double end) const;

  /// All values of the third time derivatives for all t in the absolute times [begin, end] [s].
  WalkThirds ThirdRanges(double begin, double end) const;

  /// Whether a foot is in the air, which it is from t2 of its up half-step to t1 of the down
  /// half-step that follows, both instants included. Else it stands on the floor.
  bool InAir(const LocalTime& at, Side foot) const;
  /// The step (its up half-step is 2·step) whose foot is in the air, or −1. At most one foot is. In
  /// a stop branch that ends with an up half-step the foot stays there.
  int StepInAir(const LocalTime& at) const;

  /// Whether the swing foot of `step` is in its horizontal motion. It begins with that of the up
  /// half-step, or with the down half-step if that overlaps so far that it begins earlier. It ends
  /// with that of the down half-step, or with the up half-step if that ends later. Both instants
  /// are included.
  bool MovesHorizontally(int step, const LocalTime& at) const;

  /// A lower bound of the height of the swing sole of `step` in W [m] for all t in [begin, end]
  /// [s]. But for rounding it is never below the lower of the step's two footsteps while the
  /// overlap is within its natural bound. Precondition: half-steps and flights begin and end
  /// outside of the interval, or at its ends. Source: smoothing/README.md, "The foot never goes
  /// below the floor".
  double LeastHeight(int step, double begin, double end) const;

  /// The walk that ends with half-step `last`: those after it never begin. It is this walk, to the
  /// bit, until half-step last + 1 would begin, and it ends at rest: on both feet, or on one when
  /// `last` is an up half-step. Precondition: 0 ≤ last < num_half_steps().
  /// Source: smoothing/README.md, "Stop branches".
  SuperposedWalk StopBranch(int last) const;

  /// Changes one overlap [s]. Precondition: it is at least −kLongestRest, and exceeds
  /// NaturalOverlapBound by at most kOverlapTolerance (std::logic_error).
  void SetOverlap(int junction, double overlap);

 private:
  struct Piece {
    HalfStep half_step, planned;  // as the parameters have it, and before
    Foothold X_WS;
    HalfStepFootsteps on;
    HalfStepTracks tracks;  // in W
    double start = 0.0;     // t_i
  };
  SuperposedWalk() = default;
  // The down half-step of a step; null in a stop branch that ends before it.
  const Piece* DownOf(int step) const {
    return 2 * step + 1 < num_half_steps() ? &piece(2 * step + 1) : nullptr;
  }
  const Piece& piece(int i) const { return Nth(pieces_, i); }
  // First and last half-step under way at `at`.
  int FirstActive(const LocalTime& at) const;
  int LastActive(const LocalTime& at) const;
  double LocalTo(int i, const LocalTime& at) const {
    return i == at.half_step ? at.tau : at.tau + (start_of(at.half_step) - start_of(i));
  }
  void UpdateStarts(int from);

  std::vector<Piece> pieces_;
  HomotopyParameters parameters_;
  std::shared_ptr<const MotionModel> model_;
};

/// What supports the robot at an instant where its quantities are `x`, in W: one sole, or the hull
/// of both. `sole_size`: length and width of the sole rectangle [m].
SupportPolygon SupportAt(const SuperposedWalk& walk, const LocalTime& at, const WalkState& x,
                         const Eigen::Vector2d& sole_size);

}  // namespace halfstep
