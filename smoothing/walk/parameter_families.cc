#include "smoothing/walk/parameter_families.h"

#include <algorithm>
#include <limits>

#include "smoothing/walk/footstep_families.h"
#include "smoothing/walk/form_families.h"
#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr ParameterFamilyTraits kOverlap = {
    .name = "overlap",
    .unit = "s",
    .table = "overlaps",
    .column = "overlap_s",
    .rank = 0,
    .meaning = "how long both half-steps are under way; below 0: a rest between them",
    .of_form = false,
    .shape = nullptr,
    .move = nullptr,
    .values = &HomotopyParameters::overlaps,
    .count = [](const HalfStepSequence& sequence) { return sequence.num_junctions(); },
    .planned = [](const HalfStepSequence&, int) { return 0.0; },
    .stays = nullptr,
    .half_steps =
        [](int i) {
          return std::pair{i, i + 1};
        },
    .index_at = [](int half_step) { return half_step; },
    .joins = true,
    .least = -kLongestRest,
    .least_itself = true,
    .most = kInfinity,
    .chosen = nullptr,
    .key = "overlaps",
    .key_meaning = "",
    .bounds = {},
    .range =
        [](const ParameterChoice&, double) {
          return std::pair{0.0, kInfinity};
        },
};

constexpr ParameterBoundKey kHeightBounds[] = {{"least_height_scale", "of the planned height",
                                                &ParameterChoice::least_height_scale, 0.01, 1, ""}};

constexpr ParameterFamilyTraits kHeightScale = {
    .name = "height_scale",
    .unit = "",
    .table = "half_steps",
    .column = "height_scale",
    .rank = 1,
    .meaning = "scale of the foot's height in its step",
    .of_form = false,
    .shape = nullptr,
    .move = nullptr,
    .values = &HomotopyParameters::height_scales,
    .count = [](const HalfStepSequence& sequence) { return sequence.num_steps(); },
    .planned = [](const HalfStepSequence&, int) { return 1.0; },
    .stays = nullptr,
    .half_steps =
        [](int j) {
          return std::pair{2 * j, 2 * j + 1};
        },
    .index_at = [](int half_step) { return half_step / 2; },
    .joins = false,
    .least = 0.0,
    .least_itself = true,
    .most = 10.0,
    .chosen = &ParameterChoice::heights,
    .key = "heights",
    .key_meaning = "foot-height scales are variables beside the overlaps",
    .bounds = kHeightBounds,
    .range =
        [](const ParameterChoice& choice, double planned) {
          return std::pair{choice.least_height_scale, planned};
        },
};

constexpr ParameterBoundKey kDurationBounds[] = {
    {"least_duration", "of the planned duration of a half-step", &ParameterChoice::least_duration,
     0.2, 1, ""},
    {"most_duration", "of the planned duration of a half-step", &ParameterChoice::most_duration, 1,
     5, ""}};

constexpr ParameterFamilyTraits kDuration = {
    .name = "duration",
    .unit = "s",
    .table = "half_steps",
    .column = "duration_s",
    .rank = 0,
    .meaning = "T",
    .of_form = false,
    .shape = nullptr,
    .move = nullptr,
    .values = &HomotopyParameters::durations,
    .count = [](const HalfStepSequence& sequence) { return sequence.size(); },
    .planned = [](const HalfStepSequence& sequence,
                  int i) { return sequence.half_steps[static_cast<size_t>(i)].half_step.duration; },
    .stays = nullptr,
    .half_steps =
        [](int i) {
          return std::pair{i, i};
        },
    .index_at = [](int half_step) { return half_step; },
    .joins = false,
    .least = 0.0,
    .least_itself = false,
    .most = 60.0,
    .chosen = &ParameterChoice::durations,
    .key = "durations",
    .key_meaning = "durations of half-steps are variables beside the overlaps",
    .bounds = kDurationBounds,
    .range =
        [](const ParameterChoice& choice, double planned) {
          return std::pair{choice.least_duration * planned, choice.most_duration * planned};
        },
};

constexpr ParameterBoundKey kSupportBounds[] = {
    {"least_support_point_m", "of the support sole's centre, towards the other foot",
     &ParameterChoice::least_support_point, -1, 1, "m"},
    {"most_support_point_m", "of the support sole's centre, towards the other foot",
     &ParameterChoice::most_support_point, -1, 1, "m"}};

constexpr ParameterFamilyTraits kSupportPoint = {
    .name = "support_point",
    .unit = "m",
    .table = "half_steps",
    .column = "support_point_m",
    .rank = 2,
    .meaning = "where CoM and ZMP rest on one foot, from its centre towards the other foot",
    .of_form = false,
    .shape = nullptr,
    .move = nullptr,
    .values = &HomotopyParameters::support_points,
    .count = [](const HalfStepSequence& sequence) { return sequence.num_steps(); },
    .planned =
        [](const HalfStepSequence& sequence, int j) {
          return sequence.half_steps[2 * static_cast<size_t>(j)].half_step.shape.support_offset;
        },
    .stays = nullptr,
    .half_steps =
        [](int j) {
          return std::pair{2 * j, 2 * j + 1};
        },
    .index_at = [](int half_step) { return half_step / 2; },
    .joins = false,
    .least = -1.0,
    .least_itself = true,
    .most = 1.0,
    .chosen = &ParameterChoice::support_points,
    .key = "support_points",
    .key_meaning = "support points are variables beside the overlaps",
    .bounds = kSupportBounds,
    .range =
        [](const ParameterChoice& choice, double planned) {
          return std::pair{std::min(choice.least_support_point, planned),
                           std::max(choice.most_support_point, planned)};
        },
};

}  // namespace

ParameterChoice EveryFamily() {
  ParameterChoice all;
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (Traits(family).chosen != nullptr) all.*Traits(family).chosen = true;
  }
  return all;
}

ParameterChoice WithoutForms(ParameterChoice choice) {
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (Traits(family).of_form) choice.*Traits(family).chosen = false;
  }
  return choice;
}

const ParameterFamilyTraits& Traits(ParameterFamily family) {
  switch (family) {
    case ParameterFamily::kOverlap:
      return kOverlap;
    case ParameterFamily::kHeightScale:
      return kHeightScale;
    case ParameterFamily::kDuration:
      return kDuration;
    case ParameterFamily::kSupportPoint:
      return kSupportPoint;
    case ParameterFamily::kFootstepX:
    case ParameterFamily::kFootstepY:
    case ParameterFamily::kFootstepYaw:
      return FootstepTraits(family);
    default:
      return FormTraits(family);
  }
}

}  // namespace halfstep
