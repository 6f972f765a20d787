#include <algorithm>

#include "smoothing/walk/superposed_walk.h"
#include "wpg/geometry/rotation.h"
#include "wpg/motion/rest_state_slopes.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// The families of a part.
template <ParameterPart part>
const std::vector<ParameterFamily>& FamiliesOf() {
  static const std::vector<ParameterFamily> families = [] {
    std::vector<ParameterFamily> of_part;
    for (const ParameterFamily family : AllParameterFamilies()) {
      if (Traits(family).part == part) of_part.push_back(family);
    }
    return of_part;
  }();
  return families;
}

// The derivatives along the parameters that are wanted, each summed up over half-steps.
class Sums {
 public:
  Sums(const ParameterFilter& wanted, std::vector<WalkSensitivity>* out)
      : wanted_(wanted), out_(*out) {
    out_.clear();
  }
  bool Wants(const HomotopyParameter& parameter) const { return !wanted_ || wanted_(parameter); }
  // That along a parameter that is wanted; valid until the next is asked for. `met`: it may have
  // been asked for before.
  WalkJet& Of(const HomotopyParameter& parameter, bool met = true) {
    if (met) {
      for (WalkSensitivity& s : out_) {
        if (s.parameter == parameter) return s.jet;
      }
    }
    out_.emplace_back().parameter = parameter;
    return out_.back().jet;
  }

 private:
  const ParameterFilter& wanted_;
  std::vector<WalkSensitivity>& out_;
};

// A half-step under way. Each function adds a derivative of its contribution.
class UnderWay {
 public:
  // `first`: the walk is superposed from this half-step's start.
  UnderWay(const HalfStepTracks& tracks, double tau, bool first)
      : tracks_(tracks), tau_(tau), first_(first), profiles_(tracks.Profiles(tau)) {}

  // Along its local time.
  void AddOfTime(WalkJet* jet) const {
    for (const Track& track : tracks_.tracks()) {
      const ProfileJet& p = Nth(profiles_, track.profile);
      Add(track.quantity, p.first, p.second, p.third, track.change, jet);
    }
  }
  // Along its duration, at a fixed local time.
  void AddOfDuration(WalkJet* jet) const {
    for (const Track& track : tracks_.tracks()) {
      const ProfileJet& p = Nth(profiles_, track.profile);
      Add(track.quantity, p.value_T, p.first_T, p.second_T, track.change, jet);
    }
  }
  // Along what changes the states in which it begins and ends, in W.
  void AddOfStates(const WalkState& from, const WalkState& to, WalkJet* jet) const {
    if (first_) jet->value += from;
    for (const Track& track : tracks_.tracks()) {
      const int q = track.quantity;
      if (to[q] == from[q]) continue;
      const ProfileJet& p = Nth(profiles_, track.profile);
      Add(q, p.value, p.first, p.second, to[q] - from[q], jet);
    }
  }
  // Along a number of its shape that changes the profiles.
  void AddOfProfiles(double HalfStepShape::*number, WalkJet* jet) const {
    const ProfileJets by = tracks_.ProfilesByShape(number, tau_);
    for (const Track& track : tracks_.tracks()) {
      const ProfileJet& p = Nth(by, track.profile);
      if (p.value == 0.0 && p.first == 0.0 && p.second == 0.0)
        continue;  // most do not depend on it
      Add(track.quantity, p.value, p.first, p.second, track.change, jet);
    }
  }

 private:
  static void Add(int q, double value, double first, double second, double change, WalkJet* jet) {
    jet->value[q] += value * change;
    jet->first[q] += first * change;
    jet->second[q] += second * change;
  }

  const HalfStepTracks& tracks_;
  double tau_;
  bool first_;
  ProfileJets profiles_;
};

void AddTimes(double rate, const WalkJet& of, WalkJet* jet) {
  jet->value += rate * of.value;
  jet->first += rate * of.first;
  jet->second += rate * of.second;
}

// Along what changes the states of `half_step` at rest, on the floor and at the via point, in W.
void AddOfStates(const HalfStep& half_step, const RestStateSlopes& slopes,
                 const UnderWay& under_way, WalkJet* jet) {
  const bool up = half_step.kind == HalfStepKind::kUp;
  under_way.AddOfStates(up ? slopes.floor : slopes.via, up ? slopes.via : slopes.floor, jet);
}

// The slope in W of the state at the via point, along a parameter that is a number of it, or
// multiplies one.
RestStateSlopes SlopesAlong(const ParameterFamilyTraits& traits, const HalfStep& half_step,
                            const HalfStep& planned, const Eigen::Matrix2d& R_WS) {
  const WalkState via_S = traits.number != nullptr ? ViaSlope(half_step, traits.number)
                                                   : ViaSlope(half_step, traits.shape);
  RestStateSlopes slopes{.via = Turned(R_WS, via_S)};
  if (traits.factor) slopes.via *= planned.*traits.number;
  return slopes;
}

// How a sole that would stand with rotation `planned` moves along a number of its footstep's move.
SoleMove MoveOfSole(double Pose2::*number, const Eigen::Matrix2d& planned) {
  if (number == &Pose2::yaw) return SoleMove::UnitZ();
  const Eigen::Index axis = number == &Pose2::x ? 0 : 1;
  return {planned(0, axis), planned(1, axis), 0.0};
}

}  // namespace

void SuperposedWalk::Sensitivities(const LocalTime& at, std::vector<WalkSensitivity>* out,
                                   const ParameterFilter& wanted,
                                   const ParameterRates& moving) const {
  using Family = HomotopyParameter::Family;
  Sums sums(wanted, out);
  const int k = at.half_step;
  const int first = FirstActive(at), last = LastActive(at);
  WalkJet in_time;  // along τ
  for (int i = first; i <= last; ++i) {
    const Piece& p = piece(i);
    const UnderWay under_way(p.tracks, LocalTo(i, at), i == first);
    WalkJet in_own_time;  // along τ_i
    under_way.AddOfTime(&in_own_time);
    AddTimes(1.0, in_own_time, &in_time);
    const auto add_of_time = [&](const HomotopyParameter& parameter, double rate) {
      if (sums.Wants(parameter)) AddTimes(rate, in_own_time, &sums.Of(parameter));
    };
    // τ_i = τ + t_k − t_i, and every T_m − Δ_m between i and k moves it.
    const double sign = i < k ? 1.0 : -1.0;
    for (int m = std::min(i, k); m < std::max(i, k); ++m) {
      add_of_time({Family::kOverlap, m}, -sign);
      add_of_time({Family::kDuration, m}, sign);
    }
    if (sums.Wants({Family::kDuration, i})) {
      under_way.AddOfDuration(&sums.Of({Family::kDuration, i}));
    }

    const Eigen::Matrix2d R_WS = p.X_WS.Planar().rotation();
    for (const Family family : FamiliesOf<ParameterPart::kState>()) {
      const ParameterFamilyTraits& traits = Traits(family);
      const HomotopyParameter parameter{family, traits.index_at(i)};
      if (!sums.Wants(parameter)) continue;
      AddOfStates(p.half_step, SlopesAlong(traits, p.half_step, p.planned, R_WS), under_way,
                  &sums.Of(parameter, /*met=*/i > first));
    }
    for (const Family family : FamiliesOf<ParameterPart::kProfile>()) {
      if (Traits(family).of_heights && !p.tracks.waist_rises()) continue;
      if (!sums.Wants({family, i})) continue;
      under_way.AddOfProfiles(Traits(family).shape, &sums.Of({family, i}, /*met=*/false));
    }
    const double swing_yaw = p.X_WS.yaw + p.half_step.X_SF.yaw;
    for (const auto& [step, yaw] : {std::pair{p.on.support, p.X_WS.yaw}, {p.on.swing, swing_yaw}}) {
      if (step < 0) continue;
      for (const Family family : FamiliesOf<ParameterPart::kFootstep>()) {
        if (!sums.Wants({family, step})) continue;
        const double turned = Nth(parameters_.footstep_yaws, step);
        const Eigen::Matrix2d planned = PlaneRotation(yaw - turned);
        const SoleMove move = MoveOfSole(Traits(family).move, planned), none = SoleMove::Zero();
        const bool is_support = step == p.on.support;
        AddOfStates(
            p.half_step,
            SlopesOfStates(p.half_step, p.X_WS, is_support ? move : none, is_support ? none : move),
            under_way, &sums.Of({family, step}));
      }
    }
  }
  for (const auto& [parameter, rate] : moving) {
    if (sums.Wants(parameter)) AddTimes(rate, in_time, &sums.Of(parameter));
  }
}

void SuperposedWalk::StartSensitivities(int half_step, ParameterRates* out) const {
  out->clear();
  for (int m = 0; m < half_step; ++m) {
    out->push_back({{ParameterFamily::kOverlap, m}, -1.0});
    out->push_back({{ParameterFamily::kDuration, m}, 1.0});
  }
}

}  // namespace halfstep
