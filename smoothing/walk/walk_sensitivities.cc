#include <algorithm>

#include "smoothing/walk/superposed_walk.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Derivative of a half-step's contribution delta·(π, π̇, π̈) when its local time moves by dtau and
// its duration by dT.
void AddProfileDerivative(const HalfStepJet& profiles, const WalkState& delta, double dtau,
                          double dT, WalkJet* jet) {
  for (int q = 0; q < kNumQuantities; ++q) {
    const ProfileJet& p = profiles.of(q);
    jet->value[q] += (p.first * dtau + p.value_T * dT) * delta[q];
    jet->first[q] += (p.second * dtau + p.first_T * dT) * delta[q];
    jet->second[q] += (p.third * dtau + p.second_T * dT) * delta[q];
  }
}

// Derivative of quantity q of a half-step's contribution when q moves by `moved` in its state at
// the via point. That is where an up half-step ends and a down half-step begins; `first`: the walk
// is superposed from this half-step's start.
void AddViaDerivative(const HalfStepJet& profiles, HalfStepKind kind, bool first, double moved,
                      int q, WalkJet* jet) {
  const bool down = kind == HalfStepKind::kDown;
  const ProfileJet& p = profiles.of(q);
  const double change = down ? -moved : moved;
  jet->value[q] += change * p.value + (down && first ? moved : 0.0);
  jet->first[q] += change * p.first;
  jet->second[q] += change * p.second;
}

// How a sole's place moves along a parameter, in W: (x, y, yaw).
using SoleMove = Eigen::Vector3d;

// A point that stands still on a sole at X_WF.
Eigen::Vector2d Moved(const SoleMove& move, const Eigen::Vector2d& from_sole_W) {
  return move.head<2>() + move.z() * Eigen::Vector2d(-from_sole_W.y(), from_sole_W.x());
}

void MoveFoot(Side side, const Eigen::Vector2d& by, double yaw, WalkState* x) {
  x->segment<2>(FootIndex(side)) = by;
  (*x)[FootIndex(side) + 3] = yaw;
}

// Of the state with both feet on the floor, in W.
WalkState OnFloorMoved(const HalfStep& h, const SoleMove& support, const SoleMove& swing) {
  const SoleMove middle = 0.5 * (support + swing);
  WalkState x = WalkState::Zero();
  x.segment<2>(kComX) = x.segment<2>(kZmpX) = middle.head<2>();
  x[kWaistYaw] = middle.z();
  MoveFoot(h.support, support.head<2>(), support.z(), &x);
  MoveFoot(h.swing(), swing.head<2>(), swing.z(), &x);
  return x;
}

// Of the state at the via point, which goes with the support sole.
WalkState AtViaMoved(const HalfStep& h, const Eigen::Matrix2d& R_WS, const SoleMove& support) {
  WalkState x = WalkState::Zero();
  x.segment<2>(kComX) = x.segment<2>(kZmpX) = Moved(support, R_WS * h.support_point());
  x[kWaistYaw] = support.z();
  MoveFoot(h.support, support.head<2>(), support.z(), &x);
  MoveFoot(h.swing(), Moved(support, R_WS * h.via().position()), support.z(), &x);
  return x;
}

// What a half-step under way, its support sole at X_WS, has to do with the moves of footsteps.
struct OnFootsteps {
  const HalfStep& half_step;
  const Foothold& X_WS;
  const HalfStepFootsteps& on;
  const HomotopyParameters& parameters;
  bool first;  // whether the walk is superposed from its start
};

// Adds its derivatives along these moves; jet_of(parameter) is where a derivative is summed up.
template <typename JetOf>
void AddFootstepDerivatives(const OnFootsteps& p, const HalfStepJet& profiles,
                            const ParameterFilter& wanted, const JetOf& jet_of) {
  using Family = ParameterFamily;
  const HalfStep& h = p.half_step;
  const Eigen::Matrix2d R_WS = p.X_WS.Planar().rotation();
  const bool up = h.kind == HalfStepKind::kUp;
  for (const auto& [step, is_support] : {std::pair{p.on.support, true}, {p.on.swing, false}}) {
    if (step < 0) continue;
    const double turned = Nth(p.parameters.footstep_yaws, step);
    const double yaw = p.X_WS.yaw + (is_support ? 0.0 : h.X_SF.yaw);
    const Eigen::Matrix2d planned = Eigen::Rotation2Dd(yaw - turned).toRotationMatrix();
    const std::array<std::pair<Family, SoleMove>, 3> moves = {
        {{Family::kFootstepX, {planned(0, 0), planned(1, 0), 0.0}},
         {Family::kFootstepY, {planned(0, 1), planned(1, 1), 0.0}},
         {Family::kFootstepYaw, SoleMove::UnitZ()}}};
    for (const auto& [family, move] : moves) {
      if (wanted && !wanted({family, step})) continue;
      const SoleMove support = is_support ? move : SoleMove::Zero();
      const WalkState floor = OnFloorMoved(h, support, is_support ? SoleMove::Zero() : move);
      const WalkState via = AtViaMoved(h, R_WS, support);
      const WalkState &from = up ? floor : via, &to = up ? via : floor;
      WalkJet& jet = jet_of({family, step});
      if (p.first) jet.value += from;
      for (int q = 0; q < kNumQuantities; ++q) {
        const ProfileJet& profile = profiles.of(q);
        jet.value[q] += profile.value * (to[q] - from[q]);
        jet.first[q] += profile.first * (to[q] - from[q]);
        jet.second[q] += profile.second * (to[q] - from[q]);
      }
    }
  }
}

}  // namespace

void SuperposedWalk::Sensitivities(const LocalTime& at, std::vector<WalkSensitivity>* out,
                                   const ParameterFilter& wanted) const {
  using Family = HomotopyParameter::Family;
  out->clear();
  const auto jet_of = [out](HomotopyParameter parameter) -> WalkJet& {
    for (WalkSensitivity& s : *out) {
      if (s.parameter == parameter) return s.jet;
    }
    out->push_back({parameter, {}});
    return out->back().jet;
  };
  const int k = at.half_step;
  const int first = FirstActive(at), last = LastActive(at);
  for (int i = first; i <= last; ++i) {
    const Piece& p = piece(i);
    const HalfStepJet profiles = p.profiles.At(LocalTo(i, at));
    // τ_i = τ + t_k − t_i, and every T_m − Δ_m between i and k moves it.
    const double sign = i < k ? 1.0 : -1.0;
    for (int m = std::min(i, k); m < std::max(i, k); ++m) {
      AddProfileDerivative(profiles, p.delta_W, -sign, 0.0, &jet_of({Family::kOverlap, m}));
      AddProfileDerivative(profiles, p.delta_W, sign, 0.0, &jet_of({Family::kDuration, m}));
    }
    AddProfileDerivative(profiles, p.delta_W, 0.0, 1.0, &jet_of({Family::kDuration, i}));

    const HalfStep& h = p.half_step;
    const auto is_wanted = [&wanted](const HomotopyParameter& parameter) {
      return !wanted || wanted(parameter);
    };
    // `parameter` moves quantities q and q + 1 of the state at the via point along `by`.
    const auto move_via = [&](const HomotopyParameter& parameter, const Eigen::Vector2d& by,
                              int q) {
      if (!is_wanted(parameter)) return;
      WalkJet& jet = jet_of(parameter);
      AddViaDerivative(profiles, h.kind, i == first, by.x(), q, &jet);
      AddViaDerivative(profiles, h.kind, i == first, by.y(), q + 1, &jet);
    };
    const Eigen::Matrix2d R_WS = p.X_WS.Planar().rotation();
    const Eigen::Vector2d aside = R_WS.col(1) * Sign(h.swing());
    for (const Family family : AllParameterFamilies()) {
      const ParameterFamilyTraits& traits = Traits(family);
      const HomotopyParameter parameter{family, traits.index_at(i)};
      switch (traits.part) {
        case ParameterPart::kHeight:
          if (!is_wanted(parameter)) break;
          AddViaDerivative(profiles, h.kind, i == first, p.planned_height, FootIndex(h.swing()) + 2,
                           &jet_of(parameter));
          break;
        case ParameterPart::kSupportPoint:
          move_via(parameter, aside, kComX);
          move_via(parameter, aside, kZmpX);
          break;
        case ParameterPart::kViaAside:
          move_via(parameter, aside, FootIndex(h.swing()));
          break;
        case ParameterPart::kViaAlong:
          move_via(parameter, R_WS.col(0), FootIndex(h.swing()));
          break;
        case ParameterPart::kBegin:
        case ParameterPart::kDuration:
        case ParameterPart::kProfile:
        case ParameterPart::kFootstep:
          break;
      }
    }
    for (const Family family : AllParameterFamilies()) {
      const ParameterFamilyTraits& traits = Traits(family);
      if (traits.part != ParameterPart::kProfile || !is_wanted({family, i})) continue;
      const HalfStepJet by = p.profiles.ByShape(traits.shape, LocalTo(i, at));
      WalkJet& jet = jet_of({family, i});
      for (int q = 0; q < kNumQuantities; ++q) {
        jet.value[q] += by.of(q).value * p.delta_W[q];
        jet.first[q] += by.of(q).first * p.delta_W[q];
        jet.second[q] += by.of(q).second * p.delta_W[q];
      }
    }
    AddFootstepDerivatives({h, p.X_WS, p.on, parameters_, i == first}, profiles, wanted, jet_of);
  }
  if (wanted) {
    std::erase_if(*out, [&](const WalkSensitivity& s) { return !wanted(s.parameter); });
  }
}

void SuperposedWalk::StartSensitivities(
    int half_step, std::vector<std::pair<HomotopyParameter, double>>* out) const {
  out->clear();
  for (int m = 0; m < half_step; ++m) {
    out->push_back({{ParameterFamily::kOverlap, m}, -1.0});
    out->push_back({{ParameterFamily::kDuration, m}, 1.0});
  }
}

}  // namespace halfstep
