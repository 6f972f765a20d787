// How often bounds of joint torques and of needed friction over an interval are exceeded, and how
// tight they are. Prints the table of notebooks-data/measurements.md, "Torques and friction". Not a
// test.
// Run: torque_drift_study [INTERVALS [SEED [ROBOT]]]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "smoothing/proof/interval_statements.h"
#include "tests/smoothing/certificate_draws.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/motion/torque_drift.h"

namespace halfstep {
namespace {

constexpr double kGravity = 9.81;
constexpr int kInstants = 8;  // of an interval, beside its begin

// What the feet and joints carry at an instant; none where nothing can be said.
struct CarriedThen {
  RobotDynamics dynamics;
  FootLoads loads;
  std::array<Vector6d, 2> torques;

  static std::optional<CarriedThen> Of(const RobotModel& robot, const WalkJet& jet,
                                       std::optional<Side> support) {
    Posture posture = SolvePosture(robot, jet.value);
    if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) return std::nullopt;
    const RobotDynamics dynamics(robot, jet, posture, kGravity);
    const auto zmp = dynamics.Zmp();
    if (!zmp) return std::nullopt;
    const FootLoads loads =
        support ? FootLoads::OneFoot(*support)
                : FootLoads::BothFeet(FootPose(jet.value, Side::kLeft),
                                      FootPose(jet.value, Side::kRight), robot.sole_size, *zmp);
    CarriedThen carried{dynamics, loads, {}};
    for (const Side side : {Side::kLeft, Side::kRight}) {
      carried.torques[static_cast<size_t>(Index(side))] =
          LegTorques(dynamics, side, loads.On(side, dynamics.contact()));
    }
    return carried;
  }
};

struct Ratios {
  std::vector<double> all;
  long exceeded = 0;

  // `most`: the largest change seen; below `still` nothing is said of tightness.
  void Add(double bound, double most, double still, double rounding) {
    exceeded += !(most <= bound + rounding);
    if (most > still) all.push_back(bound / most);
  }
  void Print(const char* what) {
    std::sort(all.begin(), all.end());
    const auto at = [&](double share) {
      return all.empty() ? 0.0
                         : all[static_cast<size_t>(share * static_cast<double>(all.size() - 1))];
    };
    std::printf("  %-20s exceeded %ld; least %.2f, median %.2f, 90 %% %.2f, 99 %% %.2f of %zu\n",
                what, exceeded, at(0), at(0.5), at(0.9), at(0.99), all.size());
  }
};

void Draw(long intervals, unsigned seed, const std::string& name) {
  const RobotModel robot = RobotNamed(name);
  const MotionBounds bounds(robot);
  WalkDraw draw(seed);
  for (const double length : {0.001, 0.003, 0.01, 0.03}) {
    std::array<Ratios, 2> torque, friction, by_rates;  // one foot stands, both do
    long drawn = 0, bounded = 0;
    while (drawn < intervals) {
      const HalfStepSequence sequence = DrawSequence(robot, 2, {.stride = 0.7}, &draw);
      const SuperposedWalk walk(sequence, draw.Parameters(sequence, 0.0, 0.8));
      for (int k = 0; k < 50 && drawn < intervals; ++k) {
        const double begin = draw.Uniform(0.0, walk.duration() - length), end = begin + length;
        const LocalTime middle = walk.Locate(begin + 0.5 * length);
        const int step = walk.StepInAir(middle);
        // The support does not change in an interval of a proof.
        if (walk.StepInAir(walk.Locate(begin)) != step ||
            walk.StepInAir(walk.Locate(end)) != step) {
          continue;
        }
        ++drawn;
        std::optional<Side> support;
        if (step >= 0) support.emplace(walk.half_step(2 * step).support);
        IntervalMotion motion;
        BoundMotion(bounds, walk, begin, end, &motion);
        if (!motion.bounded) continue;
        const auto at = CarriedThen::Of(robot, motion.jet, support);
        if (!at) continue;
        const WalkThirds thirds = walk.ThirdRanges(begin, end);
        const RobotDrift drift(robot, motion, thirds, at->dynamics, kGravity);
        const ZmpDrift zmp = ZmpDrift::Over(robot, motion, thirds, drift, at->dynamics, kGravity);
        if (!(zmp.least_push > 0)) continue;
        ++bounded;
        const TorqueDrift torque_drift(motion, drift, at->dynamics, at->loads,
                                       support ? 0.0 : zmp.Most(), kGravity);
        const SupportPolygon polygon = SupportAt(walk, middle, motion.jet.value, robot.sole_size);
        const auto needed = FootFriction::Of(at->dynamics, polygon);
        const double friction_bound = needed ? needed->Drift(drift, zmp) : INFINITY;
        const auto rate = ContactRate::Over(robot, motion, thirds, drift, at->dynamics, kGravity);
        const double bound_by_rates = needed && rate ? needed->Drift(*rate) : INFINITY;
        const bool said = std::isfinite(std::min(friction_bound, bound_by_rates));
        std::array<Vector6d, 2> most = {Vector6d::Zero(), Vector6d::Zero()};
        double grown = 0;
        for (int i = 0; i <= kInstants; ++i) {
          const auto there =
              CarriedThen::Of(robot, walk.At(begin + length * i / kInstants), support);
          if (!there) std::abort();  // the bounds say that there is
          for (size_t s = 0; s < 2; ++s) {
            most[s] = most[s].cwiseMax((there->torques[s] - at->torques[s]).cwiseAbs());
          }
          if (!said) continue;
          const auto then = FootFriction::Of(there->dynamics, polygon);
          grown = std::max(grown, then ? then->needed() - needed->needed() : INFINITY);
        }
        const size_t which = support ? 0 : 1;
        for (const Side side : {Side::kLeft, Side::kRight}) {
          const Vector6d of = torque_drift.Of(side);
          for (Eigen::Index j = 0; j < 6; ++j) {
            torque[which].Add(of[j], most[static_cast<size_t>(Index(side))][j], 1e-3, 1e-6);
          }
        }
        friction[which].Add(friction_bound, grown, 1e-5, 1e-9);
        by_rates[which].Add(bound_by_rates, grown, 1e-5, 1e-9);
      }
    }
    std::printf("%s, %.0f ms: %ld intervals, bounded %ld; bound over largest of %d changes\n",
                name.c_str(), 1e3 * length, drawn, bounded, kInstants + 1);
    torque[0].Print("torque, one foot");
    torque[1].Print("torque, both feet");
    friction[0].Print("friction, one foot");
    friction[1].Print("friction, both feet");
    by_rates[0].Print("the same by rates");
    by_rates[1].Print("the same by rates");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) {
  halfstep::Draw(argc > 1 ? std::atol(argv[1]) : 250000,
                 argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1,
                 argc > 3 ? argv[3] : "hrp2");
}
