#include "smoothing/walk/form_families.h"

#include <algorithm>

#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {
namespace {

const HalfStep& PlannedHalfStep(const HalfStepSequence& sequence, int i) {
  return sequence.half_steps[static_cast<size_t>(i)].half_step;
}

// A number of the shape of each half-step.
constexpr ParameterFamilyTraits OfShape(double HalfStepShape::*shape,
                                        double (*planned)(const HalfStepSequence&, int)) {
  ParameterFamilyTraits traits{};
  traits.table = "half_steps";
  traits.of_form = true;
  traits.shape = shape;
  traits.count = [](const HalfStepSequence& sequence) { return sequence.size(); };
  traits.planned = planned;
  traits.half_steps = [](int i) { return std::pair{i, i}; };
  traits.index_at = [](int half_step) { return half_step; };
  traits.least_itself = true;
  return traits;
}

constexpr ParameterBoundKey kViaBounds[] = {
    {"least_via_lateral_m", "of the via point from the support sole's centre",
     &ParameterChoice::least_via_lateral, 0.01, 1, "m"},
    {"most_via_lateral_m", "of the via point from the support sole's centre",
     &ParameterChoice::most_via_lateral, 0.01, 1, "m"}};

// A number of the via point of each step, which both its half-steps share.
constexpr ParameterFamilyTraits OfVia(double (*planned)(const HalfStepSequence&, int)) {
  ParameterFamilyTraits traits{};
  traits.unit = "m";
  traits.table = "half_steps";
  traits.of_form = true;
  traits.count = [](const HalfStepSequence& sequence) { return sequence.num_steps(); };
  traits.planned = planned;
  traits.half_steps = [](int j) { return std::pair{2 * j, 2 * j + 1}; };
  traits.index_at = [](int half_step) { return half_step / 2; };
  traits.least_itself = true;
  return traits;
}

constexpr ParameterFamilyTraits kViaLateral = [] {
  ParameterFamilyTraits traits = OfVia([](const HalfStepSequence& sequence, int j) {
    return PlannedHalfStep(sequence, 2 * j).via_lateral;
  });
  traits.name = "via_lateral";
  traits.column = "via_lateral_m";
  traits.rank = 3;
  traits.meaning = "of the via point from the support sole's centre";
  traits.values = &HomotopyParameters::via_laterals;
  traits.least = 0.01;
  traits.most = 1.0;
  traits.chosen = &ParameterChoice::via_laterals;
  traits.key = "via_laterals";
  traits.key_meaning = "distances of via points are variables beside the overlaps";
  traits.bounds = kViaBounds;
  traits.range = [](const ParameterChoice& choice, double planned) {
    return std::pair{std::min(choice.least_via_lateral, planned),
                     std::max(choice.most_via_lateral, planned)};
  };
  return traits;
}();

constexpr ParameterBoundKey kAlongBounds[] = {
    {"most_via_along_m", "of the via point from where it is planned, along the support sole's x",
     &ParameterChoice::most_via_along, 0, 0.5, "m"}};

constexpr ParameterFamilyTraits kViaAlong = [] {
  ParameterFamilyTraits traits = OfVia([](const HalfStepSequence& sequence, int j) {
    return PlannedHalfStep(sequence, 2 * j).via_along;
  });
  traits.name = "via_along";
  traits.column = "via_along_m";
  traits.rank = 7;
  traits.meaning = "of the via point ahead of the support sole's centre";
  traits.values = &HomotopyParameters::via_alongs;
  traits.least = -0.5;
  traits.most = 0.5;
  traits.chosen = &ParameterChoice::via_alongs;
  traits.key = "via_alongs";
  traits.key_meaning = "how far ahead via points are is variable beside the overlaps";
  traits.bounds = kAlongBounds;
  traits.range = [](const ParameterChoice& choice, double planned) {
    return std::pair{std::max(-0.5, planned - choice.most_via_along),
                     std::min(0.5, planned + choice.most_via_along)};
  };
  return traits;
}();

constexpr ParameterBoundKey kRampBounds[] = {{"least_foot_ramp",
                                              "of a foot's motion; at most it is 0.5",
                                              &ParameterChoice::least_foot_ramp, 0.1, 0.5, ""}};

constexpr ParameterFamilyTraits kFootRamp = [] {
  ParameterFamilyTraits traits =
      OfShape(&HalfStepShape::foot_ramp, [](const HalfStepSequence& sequence, int i) {
        return PlannedHalfStep(sequence, i).shape.foot_ramp;
      });
  traits.name = "foot_ramp";
  traits.column = "foot_ramp";
  traits.rank = 4;
  traits.meaning = "fraction of the foot's motion in which its speed rises, and falls";
  traits.values = &HomotopyParameters::foot_ramps;
  traits.least = 0.1;
  traits.most = 0.5;
  traits.chosen = &ParameterChoice::foot_ramps;
  traits.key = "foot_ramps";
  traits.key_meaning = "ramps of the foot's speed are variables beside the overlaps";
  traits.bounds = kRampBounds;
  traits.range = [](const ParameterChoice& choice, double planned) {
    return std::pair{std::min(choice.least_foot_ramp, planned), 0.5};
  };
  return traits;
}();

constexpr ParameterBoundKey kDelayBounds[] = {
    {"least_foot_delay", "of T, between floor and horizontal motion",
     &ParameterChoice::least_foot_delay, 0, 0.2, ""},
    {"most_foot_delay", "of T, between floor and horizontal motion",
     &ParameterChoice::most_foot_delay, 0, 0.2, ""}};

constexpr ParameterFamilyTraits kFootDelay = [] {
  ParameterFamilyTraits traits =
      OfShape(&HalfStepShape::horizontal_delay, [](const HalfStepSequence& sequence, int i) {
        return PlannedHalfStep(sequence, i).shape.horizontal_delay;
      });
  traits.name = "foot_delay";
  traits.column = "foot_delay";
  traits.rank = 5;
  traits.meaning = "fraction of T between take-off (landing) and the foot's horizontal motion";
  traits.values = &HomotopyParameters::foot_delays;
  traits.least = 0.0;
  traits.most = 0.2;
  traits.chosen = &ParameterChoice::foot_delays;
  traits.key = "foot_delays";
  traits.key_meaning = "delays of the foot's horizontal motion are variables beside the overlaps";
  traits.bounds = kDelayBounds;
  traits.range = [](const ParameterChoice& choice, double planned) {
    return std::pair{std::min(choice.least_foot_delay, planned),
                     std::max(choice.most_foot_delay, planned)};
  };
  return traits;
}();

constexpr ParameterBoundKey kLiftBounds[] = {{"least_lift_share",
                                              "of a foot's flight; at most it is 1",
                                              &ParameterChoice::least_lift_share, 0.2, 1, ""}};

constexpr ParameterFamilyTraits kLiftShare = [] {
  ParameterFamilyTraits traits =
      OfShape(&HalfStepShape::lift_share, [](const HalfStepSequence& sequence, int i) {
        return PlannedHalfStep(sequence, i).shape.lift_share;
      });
  traits.name = "lift_share";
  traits.column = "lift_share";
  traits.rank = 6;
  traits.meaning = "fraction of the foot's flight in which it rises, or sinks";
  traits.values = &HomotopyParameters::lift_shares;
  traits.least = 0.2;
  traits.most = 1.0;
  traits.chosen = &ParameterChoice::lift_shares;
  traits.key = "lift_shares";
  traits.key_meaning = "how fast feet rise and sink are variables beside the overlaps";
  traits.bounds = kLiftBounds;
  traits.range = [](const ParameterChoice& choice, double planned) {
    return std::pair{std::min(choice.least_lift_share, planned), 1.0};
  };
  return traits;
}();

constexpr ParameterBoundKey kShiftBounds[] = {{"least_zmp_shift", "of T, in which the ZMP shifts",
                                               &ParameterChoice::least_zmp_shift, 0.01, 0.3, ""},
                                              {"most_zmp_shift", "of T, in which the ZMP shifts",
                                               &ParameterChoice::most_zmp_shift, 0.01, 0.3, ""}};

constexpr ParameterFamilyTraits kZmpShift = [] {
  ParameterFamilyTraits traits =
      OfShape(&HalfStepShape::shift, [](const HalfStepSequence& sequence, int i) {
        return PlannedHalfStep(sequence, i).shape.shift;
      });
  traits.name = "zmp_shift";
  traits.column = "zmp_shift";
  traits.rank = 8;
  traits.meaning = "fraction of T in which the ZMP shifts";
  traits.values = &HomotopyParameters::zmp_shifts;
  traits.least = 0.01;
  traits.most = 0.5;
  traits.chosen = &ParameterChoice::zmp_shifts;
  traits.key = "zmp_shifts";
  traits.key_meaning = "how long ZMPs shift is variable beside the overlaps";
  traits.bounds = kShiftBounds;
  traits.range = [](const ParameterChoice& choice, double planned) {
    return std::pair{std::min(choice.least_zmp_shift, planned),
                     std::max(choice.most_zmp_shift, planned)};
  };
  return traits;
}();

constexpr ParameterBoundKey kBumpBounds[] = {{"least_zmp_bump_ramp",
                                              "of a ZMP's bump; at most it is 1, a round bump",
                                              &ParameterChoice::least_zmp_bump_ramp, 0.1, 1, ""}};

constexpr ParameterFamilyTraits kZmpBumpRamp = [] {
  ParameterFamilyTraits traits =
      OfShape(&HalfStepShape::bump_ramp, [](const HalfStepSequence& sequence, int i) {
        return PlannedHalfStep(sequence, i).shape.bump_ramp;
      });
  traits.name = "zmp_bump_ramp";
  traits.column = "zmp_bump_ramp";
  traits.rank = 9;
  traits.meaning = "fraction of the ZMP's bump in which it rises, and falls; 1: it is round";
  traits.values = &HomotopyParameters::zmp_bump_ramps;
  traits.least = 0.1;
  traits.most = 1.0;
  traits.chosen = &ParameterChoice::zmp_bump_ramps;
  traits.key = "zmp_bump_ramps";
  traits.key_meaning = "ramps of ZMPs' bumps are variables beside the overlaps";
  traits.bounds = kBumpBounds;
  traits.range = [](const ParameterChoice& choice, double planned) {
    return std::pair{std::min(choice.least_zmp_bump_ramp, planned), 1.0};
  };
  return traits;
}();

}  // namespace

const ParameterFamilyTraits& FormTraits(ParameterFamily family) {
  switch (family) {
    case ParameterFamily::kFootRamp:
      return kFootRamp;
    case ParameterFamily::kFootDelay:
      return kFootDelay;
    case ParameterFamily::kLiftShare:
      return kLiftShare;
    case ParameterFamily::kViaAlong:
      return kViaAlong;
    case ParameterFamily::kZmpShift:
      return kZmpShift;
    case ParameterFamily::kZmpBumpRamp:
      return kZmpBumpRamp;
    default:
      return kViaLateral;
  }
}

}  // namespace halfstep
