#include <algorithm>

#include "smoothing/walk/superposed_walk.h"

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

// The same of its sway.
void AddSwayDerivative(const std::array<ProfileJet, 2>& sway, double dtau, double dT,
                       WalkJet* jet) {
  for (const int axis : {0, 1}) {
    const ProfileJet& d = sway[static_cast<size_t>(axis)];
    jet->value[kComX + axis] += d.first * dtau + d.value_T * dT;
    jet->first[kComX + axis] += d.second * dtau + d.first_T * dT;
    jet->second[kComX + axis] += d.third * dtau + d.second_T * dT;
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

}  // namespace

void SuperposedWalk::Sensitivities(const LocalTime& at, std::vector<WalkSensitivity>* out) const {
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
    const bool sways = !p.sway_W.none();
    const auto sway = p.sway_W.At(LocalTo(i, at), p.profiles.duration());
    for (int m = std::min(i, k); m < std::max(i, k); ++m) {
      AddProfileDerivative(profiles, p.delta_W, -sign, 0.0, &jet_of({Family::kOverlap, m}));
      AddProfileDerivative(profiles, p.delta_W, sign, 0.0, &jet_of({Family::kDuration, m}));
      if (!sways) continue;
      AddSwayDerivative(sway, -sign, 0.0, &jet_of({Family::kOverlap, m}));
      AddSwayDerivative(sway, sign, 0.0, &jet_of({Family::kDuration, m}));
    }
    AddProfileDerivative(profiles, p.delta_W, 0.0, 1.0, &jet_of({Family::kDuration, i}));
    if (sways) AddSwayDerivative(sway, 0.0, 1.0, &jet_of({Family::kDuration, i}));

    const HalfStep& h = p.half_step;
    AddViaDerivative(profiles, h.kind, i == first, p.planned_height, FootIndex(h.swing()) + 2,
                     &jet_of({Family::kHeightScale, i / 2}));
    const Eigen::Vector2d aside = p.X_WS.rotation().col(1) * Sign(h.swing());
    const auto move_via = [&](int q, WalkJet* jet) {
      AddViaDerivative(profiles, h.kind, i == first, aside.x(), q, jet);
      AddViaDerivative(profiles, h.kind, i == first, aside.y(), q + 1, jet);
    };
    WalkJet& support = jet_of({Family::kSupportPoint, i / 2});
    move_via(kComX, &support);
    move_via(kZmpX, &support);
    move_via(FootIndex(h.swing()), &jet_of({Family::kViaLateral, i / 2}));
    for (const Family family : {Family::kFootRamp, Family::kFootDelay, Family::kLiftShare}) {
      const HalfStepJet by = p.profiles.ByShape(Traits(family).shape, LocalTo(i, at));
      WalkJet& jet = jet_of({family, i});
      for (int q = FootIndex(h.swing()); q < FootIndex(h.swing()) + 4; ++q) {
        jet.value[q] += by.of(q).value * p.delta_W[q];
        jet.first[q] += by.of(q).first * p.delta_W[q];
        jet.second[q] += by.of(q).second * p.delta_W[q];
      }
    }
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
