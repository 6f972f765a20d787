#include "wpg/motion/half_step_tracks.h"

#include <cmath>
#include <optional>

#include "wpg/nth.h"

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

}  // namespace

HalfStepTracks::HalfStepTracks(const HalfStep& half_step, const MotionModel& model,
                               const Foothold& X_WS)
    : shape_(half_step.shape),
      duration_(half_step.duration),
      foot_(FootWindow(half_step.kind, half_step.shape)),
      lift_(LiftWindow(half_step.kind, half_step.shape)),
      tracks_(TracksOf(half_step.swing())),
      start_(Transformed(X_WS, half_step.Start())) {
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

void HalfStepTracks::AddSecondBounds(double from, double to, WalkState* bounds) const {
  if (to / duration_ <= 0.0 || from / duration_ >= 1.0) return;
  std::array<double, kNumProfiles> second{};
  for (size_t i = 0; i < num_profiles(); ++i) second[i] = profiles_[i]->SecondBound(from, to);
  for (const Track& track : tracks_) {
    (*bounds)[track.quantity] += Nth(second, track.profile) * std::abs(track.change);
  }
}

void HalfStepTracks::AddThirdRanges(double from, double to, WalkThirds* thirds) const {
  std::array<std::optional<Range>, kNumProfiles> thirds_of;
  for (const Track& track : tracks_) {
    if (!Nth(kQuantities, track.quantity).bounded_third) continue;
    if (track.profile == kRiseProfile && !rises_) continue;
    std::optional<Range>& known = Nth(thirds_of, track.profile);
    if (!known) known = Nth(profiles_, track.profile)->ThirdRange(from, to);
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
