#include "smoothing/methods/lipm_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "smoothing/walk/superposed_walk.h"
#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/files/plain_locale.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/lipm.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector2d;

constexpr int kDirections = 72;  // in which the CoM's condition is looked at; any few are sound

// A step: the soles that stand before and after, and the shortest time that its foot is in the air.
struct Flight {
  Pose2 from, to, stance;
  double least = 0.0;  // [s]
};

// limit − demanded, or +∞ where nothing is demanded or there is no limit.
double Allowed(const std::optional<double>& limit, double demanded) {
  if (!limit || demanded == kNotDemanded) return kUnlimited;
  return *limit - demanded;
}

// The time that a way takes; +∞ where none of it can be gone.
double AtLeast(double way, double speed) {
  if (way <= 0.0) return 0.0;
  return speed > 0.0 ? way / speed : kUnlimited;
}

std::vector<Flight> Flights(const WalkProblem& problem) {
  const MarginLimits& limits = problem.limits();
  const double speed = Allowed(limits.foot_speed, limits.demanded_of(MarginFamily::kFootSpeed));
  const double rate = Allowed(limits.foot_yaw_rate, limits.demanded_of(MarginFamily::kFootYawRate));
  const double lift = std::max(0.0, limits.demanded_of(MarginFamily::kFloor));
  const std::array<Foothold, 2>& start = problem.sequence().start;
  std::array<Pose2, 2> soles = {start[0].Planar(), start[1].Planar()};
  std::vector<Flight> flights;
  for (int step = 0; step < problem.sequence().num_steps(); ++step) {
    const PlacedHalfStep& down = Nth(problem.sequence().half_steps, 2 * step + 1);
    const Side swing = down.half_step.swing();
    Flight flight{.from = Nth(soles, Index(swing)),
                  .to = (down.X_WS * down.half_step.X_SF).Planar(),
                  .stance = down.X_WS.Planar()};
    const double way = Hypot(flight.to.x - flight.from.x, flight.to.y - flight.from.y);
    const double path = way > 0.0 ? way + 2.0 * lift : 0.0;
    const double turn = std::abs(flight.to.yaw - flight.from.yaw);
    flight.least = std::max(AtLeast(path, speed), AtLeast(turn, rate));
    Nth(soles, Index(swing)) = flight.to;
    flights.push_back(flight);
  }
  return flights;
}

// How far a sole reaches along u, less what the ZMP has to stay inside of its edges at least. Along
// a direction between two edges' normals the polygon that is left reaches less; more is sound.
double Reach(const Pose2& sole, const Vector2d& size, double inside, const Vector2d& u) {
  const Vector2d left = (size.array() - 2.0 * inside).max(0.0);
  return (u.transpose() * SoleCorners(sole, left)).maxCoeff();
}

// The least time that both soles of `both` stand before the CoM, at rest at x, may be left to the
// sole `flight.stance` alone for flight.least, whatever comes afterwards on `all` soles.
double LeastShift(const Vector2d& x, const std::array<Pose2, 2>& both, const Flight& flight,
                  const std::vector<Pose2>& all, const WalkProblem& problem, double omega) {
  const double demanded = problem.limits().demanded_of(MarginFamily::kZmp);
  const double inside = demanded == kNotDemanded ? 0.0 : demanded;
  const Vector2d& size = problem.robot().sole_size;
  double least = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections;
    const Vector2d u(Cos(angle), Sin(angle));
    const double one = Reach(flight.stance, size, inside, u);
    // The hull of both soles is shrunk as a whole, by less along some directions: not at all here.
    const double two = std::max(Reach(both[0], size, 0.0, u), Reach(both[1], size, 0.0, u));
    double later = two;
    for (const Pose2& sole : all) later = std::max(later, Reach(sole, size, 0.0, u));
    const double need = u.dot(x);
    const double lost = two - one - (later - one) * Exp(-omega * flight.least);
    if (!(two > need) || lost <= two - need) continue;
    least = std::max(least, Log(lost / (two - need)) / omega);
  }
  return least;
}

}  // namespace

LipmBound LowerBound(const WalkProblem& problem) {
  const std::vector<Flight> flights = Flights(problem);
  const HalfStepSequence& sequence = problem.sequence();
  const auto* lipm = dynamic_cast<const Lipm*>(sequence.model.get());
  HALFSTEP_CHECK(lipm != nullptr, "the bound is one of a LIPM");
  const double omega = lipm->omega();
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const auto com = [&walk](double t) -> Vector2d {
    return walk.At(walk.Locate(t)).value.segment<2>(kComX);
  };
  const std::array<Pose2, 2> start = {sequence.start[0].Planar(), sequence.start[1].Planar()};
  std::vector<Pose2> all(start.begin(), start.end());
  LipmBound bound;
  for (const Flight& flight : flights) {
    all.push_back(flight.to);
    bound.feet += flight.least;
  }
  const Flight& last = flights.back();
  bound.first = LeastShift(com(0.0), start, flights.front(), all, problem, omega);
  bound.last = LeastShift(com(walk.duration()), {last.stance, last.to}, last, all, problem, omega);
  return bound;
}

SmoothingResult TellLipmBound(const WalkProblem& problem, SmoothingMonitor& monitor) {
  if (!monitor.BeginFeasibly(problem, problem.Start())) return monitor.Refusal();
  if (dynamic_cast<const Lipm*>(problem.sequence().model.get()) == nullptr) {
    return monitor.Finish(opt::Ending::kNotRun, "the half-steps' model is no LIPM");
  }
  const LipmBound bound = LowerBound(problem);
  monitor.result().lower_bound = bound.total();
  PlainStream message;
  message << "no walk of a LIPM on these footsteps is shorter than " << bound.total()
          << " s: feet in the air " << bound.feet << " s, the CoM set off and stopped "
          << bound.first << " and " << bound.last << " s; the walk is what it started from";
  return monitor.Finish(opt::Ending::kNoImprovement, message.str());
}

}  // namespace halfstep
