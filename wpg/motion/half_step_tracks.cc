#include "wpg/motion/half_step_tracks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

std::array<Track, HalfStepTracks::kNumTracks> TracksOf(Side swing) {
  const auto foot = [first = FootIndex(swing)](int i) { return static_cast<Quantity>(first + i); };
  return {{{kComX, kComProfile},
           {kComY, kComProfile},
           {kZmpX, kZmpProfile},
           {kZmpY, kZmpProfile},
           {kWaistYaw, kYawProfile},
           {foot(0), kFootProfile},
           {foot(1), kFootProfile},
           {foot(2), kLiftProfile},
           {foot(3), kFootProfile},
           {kWaistZ, kRiseProfile}}};
}

double Sum(const Foothold& X) { return std::abs(X.x) + std::abs(X.y); }

// Of a state at rest in W, where the swing foot's foothold is exact in W, and X_SF was computed
// from it: 10 roundings of each product of a coordinate and a sine or cosine, there and back.
WalkState PlaceError(const HalfStep& half_step, const Foothold& X_WS) {
  const Pose2 via = half_step.via();
  const double local = std::max({Sum(half_step.X_SF), std::abs(via.x) + std::abs(via.y),
                                 std::abs(half_step.shape.support_point)});
  const double yaw = 2.0 * (std::abs(X_WS.yaw) + std::abs(half_step.X_SF.yaw));
  const double height =
      4.0 * (std::abs(X_WS.height) + std::abs(half_step.X_SF.height) + half_step.via_height +
             std::max(half_step.shape.crouch, half_step.crouch_on_floor()));
  const double place = 20.0 * (Sum(X_WS) + local) + yaw * local;
  WalkState error;
  for (const QuantityTraits& row : kQuantities) {
    error[row.quantity] = kRoundoff * (row.component == Component::kYaw ? yaw
                                       : row.component == Component::kZ ? height
                                                                        : place);
  }
  return error;
}

}  // namespace

HalfStepTracks::HalfStepTracks(const HalfStep& half_step, const MotionModel& model,
                               const Foothold& X_WS)
    : shape_(half_step.shape),
      duration_(half_step.duration),
      foot_(FootWindow(half_step.kind, half_step.shape)),
      lift_(LiftWindow(half_step.kind, half_step.shape)),
      tracks_(TracksOf(half_step.swing())),
      start_(Transformed(X_WS, half_step.Start())),
      place_error_(PlaceError(half_step, X_WS)) {
  const HalfStepKind kind = half_step.kind;
  const MotionModel::Proposal proposal = model.Propose(kind, shape_, duration_);
  profiles_ = {proposal.com,
               proposal.zmp,
               WaistYawProfile(duration_),
               FootProfile(kind, shape_, duration_),
               LiftProfile(kind, shape_, duration_),
               RiseProfile(kind, shape_, duration_)};
  const WalkState change = Transformed(X_WS, half_step.End()) - start_;
  for (Track& track : tracks_) track.change = change[track.quantity];
  rises_ = change[kWaistZ] != 0.0;
}

WalkJet HalfStepTracks::At(double tau) const {
  WalkJet jet;
  jet.value = start_;
  AddMotion(tau, &jet);
  return jet;
}

void HalfStepTracks::AddMotion(double tau, WalkJet* jet) const {
  const ProfileJets profiles = Profiles(tau);
  for (const Track& track : tracks_) {
    const ProfileJet& p = Nth(profiles, track.profile);
    jet->value[track.quantity] += p.value * track.change;
    jet->first[track.quantity] += p.first * track.change;
    jet->second[track.quantity] += p.second * track.change;
  }
}

void HalfStepTracks::AddRounding(double time, double places, WalkJet* error, WalkJet* size) const {
  const auto accuracy = [&](size_t i) {
    return i < num_profiles() ? profiles_[i]->Accuracy(time) : ProfileAccuracy();
  };
  const std::array<ProfileAccuracy, kNumProfiles> of = {
      accuracy(kComProfile),  accuracy(kZmpProfile),  accuracy(kYawProfile),
      accuracy(kFootProfile), accuracy(kLiftProfile), accuracy(kRiseProfile)};
  // Of quantities one after the other that move alike.
  const auto add = [&]<int kCount>(std::integral_constant<int, kCount>, const Track* track) {
    using Numbers = Eigen::Array<double, kCount, 1>;
    const auto& [e, most] = Nth(of, track->profile);
    const int q = track->quantity;
    Numbers change;
    for (int i = 0; i < kCount; ++i) change[i] = std::abs(track[i].change);
    // A mean of both ends, where the next half-step begins at one of them.
    const Numbers ends =
        2.0 * places * place_error_.segment<kCount>(q).array() + 3.0 * kRoundoff * change;
    error->value.segment<kCount>(q).array() += e.value * change + most.value * ends;
    error->first.segment<kCount>(q).array() += e.first * change + most.first * ends;
    error->second.segment<kCount>(q).array() += e.second * change + most.second * ends;
    size->value.segment<kCount>(q).array() += most.value * change;
    size->first.segment<kCount>(q).array() += most.first * change;
    size->second.segment<kCount>(q).array() += most.second * change;
  };
  constexpr std::integral_constant<int, 1> kOne;
  constexpr std::integral_constant<int, 2> kPlace;
  add(kPlace, &tracks_[0]);  // CoM
  add(kPlace, &tracks_[2]);  // ZMP
  add(kOne, &tracks_[4]);
  add(kPlace, &tracks_[5]);  // the swing foot
  add(kOne, &tracks_[7]);
  add(kOne, &tracks_[8]);
  if (rises_) add(kOne, &tracks_[9]);
}

void HalfStepTracks::AddSecondBounds(double from, double to, WalkState* bounds) const {
  if (to / duration_ <= 0.0 || from / duration_ >= 1.0) return;
  std::array<double, kNumProfiles> second{};
  for (size_t i = 0; i < num_profiles(); ++i) second[i] = profiles_[i]->SecondBound(from, to);
  for (const Track& track : tracks_) {
    (*bounds)[track.quantity] += Nth(second, track.profile) * std::abs(track.change);
  }
}

void HalfStepTracks::AddThirdRanges(double from, double to, double time, WalkThirds* thirds) const {
  // An exact time is at most 2·time from one between these, where knots cannot be on the other side
  // by rounding; 16·time leaves room for the arithmetic of the ranges.
  const double half = 0.5 * (to - from), a = from + time, b = to - time;
  const bool some = a < b && b > 0.0 && a < duration_;
  std::array<std::optional<Range>, kNumProfiles> thirds_of;
  for (const Track& track : tracks_) {
    if (!Nth(kQuantities, track.quantity).bounded_third) continue;
    if (track.profile == kRiseProfile && !rises_) continue;
    std::optional<Range>& known = Nth(thirds_of, track.profile);
    if (!known) {
      const Profile& profile = *Nth(profiles_, track.profile);
      known = some ? profile.ThirdRange(a, b) : Range();
      if (half > 0.0) known->radius += profile.Accuracy(16.0 * time).error.second / half;
    }
    const Range& range = *known;
    thirds->center[track.quantity] += range.center * track.change;
    thirds->radius[track.quantity] += range.radius * std::abs(track.change);
  }
}

const Profile& HalfStepTracks::of(Quantity quantity) const {
  for (const Track& track : tracks_) {
    if (track.quantity == quantity) return *Nth(profiles_, track.profile);
  }
  // Of the foot that stands: as that of the swing foot.
  return of(static_cast<Quantity>(quantity >= kRightX ? quantity - 4 : quantity + 4));
}

ProfileJets HalfStepTracks::Profiles(double tau) const {
  ProfileJets jets;
  for (size_t i = 0; i < num_profiles(); ++i) jets[i] = profiles_[i]->At(tau);
  return jets;
}

ProfileJets HalfStepTracks::ProfilesByShape(double HalfStepShape::*number, double tau) const {
  ProfileJets jets;
  for (size_t i = 0; i < num_profiles(); ++i) jets[i] = profiles_[i]->ByShape(number, tau);
  return jets;
}

std::vector<double> HalfStepTracks::Knots() const {
  std::vector<double> knots;
  for (size_t i = 0; i < num_profiles(); ++i) profiles_[i]->AddKnots(&knots);
  return knots;
}

}  // namespace halfstep
