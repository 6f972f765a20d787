#include "experiments/checker/check_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "experiments/checker/standing_soles.h"
#include "experiments/checker/tube_loss.h"
#include "experiments/checker/walk_statements.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

using Kind = TrajectoryFinding::Kind;

// An interval is not halved below this [s], nor where its bound is as near to its value.
constexpr double kFinest = 1e-6, kMissed = 1e-9;
constexpr std::int64_t kMostIntervals = 2'000'000;  // intervals
constexpr double kRoundedShift = 1e-12;             // how much shorter a shift may be [s]

// Proves statements on the whole walk, all of those that are open on one interval at once.
class WalkProof {
 public:
  WalkProof(const RobotModel& robot, const WalkMotion& motion, double crouch,
            WalkStatements* statements, ProofHints* hints, TrajectoryCheck* check)
      : robot_(robot),
        motion_(motion),
        height_(Interval(robot.waist_height) - Interval(crouch)),
        statements_(*statements),
        hints_(*hints),
        check_(*check),
        solvers_{LegSolver(robot.legs[0]), LegSolver(robot.legs[1])} {
    for (const WalkStatement& statement : statements_.all()) {
      findings_.push_back({.kind = KindOf(statement.family),
                           .subject = statement.subject,
                           .proved = true,
                           .demanded = statement.demanded,
                           .least = kInfinity});
      directions_.push_back(&hints->directions[{statement.family, statement.a, statement.b}]);
    }
    for (WalkStatement& statement : statements_.all()) statement.told = hints->told;
  }

  // Of all instants between neighbours of these [s] can be asked then.
  void Follow(const std::vector<double>& knots) {
    FollowLegs(robot_, motion_, height_, knots, &solvers_);
  }
  void Prove(double from, double to) {
    std::vector<size_t> open(findings_.size());
    for (size_t i = 0; i < open.size(); ++i) open[i] = i;
    Look(from, to, std::move(open));
  }
  void Finish() {
    check_.findings.insert(check_.findings.end(), findings_.begin(), findings_.end());
  }

 private:
  void Look(double from, double to, std::vector<size_t> open) {
    ++check_.intervals;
    WalkState state(robot_, solvers_, motion_, height_, from, to);
    std::erase_if(open, [&](size_t i) { return IsSettled(i, from, to, &state); });
    if (open.empty()) {
      if (!hints_.told) hints_.times.push_back(to);
      return;
    }
    const double middle = state.middle();
    Look(from, middle, open);
    Look(middle, to, std::move(open));
  }

  // Whether nothing more is asked of a statement on an interval.
  bool IsSettled(size_t i, double from, double to, WalkState* state) {
    TrajectoryFinding& finding = findings_[i];
    if (!finding.proved) return true;
    Kept kept{-kInfinity, std::numeric_limits<double>::quiet_NaN()};
    WalkStatement& statement = statements_.all()[i];
    if (hints_.told) statement.direction = ProofHints::At(*directions_[i], state->middle());
    try {
      kept = statements_.Look(&statement, state);
    } catch (const NotDefined&) {
    }
    if (kept.bound >= finding.demanded) {
      if (!hints_.told) ProofHints::Note(from, statement.direction, directions_[i]);
      if (kept.bound < finding.least) {
        finding.least = kept.bound;
        finding.at = state->middle();
      }
      return true;
    }
    finding.proved = !(kept.value < finding.demanded - kMissed || to - from < kFinest ||
                       kept.value - kept.bound < kMissed || check_.intervals > kMostIntervals);
    if (finding.proved) return false;
    finding.least = kept.value;
    finding.at = state->middle();
    finding.hint_missing = kept.hint_missing;
    return true;
  }

  const RobotModel& robot_;
  const WalkMotion& motion_;
  Interval height_;
  WalkStatements& statements_;
  ProofHints& hints_;
  TrajectoryCheck& check_;
  std::array<LegSolver, 2> solvers_;
  std::vector<TrajectoryFinding> findings_;
  std::vector<ProofHints::Directions*> directions_;
};

// What is known without looking at intervals: at most one foot is in the air, and how long ZMPs
// go from foot to foot, of the half-steps that are known.
void AddTimes(const WalkMotion& motion, double demanded, TrajectoryCheck* check) {
  const std::vector<WalkMotion::Flight>& flights = motion.flights();
  for (size_t j = 0; j + 1 < flights.size(); ++j) {
    const double apart = checker::Below(flights[j + 1].begin - flights[j].end);
    const size_t step = motion.first() / 2 + j;
    check->findings.push_back({.kind = Kind::kContact,
                               .subject = Formatted("steps %zu and %zu", step + 1, step + 2),
                               .proved = apart > 0.0,
                               .least = apart,
                               .at = flights[j].end});
  }
  if (demanded == verify::kNotDemanded) return;
  for (size_t i = motion.first(); i < motion.size(); ++i) {
    const auto [start, shift] = motion.StartAndShift(i);
    check->findings.push_back({.kind = Kind::kDoubleSupport,
                               .subject = Formatted("half-step %zu", i + 1),
                               .proved = shift.lo >= demanded - kRoundedShift,
                               .demanded = demanded,
                               .least = shift.lo,
                               .at = start.lo});
  }
}

}  // namespace

Kind KindOf(verify::Family family) {
  constexpr Kind kKinds[] = {Kind::kFloor,         Kind::kFootSpeed,     Kind::kFootYawRate,
                             Kind::kZmp,           Kind::kReach,         Kind::kLimits,
                             Kind::kSpeed,         Kind::kSelfClearance, Kind::kClearance,
                             Kind::kGround,        Kind::kNoStep,        Kind::kZmpRobot,
                             Kind::kTorque,        Kind::kFriction,      Kind::kAcceleration,
                             Kind::kDoubleSupport, Kind::kLandingSpeed,  Kind::kFoothold};
  return kKinds[family];
}

TrajectoryCheck CheckWalk(const WalkMotion& motion, const RobotModel& robot, const Scene& scene,
                          const verify::CertificateText& certificate, double crouch,
                          const std::function<bool(double done)>& progress, ProofHints* hints,
                          double from, double to) {
  std::optional<TubeLoss> tube;
  if (certificate.tube) tube.emplace(*certificate.tube, robot);
  if (tube && !scene.ground->Solids().empty()) {
    throw InputError({"the certificate is of a tube over solid ground, of which there is none"});
  }
  verify::CertificateText asked = certificate;
  for (size_t f = 0; tube && f < verify::kNumFamilies; ++f) {
    asked.demanded[f] = tube->Demanded(static_cast<verify::Family>(f), asked.demanded[f]);
  }
  TrajectoryCheck check;
  ProofHints found;
  if (hints == nullptr) hints = &found;
  WalkStatements statements(robot, scene, asked);
  for (WalkStatement& of : statements.all()) {
    if (tube) of.demanded = tube->Demanded(of);
  }
  const auto demanded = [&](verify::Family family) { return Nth(asked.demanded, family); };
  AddTimes(motion, demanded(verify::kDoubleSupport), &check);
  AddStandingSoles(motion, robot, scene, asked, from, hints, &check);
  WalkProof proof(robot, motion, crouch, &statements, hints, &check);
  std::vector<double> knots = motion.knots(), waypoints = statements.WaypointTimes();
  waypoints.push_back(from);
  waypoints.push_back(to);
  for (const double t : waypoints) {
    if (t > 0.0 && t < motion.end()) knots.push_back(t);
  }
  std::ranges::sort(knots);
  proof.Follow(knots);
  std::erase_if(knots, [&](double t) { return t < from || t > to; });
  if (!hints->told && !knots.empty()) hints->times.push_back(knots.front());
  for (size_t i = 0; i + 1 < knots.size() && !check.stopped; ++i) {
    proof.Prove(knots[i], knots[i + 1]);
    check.stopped = progress && !progress(knots[i + 1] / motion.end());
  }
  proof.Finish();
  hints->in_parts = std::ranges::any_of(statements.all(), &WalkStatement::in_parts);
  for (size_t f = 0; f < verify::kNumFamilies; ++f) {
    const auto family = static_cast<verify::Family>(f);
    const bool known = family != verify::kOwn;
    if (demanded(family) == verify::kNotDemanded ||
        (known && std::ranges::count(check.findings, KindOf(family), &TrajectoryFinding::kind))) {
      continue;
    }
    check.not_covered.push_back(
        std::string(verify::kFamilyNames[f]) +
        (known ? ": does not apply here" : ": is demanded, and not examined here"));
  }
  check.Sort();
  return check;
}

}  // namespace halfstep::checker
