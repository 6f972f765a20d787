#include "wpg/motion/swing_profiles.h"

#include "wpg/check.h"
#include "wpg/motion/unit_time.h"

namespace halfstep {
namespace {

// A form of σ alone, a Smoothstep or a RampedStep.
template <typename Form>
class FormProfile : public Profile {
 public:
  FormProfile(const Form& form, double duration) : form_(form), time_{.duration = duration} {}

  ProfileJet At(double tau) const override {
    const double sigma = time_.Of(tau);
    return time_.Jet(form_.At(sigma), sigma);
  }
  ProfileJet ByShape(double HalfStepShape::*, double) const override { return {}; }
  ProfileAccuracy Accuracy(double time) const override {
    return time_.Accuracy(form_.Accuracy(), time);
  }
  double SecondBound(double from, double to) const override {
    return time_.Second(form_.SecondBound(time_.Of(from), time_.Of(to)));
  }
  Range ThirdRange(double from, double to) const override {
    return time_.Third(form_.ThirdRange(time_.Of(from), time_.Of(to)));
  }
  void AddKnots(std::vector<double>* knots) const override {
    knots->insert(knots->end(), {form_.begin * time_.duration, form_.end * time_.duration});
  }

 protected:
  const Form& form() const { return form_; }
  const UnitTime& time() const { return time_; }

 private:
  Form form_;
  UnitTime time_;
};

class Foot final : public FormProfile<RampedStep> {
 public:
  Foot(HalfStepKind kind, const RampedStep& window, double duration)
      : FormProfile(window, duration), up_(kind == HalfStepKind::kUp) {}

  ProfileJet ByShape(double HalfStepShape::*number, double tau) const override {
    const double sigma = time().Of(tau);
    if (number == &HalfStepShape::foot_ramp) return time().Slope(form().ByRamp(sigma), 1.0);
    // With the ZMP's shift the flight begins later, or ends earlier, by half of it.
    const double rate = number == &HalfStepShape::foot_delay ? 1.0
                        : number == &HalfStepShape::shift    ? 0.5
                                                             : 0.0;
    if (rate == 0.0) return {};
    return up_ ? time().Slope(form().ByBegin(sigma), rate)
               : time().Slope(form().ByEnd(sigma), -rate);
  }
  void AddKnots(std::vector<double>* knots) const override {
    FormProfile::AddKnots(knots);
    knots->push_back(form().steady_begin() * time().duration);
    knots->push_back(form().steady_end() * time().duration);
  }

 private:
  bool up_;
};

class Lift final : public FormProfile<Smoothstep> {
 public:
  Lift(HalfStepKind kind, const HalfStepShape& shape, double duration)
      : FormProfile(LiftWindow(kind, shape), duration),
        shape_(shape),
        up_(kind == HalfStepKind::kUp) {}

  ProfileJet ByShape(double HalfStepShape::*number, double tau) const override {
    const double sigma = time().Of(tau);
    if (number == &HalfStepShape::lift_share) {
      return up_ ? time().Slope(form().ByEnd(sigma), 1.0 - shape_.t2())
                 : time().Slope(form().ByBegin(sigma), -shape_.t1());
    }
    if (number != &HalfStepShape::shift) return {};
    // t1 and t2 move by ∓½, and with them the flight.
    const double far_end = 0.5 - 0.5 * shape_.lift_share;
    const ProfileJet low = time().Slope(form().ByBegin(sigma), up_ ? 0.5 : -far_end);
    const ProfileJet high = time().Slope(form().ByEnd(sigma), up_ ? far_end : -0.5);
    return {.value = low.value + high.value,
            .first = low.first + high.first,
            .second = low.second + high.second};
  }

 private:
  HalfStepShape shape_;
  bool up_;
};

class Rise final : public FormProfile<Smoothstep> {
 public:
  Rise(HalfStepKind kind, const HalfStepShape& shape, double duration)
      : FormProfile(RiseWindow(kind, shape), duration), up_(kind == HalfStepKind::kUp) {}

  ProfileJet ByShape(double HalfStepShape::*number, double tau) const override {
    const double sigma = time().Of(tau);
    if (number == &HalfStepShape::rise_begin) {
      return up_ ? time().Slope(form().ByBegin(sigma), 1.0)
                 : time().Slope(form().ByEnd(sigma), -1.0);
    }
    if (number != &HalfStepShape::rise_end) return {};
    return up_ ? time().Slope(form().ByEnd(sigma), 1.0) : time().Slope(form().ByBegin(sigma), -1.0);
  }

 private:
  bool up_;
};

class WaistYaw final : public FormProfile<Smoothstep> {
 public:
  explicit WaistYaw(double duration) : FormProfile({}, duration) {}
  void AddKnots(std::vector<double>* knots) const override { knots->push_back(time().duration); }
};

}  // namespace

RampedStep FootWindow(HalfStepKind kind, const HalfStepShape& shape) {
  return kind == HalfStepKind::kUp
             ? RampedStep{shape.t2() + shape.foot_delay, 1.0, shape.foot_ramp}
             : RampedStep{0.0, shape.t1() - shape.foot_delay, shape.foot_ramp};
}

Smoothstep LiftWindow(HalfStepKind kind, const HalfStepShape& shape) {
  return kind == HalfStepKind::kUp
             ? Smoothstep{shape.t2(), shape.t2() + shape.lift_share * (1.0 - shape.t2())}
             : Smoothstep{shape.t1() - shape.lift_share * shape.t1(), shape.t1()};
}

Smoothstep RiseWindow(HalfStepKind kind, const HalfStepShape& shape) {
  return kind == HalfStepKind::kUp ? Smoothstep{shape.rise_begin, shape.rise_end}
                                   : Smoothstep{1.0 - shape.rise_end, 1.0 - shape.rise_begin};
}

std::shared_ptr<const Profile> FootProfile(HalfStepKind kind, const HalfStepShape& shape,
                                           double duration) {
  // Of the flight, t1 long, a tenth at least must be left to move in.
  HALFSTEP_CHECK(
      shape.foot_delay >= 0.0 && shape.foot_delay <= 0.3 && shape.foot_delay <= 0.9 * shape.t1(),
      "foot_delay = " << shape.foot_delay << ", t1 = " << shape.t1());
  HALFSTEP_CHECK(shape.foot_ramp >= 0.1 && shape.foot_ramp <= 0.5,
                 "foot_ramp = " << shape.foot_ramp);
  return std::make_shared<Foot>(kind, FootWindow(kind, shape), duration);
}

std::shared_ptr<const Profile> LiftProfile(HalfStepKind kind, const HalfStepShape& shape,
                                           double duration) {
  HALFSTEP_CHECK(shape.lift_share >= 0.2 && shape.lift_share <= 1.0,
                 "lift_share = " << shape.lift_share);
  return std::make_shared<Lift>(kind, shape, duration);
}

std::shared_ptr<const Profile> RiseProfile(HalfStepKind kind, const HalfStepShape& shape,
                                           double duration) {
  HALFSTEP_CHECK(shape.rise_begin >= 0.0 && shape.rise_begin <= 0.75,
                 "rise_begin = " << shape.rise_begin);
  HALFSTEP_CHECK(shape.rise_end >= 0.85 && shape.rise_end <= 1.0, "rise_end = " << shape.rise_end);
  return std::make_shared<Rise>(kind, shape, duration);
}

std::shared_ptr<const Profile> WaistYawProfile(double duration) {
  return std::make_shared<WaistYaw>(duration);
}

}  // namespace halfstep
