#include "wpg/motion/lipm.h"

#include <algorithm>
#include <array>

#include "wpg/check.h"
#include "wpg/motion/unit_time.h"

namespace halfstep {
namespace {

// CoM and ZMP share one RestToRest.
class LipmProfile : public Profile {
 public:
  LipmProfile(std::shared_ptr<const RestToRest> shift, const HalfStepShape& shape,
              const UnitTime& time)
      : shift_(std::move(shift)), shape_(shape), time_(time) {}

  void AddKnots(std::vector<double>* knots) const override {
    const double T = time_.duration;
    knots->insert(knots->end(), {shape_.t1() * T, shape_.t2() * T, 0.5 * T, T});
    if (shape_.bump_ramp == 1.0) return;
    const double ramp = std::min(shape_.bump_ramp, 0.5);
    for (const double sigma : {ramp * shape_.t1(), (1.0 - ramp) * shape_.t1()}) {
      knots->push_back(sigma * T);
      knots->push_back((1.0 - sigma) * T);
    }
  }

 protected:
  const RestToRest& shift() const { return *shift_; }
  const UnitTime& time() const { return time_; }

 private:
  std::shared_ptr<const RestToRest> shift_;
  HalfStepShape shape_;
  UnitTime time_;
};

class LipmCom final : public LipmProfile {
 public:
  using LipmProfile::LipmProfile;

  ProfileJet At(double tau) const override {
    const double sigma = time().Of(tau);
    return time().Jet(shift().Com(sigma), sigma);
  }
  ProfileJet ByShape(double HalfStepShape::*number, double tau) const override {
    const double sigma = time().Of(tau);
    if (number == &HalfStepShape::shift) return time().Slope(shift().ComByShift(sigma), 1.0);
    if (number != &HalfStepShape::bump_ramp) return {};
    return time().Slope(shift().ComByBumpRamp(sigma), 1.0);
  }
  ProfileAccuracy Accuracy(double off) const override {
    return time().Accuracy(shift().ComAccuracy(), off);
  }
  double SecondBound(double, double) const override {
    return time().Second(shift().ComSecondBound());
  }
  Range ThirdRange(double from, double to) const override {
    return time().Third(shift().ComThirdRange(time().Of(from), time().Of(to)));
  }
};

class LipmZmp final : public LipmProfile {
 public:
  using LipmProfile::LipmProfile;

  ProfileJet At(double tau) const override {
    const double sigma = time().Of(tau);
    return time().Jet(shift().Zmp(sigma), sigma);
  }
  ProfileJet ByShape(double HalfStepShape::*number, double tau) const override {
    const double sigma = time().Of(tau);
    if (number == &HalfStepShape::shift) return time().Slope(shift().ZmpByShift(sigma), 1.0);
    if (number != &HalfStepShape::bump_ramp) return {};
    return time().Slope(shift().ZmpByBumpRamp(sigma), 1.0);
  }
  ProfileAccuracy Accuracy(double off) const override {
    return time().Accuracy(shift().ZmpAccuracy(), off);
  }
  double SecondBound(double from, double to) const override {
    return time().Second(shift().ZmpSecondBound(time().Of(from), time().Of(to)));
  }
  Range ThirdRange(double, double) const override {
    HALFSTEP_CHECK(false, "the third derivative of the ZMP has no bound");
  }
};

}  // namespace

// Half-steps of a walk mostly share θ and shape, and to solve for their motion takes longer than
// all else that is made of them. What was solved last is the same again, to the bit.
std::shared_ptr<const RestToRest> Lipm::Solved(double theta, double shift, double bump_ramp) const {
  const std::lock_guard lock(mutex_);
  const std::array wanted = {theta, shift, bump_ramp};
  if (!last_ || last_of_ != wanted) {
    last_ = std::make_shared<const RestToRest>(theta, shift, bump_ramp);
    last_of_ = wanted;
  }
  return last_;
}

MotionModel::Proposal Lipm::Propose(HalfStepKind, const HalfStepShape& shape,
                                    double duration) const {
  const UnitTime time{.duration = duration, .omega = omega()};
  const auto shift = Solved(time.omega * duration, shape.shift, shape.bump_ramp);
  return {.com = std::make_shared<LipmCom>(shift, shape, time),
          .zmp = std::make_shared<LipmZmp>(shift, shape, time)};
}

Eigen::Vector2d Lipm::ComAcceleration(const WalkJet& jet) const {
  return omega() * omega() * (jet.value.segment<2>(kComX) - jet.value.segment<2>(kZmpX));
}

Eigen::Vector2d Lipm::ComJerk(const WalkJet& jet) const {
  return omega() * omega() * (jet.first.segment<2>(kComX) - jet.first.segment<2>(kZmpX));
}

std::vector<std::pair<std::string_view, double>> Lipm::numbers() const {
  return {{"lipm_com_height", com_height_}, {"lipm_omega", omega()}};
}

}  // namespace halfstep
