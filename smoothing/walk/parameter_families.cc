#include "smoothing/walk/parameter_families.h"

#include <algorithm>
#include <limits>

#include "smoothing/walk/homotopy_parameters.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using enum ParameterOf;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Row = ParameterFamilyTraits;
using Bounds = std::array<double, 2>;
using Choice = ParameterChoice;
using Values = HomotopyParameters;

// Ranges of what methods choose from. The planned value is in all of them.
std::pair<double, double> UpFromPlanned(const Row&, const Bounds&, double planned) {
  return {planned, kInfinity};
}
std::pair<double, double> UpToPlanned(const Row&, const Bounds& bounds, double planned) {
  return {bounds[0], planned};
}
std::pair<double, double> OfPlanned(const Row&, const Bounds& bounds, double planned) {
  return {bounds[0] * planned, bounds[1] * planned};
}
std::pair<double, double> Between(const Row&, const Bounds& bounds, double planned) {
  return {std::min(bounds[0], planned), std::max(bounds[1], planned)};
}
std::pair<double, double> UpToMost(const Row& row, const Bounds& bounds, double planned) {
  return {std::min(bounds[0], planned), row.most};
}
std::pair<double, double> AboutPlanned(const Row& row, const Bounds& bounds, double planned) {
  return {std::max(row.least, planned - bounds[0]), std::min(row.most, planned + bounds[0])};
}
std::pair<double, double> Anywhere(const Row& row, const Bounds&, double) {
  return {row.least, row.most};
}
std::pair<double, double> AboutZero(const Row&, const Bounds& bounds, double) {
  return {-bounds[0], bounds[0]};
}

// The last footstep of each foot stays, so that the walk ends where it was planned to end. So do
// those that are not followed by one of the other and one of the same foot, because what they bear
// on would not be the half-steps of half_steps().
bool FootstepStays(const HalfStepSequence& sequence, int step) {
  if (step + 2 >= sequence.num_steps()) return true;
  const auto swing = [&sequence](int k) {
    return Nth(sequence.half_steps, 2 * k).half_step.swing();
  };
  return swing(step + 1) == swing(step) || swing(step + 2) != swing(step);
}

// The waist keeps its height where the swing foot does not stand lower.
bool WaistKeepsHeight(const HalfStepSequence& sequence, int half_step) {
  return Nth(sequence.half_steps, half_step).half_step.X_SF.height >= 0.0;
}

constexpr const char* kOfDuration = "of the planned duration of a half-step";
constexpr const char* kOfSupport = "of the support sole's centre, towards the other foot";
constexpr const char* kOfVia = "of the via point from the support sole's centre";
constexpr const char* kOfDelay = "of T, between floor and horizontal motion";
constexpr const char* kOfShift = "of T, in which the ZMP shifts";
constexpr ParameterScale kWidth = ParameterScale::kStanceWidth;
constexpr ParameterScale kLength = ParameterScale::kLegLength;

constexpr std::array<Row, kNumParameterFamilies> kRows = {{
    {.family = ParameterFamily::kOverlap,
     .name = "overlap",
     .unit = "s",
     .of = kJunction,
     .part = ParameterPart::kBegin,
     .column = "overlap_s",
     .rank = 0,
     .meaning = "how long both half-steps are under way; below 0: a rest between them",
     .values = &Values::overlaps,
     .least = -kLongestRest,
     .most = kInfinity,
     .always = true,
     .key = "overlaps",
     .range_of = UpFromPlanned},
    {.family = ParameterFamily::kHeightScale,
     .name = "height_scale",
     .of = kStep,
     .part = ParameterPart::kState,
     .column = "height_scale",
     .rank = 1,
     .meaning = "scale of the foot's height in its step",
     .number = &HalfStep::via_height,
     .factor = true,
     .unmoved = 1.0,
     .values = &Values::height_scales,
     .least = 0.0,
     .most = 10.0,
     .chosen = &Choice::heights,
     .key = "heights",
     .key_meaning = "foot-height scales are variables beside the overlaps",
     .bound_keys = {{{"least_height_scale", "of the planned height", 0.1, 0.01, 1}}},
     .range_of = UpToPlanned},
    {.family = ParameterFamily::kDuration,
     .name = "duration",
     .unit = "s",
     .of = kHalfStep,
     .part = ParameterPart::kDuration,
     .column = "duration_s",
     .rank = 0,
     .meaning = "T",
     .number = &HalfStep::duration,
     .values = &Values::durations,
     .least = 0.0,
     .least_itself = false,
     .most = 60.0,
     .chosen = &Choice::durations,
     .key = "durations",
     .key_meaning = "durations of half-steps are variables beside the overlaps",
     .bound_keys = {{{"least_duration", kOfDuration, 0.5, 0.2, 1},
                     {"most_duration", kOfDuration, 1.5, 1, 5}}},
     .range_of = OfPlanned},
    {.family = ParameterFamily::kSupportPoint,
     .name = "support_point",
     .unit = "m",
     .of = kStep,
     .part = ParameterPart::kState,
     .column = "support_point_m",
     .rank = 2,
     .meaning = "where CoM and ZMP rest on one foot, from its centre towards the other foot",
     .shape = &HalfStepShape::support_point,
     .values = &Values::support_points,
     .least = -1.0,
     .most = 1.0,
     .chosen = &Choice::support_points,
     .key = "support_points",
     .key_meaning = "support points are variables beside the overlaps",
     .bound_keys = {{{"least_support_point_m", kOfSupport, -0.03, -1, 1, "m", kWidth},
                     {"most_support_point_m", kOfSupport, 0.08, -1, 1, "m", kWidth}}},
     .range_of = Between},
    {.family = ParameterFamily::kViaLateral,
     .name = "via_lateral",
     .unit = "m",
     .of = kStep,
     .part = ParameterPart::kState,
     .column = "via_lateral_m",
     .rank = 3,
     .meaning = "of the via point from the support sole's centre",
     .of_form = true,
     .number = &HalfStep::via_lateral,
     .least = 0.01,
     .most = 1.0,
     .key = "via_laterals",
     .key_meaning = "distances of via points are variables beside the overlaps",
     .bound_keys = {{{"least_via_lateral_m", kOfVia, 0.18, 0.01, 1, "m", kWidth},
                     {"most_via_lateral_m", kOfVia, 0.3, 0.01, 1, "m", kWidth}}},
     .range_of = Between},
    {.family = ParameterFamily::kFootRamp,
     .name = "foot_ramp",
     .of = kHalfStep,
     .part = ParameterPart::kProfile,
     .column = "foot_ramp",
     .rank = 4,
     .meaning = "fraction of the foot's motion in which its speed rises, and falls",
     .of_form = true,
     .shape = &HalfStepShape::foot_ramp,
     .least = 0.1,
     .most = 0.5,
     .key = "foot_ramps",
     .key_meaning = "ramps of the foot's speed are variables beside the overlaps",
     .bound_keys = {{{"least_foot_ramp", "of a foot's motion; at most it is 0.5", 0.2, 0.1, 0.5}}},
     .range_of = UpToMost},
    {.family = ParameterFamily::kFootDelay,
     .name = "foot_delay",
     .of = kHalfStep,
     .part = ParameterPart::kProfile,
     .column = "foot_delay",
     .rank = 5,
     .meaning = "fraction of T between take-off (landing) and the foot's horizontal motion",
     .of_form = true,
     .shape = &HalfStepShape::foot_delay,
     .least = 0.0,
     .most = 0.2,
     .key = "foot_delays",
     .key_meaning = "delays of the foot's horizontal motion are variables beside the overlaps",
     .bound_keys = {{{"least_foot_delay", kOfDelay, 0.02, 0, 0.2},
                     {"most_foot_delay", kOfDelay, 0.2, 0, 0.2}}},
     .range_of = Between},
    {.family = ParameterFamily::kLiftShare,
     .name = "lift_share",
     .of = kHalfStep,
     .part = ParameterPart::kProfile,
     .column = "lift_share",
     .rank = 6,
     .meaning = "fraction of the foot's flight in which it rises, or sinks",
     .of_form = true,
     .shape = &HalfStepShape::lift_share,
     .least = 0.2,
     .most = 1.0,
     .key = "lift_shares",
     .key_meaning = "how fast feet rise and sink are variables beside the overlaps",
     .bound_keys = {{{"least_lift_share", "of a foot's flight; at most it is 1", 0.4, 0.2, 1}}},
     .range_of = UpToMost},
    {.family = ParameterFamily::kViaAlong,
     .name = "via_along",
     .unit = "m",
     .of = kStep,
     .part = ParameterPart::kState,
     .column = "via_along_m",
     .rank = 7,
     .meaning = "of the via point ahead of the support sole's centre",
     .of_form = true,
     .number = &HalfStep::via_along,
     .least = -0.5,
     .most = 0.5,
     .key = "via_alongs",
     .key_meaning = "how far ahead via points are is variable beside the overlaps",
     .bound_keys = {{{"most_via_along_m",
                      "of the via point from where it is planned, along the support sole's x", 0.08,
                      0, 0.5, "m", kLength}}},
     .range_of = AboutPlanned},
    {.family = ParameterFamily::kZmpShift,
     .name = "zmp_shift",
     .of = kHalfStep,
     .part = ParameterPart::kProfile,
     .column = "zmp_shift",
     .rank = 8,
     .meaning = "fraction of T in which the ZMP shifts",
     .of_form = true,
     .shape = &HalfStepShape::shift,
     .values = &Values::zmp_shifts,
     .least = 0.01,
     .most = 0.5,
     .key = "zmp_shifts",
     .key_meaning = "how long ZMPs shift is variable beside the overlaps",
     .bound_keys = {{{"least_zmp_shift", kOfShift, 0.02, 0.01, 0.3},
                     {"most_zmp_shift", kOfShift, 0.3, 0.01, 0.3}}},
     .range_of = Between},
    {.family = ParameterFamily::kZmpBumpRamp,
     .name = "zmp_bump_ramp",
     .of = kHalfStep,
     .part = ParameterPart::kProfile,
     .column = "zmp_bump_ramp",
     .rank = 9,
     .meaning = "fraction of the ZMP's bump in which it rises, and falls; 1: it is round",
     .of_form = true,
     .shape = &HalfStepShape::bump_ramp,
     .least = 0.1,
     .most = 1.0,
     .key = "zmp_bump_ramps",
     .key_meaning = "ramps of ZMPs' bumps are variables beside the overlaps",
     .bound_keys = {{{"least_zmp_bump_ramp", "of a ZMP's bump; at most it is 1, a round bump", 0.1,
                      0.1, 1}}},
     .range_of = UpToMost},
    {.family = ParameterFamily::kFootstepX,
     .name = "footstep_x",
     .unit = "m",
     .of = kStep,
     .part = ParameterPart::kFootstep,
     .column = "footstep_x_m",
     .rank = 10,
     .meaning = "how far the step's footstep is moved along its planned x",
     .of_form = true,
     .move = &Pose2::x,
     .values = &Values::footstep_xs,
     .stays = FootstepStays,
     .least = -0.5,
     .most = 0.5,
     .chosen = &Choice::footsteps,
     .key = "footsteps",
     .key_meaning = "places and yaws of footsteps are variables, but of the last two",
     .bound_keys = {{{"most_footstep_x_m", "of the move of a footstep along its x, to either side",
                      0.05, 0, 0.5, "m", kLength}}},
     .range_of = AboutZero},
    {.family = ParameterFamily::kFootstepY,
     .name = "footstep_y",
     .unit = "m",
     .of = kStep,
     .part = ParameterPart::kFootstep,
     .column = "footstep_y_m",
     .rank = 11,
     .meaning = "how far the step's footstep is moved along its planned y",
     .of_form = true,
     .move = &Pose2::y,
     .values = &Values::footstep_ys,
     .stays = FootstepStays,
     .least = -0.5,
     .most = 0.5,
     .chosen = &Choice::footsteps,
     .bound_keys = {{{"most_footstep_y_m", "of the move of a footstep along its y, to either side",
                      0.03, 0, 0.5, "m", kLength}}},
     .range_of = AboutZero},
    {.family = ParameterFamily::kFootstepYaw,
     .name = "footstep_yaw",
     .unit = "rad",
     .of = kStep,
     .part = ParameterPart::kFootstep,
     .column = "footstep_yaw_rad",
     .rank = 12,
     .meaning = "how far the step's footstep is turned",
     .of_form = true,
     .move = &Pose2::yaw,
     .values = &Values::footstep_yaws,
     .stays = FootstepStays,
     .least = -1.0,
     .most = 1.0,
     .chosen = &Choice::footsteps,
     .bound_keys = {{{"most_footstep_yaw_rad", "of the turn of a footstep, to either side", 0.1, 0,
                      1, "rad"}}},
     .range_of = AboutZero},
    {.family = ParameterFamily::kRiseBegin,
     .name = "rise_begin",
     .of = kHalfStep,
     .part = ParameterPart::kProfile,
     .column = "rise_begin",
     .rank = 13,
     .meaning =
         "fraction of T from (down: to) the half-step's end on the floor, in which the waist "
         "keeps its height",
     .of_form = true,
     .of_heights = true,
     .shape = &HalfStepShape::rise_begin,
     .stays = WaistKeepsHeight,
     .least = 0.0,
     .most = 0.75,
     .chosen = &Choice::heights,
     .range_of = Anywhere},
    {.family = ParameterFamily::kRiseEnd,
     .name = "rise_end",
     .of = kHalfStep,
     .part = ParameterPart::kProfile,
     .column = "rise_end",
     .rank = 14,
     .meaning =
         "fraction of T from (down: to) the half-step's end on the floor, by which the waist "
         "has risen (down: begins to sink)",
     .of_form = true,
     .of_heights = true,
     .shape = &HalfStepShape::rise_end,
     .stays = WaistKeepsHeight,
     .least = 0.85,
     .most = 1.0,
     .chosen = &Choice::heights,
     .range_of = Anywhere},
}};

// The number of a half-step that a row is has to be told where its part has one, and nowhere else.
constexpr bool TellsItsNumber(const Row& row) {
  const bool number = row.number != nullptr, shape = row.shape != nullptr;
  const bool move = row.move != nullptr;
  if (row.factor && row.part != ParameterPart::kState) return false;
  switch (row.part) {
    case ParameterPart::kBegin:
      return !number && !shape && !move;
    case ParameterPart::kDuration:
      return number && !shape && !move;
    case ParameterPart::kState:
      return number != shape && !move;
    case ParameterPart::kProfile:
      return !number && shape && !move;
    case ParameterPart::kFootstep:
      return !number && !shape && move;
  }
  return false;
}

// Whether another row has the same name, column, key, place of values or of the flag.
constexpr bool IsOneOfAKind(const Row& row) {
  return std::ranges::all_of(kRows, [&row](const Row& other) {
    if (other.family == row.family) return true;
    const bool same_flag = row.chosen != nullptr && other.chosen == row.chosen;
    return other.name != row.name && other.column != row.column &&
           (other.rank != row.rank || (other.of == kJunction) != (row.of == kJunction)) &&
           (row.key.empty() || other.key != row.key) &&
           (row.values == nullptr || other.values != row.values) &&
           (!same_flag || row.key.empty() || other.key.empty());
  });
}

constexpr bool IsComplete(const Row& row) {
  return !row.name.empty() && !row.column.empty() && !row.meaning.empty() && row.least < row.most &&
         row.range_of != nullptr && TellsItsNumber(row) &&
         (row.of == kJunction) == (row.part == ParameterPart::kBegin) &&
         (row.of_form || row.values != nullptr) &&
         (row.always || row.range_of == Anywhere || row.bounds().size() > 0) &&
         (row.always || !row.key.empty() || row.chosen != nullptr) &&
         (row.always || row.key.empty() || !row.key_meaning.empty());
}

constexpr bool StandsInItsPlace(size_t i) {
  return kRows[i].family == static_cast<ParameterFamily>(i);
}

template <size_t... kIndex>
constexpr bool CheckRows(std::index_sequence<kIndex...>) {
  static_assert((StandsInItsPlace(kIndex) && ...),
                "a family has no row, or the row is not in the order of ParameterFamily");
  static_assert((IsComplete(kRows[kIndex]) && ...), "a row leaves out what it has to say");
  static_assert((IsOneOfAKind(kRows[kIndex]) && ...), "two rows say the same");
  return true;
}
static_assert(CheckRows(std::make_index_sequence<kRows.size()>()));

}  // namespace

const ParameterFamilyTraits& Traits(ParameterFamily family) { return Nth(kRows, family); }

}  // namespace halfstep
