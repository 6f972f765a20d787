#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

struct HomotopyParameters;

/// The families of parameters that a point of the smoothing homotopy is made of.
enum class ParameterFamily {
  kOverlap,       ///< Δ of a junction
  kHeightScale,   ///< η of a step
  kDuration,      ///< T of a half-step
  kSupportPoint,  ///< support offset of a step
  kViaLateral,    ///< how far aside the via point of a step is
  kFootRamp,      ///< ramps of the swing foot's speed in a half-step
  kFootDelay,     ///< the fraction of a half-step between floor and horizontal motion
  kLiftShare,     ///< the fraction of a half-step's flight in which the foot rises or sinks
  kViaAlong,      ///< how far ahead of the support sole's centre the via point of a step is
  kZmpShift,      ///< the fraction of a half-step in which its ZMP shifts
  kZmpBumpRamp,   ///< ramps of the bump of a half-step's ZMP
  kFootstepX,     ///< how far the footstep of a step is moved along its planned x
  kFootstepY,     ///< and along its planned y
  kFootstepYaw,   ///< how far it is turned
};
/// How many families there are.
inline constexpr int kNumParameterFamilies = 14;

/// What a method may move besides overlaps, and how far.
struct ParameterChoice {
  bool heights = false;             ///< η
  bool durations = false;           ///< T
  bool support_points = false;      ///< where CoM and ZMP rest on one foot
  bool via_laterals = false;        ///< how far aside via points are
  bool foot_ramps = false;          ///< HalfStepShape::foot_ramp
  bool foot_delays = false;         ///< HalfStepShape::horizontal_delay
  bool lift_shares = false;         ///< HalfStepShape::lift_share
  bool via_alongs = false;          ///< how far ahead via points are
  bool zmp_shifts = false;          ///< HalfStepShape::shift
  bool zmp_bump_ramps = false;      ///< HalfStepShape::bump_ramp
  bool footsteps = false;           ///< where feet stand, but the last of each foot
  double least_height_scale = 0.2;  ///< η is at least this
  double least_duration = 0.5;      ///< as a fraction of the planned one
  double most_duration = 1.5;       ///< as a fraction of the planned one
  double least_support_point = -0.03, most_support_point = 0.06;  ///< support offset [m]
  double least_via_lateral = 0.18, most_via_lateral = 0.3;        ///< [m]
  double least_foot_ramp = 0.2;                                   ///< of its motion, to ½
  double least_foot_delay = 0.02, most_foot_delay = 0.2;          ///< of T
  double least_lift_share = 0.4;                                  ///< of its flight, to 1
  double most_via_along = 0.08;                                   ///< to either side [m]
  double least_zmp_shift = 0.02, most_zmp_shift = 0.1;            ///< of T
  double least_zmp_bump_ramp = 0.1;                               ///< of the bump, to 1
  double most_footstep_x = 0.05, most_footstep_y = 0.03;          ///< to either side [m]
  double most_footstep_yaw = 0.1;                                 ///< to either side [rad]

  bool operator==(const ParameterChoice&) const = default;  ///< the same families, and as far
};

/// One number of ParameterChoice, and its key in configs.
struct ParameterBoundKey {
  std::string_view key;            ///< in configs
  std::string_view meaning;        ///< one line, for `halfstep explain-config`
  double ParameterChoice::*value;  ///< where it is kept
  double min, max;                 ///< valid range
  std::string_view unit;           ///< "m"; "": a number
};

/// All that programs, proofs, files and messages need to know about a family. What its parameters
/// do to a walk is up to SuperposedWalk and its Sensitivities.
struct ParameterFamilyTraits {
  std::string_view name;     ///< in YAML and messages: "overlap"
  std::string_view unit;     ///< "s"; "": a number
  std::string_view table;    ///< the CSV that holds the values, one row a junction or half-step
  std::string_view column;   ///< their column in that table
  int rank;                  ///< order of the families' columns in one table, smallest first
  std::string_view meaning;  ///< one line, for the column and for messages
  /// Its column is in tables only of walks in which a value of such a family is not the plan's.
  bool of_form;
  double HalfStepShape::*shape;  ///< the number of the half-step's shape that it is; null: of none
  double Pose2::*move;           ///< the number of a footstep's move that it is; null: of none
  std::vector<double> HomotopyParameters::*values;        ///< where values are kept
  int (*count)(const HalfStepSequence&);                  ///< how many a sequence has
  double (*planned)(const HalfStepSequence&, int index);  ///< the value that is the plan
  /// Whether methods leave one of the parameters alone though they may move the family; null: none.
  bool (*stays)(const HalfStepSequence&, int index);
  /// First and last half-step that the parameter belongs to; the last may be beyond the sequence.
  std::pair<int, int> (*half_steps)(int index);
  /// Index of the parameter that a half-step carries. A parameter that joins two half-steps is
  /// carried by the first of them, so the index of the last half-step may not exist.
  int (*index_at)(int half_step);
  /// True when the parameter bears on an instant only where all of its half-steps may be under way;
  /// false when it does where one of them may be.
  bool joins;
  /// The least value that makes sense, and whether that value itself is allowed.
  double least;
  bool least_itself;  ///< whether `least` is allowed
  /// The largest value; +∞ where the natural bound limits it.
  double most;
  /// The flag that lets methods move the family (null: they always may), its key in configs
  /// ("heights"), and what that key means. The key is "" where another family's key is for both.
  bool ParameterChoice::*chosen;
  std::string_view key, key_meaning;  ///< of `chosen`: its key in configs, and what that key means
  std::span<const ParameterBoundKey> bounds;  ///< numbers that limit the range, each with its key
  /// The range that methods choose from, given the planned value. Overlaps have their natural
  /// bounds besides.
  std::pair<double, double> (*range)(const ParameterChoice&, double planned);
};

/// Every family may be moved, footsteps as well, as far as the defaults say.
ParameterChoice EveryFamily();

/// The same choice with every form and footstep as planned.
ParameterChoice WithoutForms(ParameterChoice choice);

/// The traits of a family. A family is a row of the table behind this function, a member of
/// HomotopyParameters, and what SuperposedWalk makes of its values.
const ParameterFamilyTraits& Traits(ParameterFamily family);

/// Every family, in the order of programs and files.
constexpr std::array<ParameterFamily, kNumParameterFamilies> AllParameterFamilies() {
  return {
      ParameterFamily::kOverlap,      ParameterFamily::kHeightScale, ParameterFamily::kDuration,
      ParameterFamily::kSupportPoint, ParameterFamily::kViaLateral,  ParameterFamily::kFootRamp,
      ParameterFamily::kFootDelay,    ParameterFamily::kLiftShare,   ParameterFamily::kViaAlong,
      ParameterFamily::kZmpShift,     ParameterFamily::kZmpBumpRamp, ParameterFamily::kFootstepX,
      ParameterFamily::kFootstepY,    ParameterFamily::kFootstepYaw};
}

}  // namespace halfstep
