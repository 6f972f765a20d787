#include "experiments/run/margin_words.h"

#include <cmath>

#include "wpg/files/text.h"

namespace halfstep {
namespace {

// "RLEG_LINK5" and "bar" of "RLEG_LINK5 - bar".
struct Pair {
  std::string first, second;
};

Pair PairOf(const std::string& subject) {
  const size_t dash = subject.find(" - ");
  if (dash == std::string::npos) return {subject, "something"};
  return {subject.substr(0, dash), subject.substr(dash + 3)};
}

// What the value says of distances, else of a limit.
std::string ValueWords(const Margin& margin, const std::string& subject) {
  const std::string unit(Unit(margin.family));
  const std::string amount = Amount(std::abs(margin.value), unit);
  const bool missed = margin.value < 0.0;
  switch (margin.family) {
    case MarginFamily::kClearance:
    case MarginFamily::kSelfClearance: {
      const Pair pair = PairOf(subject);
      return pair.first + " is " + amount + (missed ? " inside " : " from ") + pair.second;
    }
    case MarginFamily::kGround:
      return subject + " is " + amount + (missed ? " below" : " above") + " the floor";
    case MarginFamily::kReach:
      return "the " + subject + " is " + amount + (missed ? " too short" : " from stretched");
    case MarginFamily::kFloor:
      return "the " + subject + " is only " + amount + " high while it moves";
    case MarginFamily::kZmp:
    case MarginFamily::kZmpRobot:
      return (margin.family == MarginFamily::kZmp ? "the ZMP is " : "the robot's ZMP is ") +
             amount + (missed ? " outside" : " inside") + " the support polygon";
    case MarginFamily::kFriction:
      return "what the " + subject + (missed ? " needs is " : " needs leaves ") + amount +
             (missed ? " above the floor's friction" : " of the floor's friction");
    case MarginFamily::kFootSpeed:
    case MarginFamily::kFootYawRate:
    case MarginFamily::kJoint:
    case MarginFamily::kJointSpeed:
    case MarginFamily::kNoStep:
    case MarginFamily::kTorque:
    case MarginFamily::kJointAcceleration:
    case MarginFamily::kOwn:
      break;
  }
  return std::string(Name(margin.family)) + " of " + subject + ": " + amount +
         (missed ? " beyond its limit" : " inside its limit");
}

}  // namespace

std::string Amount(double value, std::string_view unit) {
  if (unit == "m" && std::abs(value) < 0.1) {
    const double millimetres = 1e3 * value;
    return Formatted(std::abs(millimetres) < 0.1 && value != 0.0 ? "%.3f mm" : "%.1f mm",
                     millimetres);
  }
  const std::string number = Formatted("%.3g", value);
  return unit == "1" ? number : number + " " + std::string(unit);
}

std::string MissedWords(const MarginEvaluator& evaluator, const Margin& margin) {
  const std::string subject = evaluator.Subject(margin);
  const std::string of = std::string(Name(margin.family)) + " of " + subject;
  if (std::isnan(margin.value)) return of + " could not be decided";
  if (std::isinf(margin.value)) {
    return of + (margin.family == MarginFamily::kFriction
                     ? " cannot be enough: the robot's ZMP is not inside the soles"
                     : " cannot be told: a leg does not reach");
  }
  std::string words = ValueWords(margin, subject);
  const double demanded = evaluator.limits().demanded_of(margin.family);
  if (demanded != 0.0) {
    words += "; " + Amount(demanded, Unit(margin.family)) + " demanded";
  }
  if (margin.stop_after >= 0) {
    words += Formatted(", if the walk is stopped after half-step %d", margin.stop_after + 1);
  }
  return words;
}

}  // namespace halfstep
