#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

#include "tests/places.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/robot/leg_ik.h"

namespace halfstep {
namespace {

// Random postures of a robot's right leg within its limits, and where its sole is in them.
struct Postures {
  explicit Postures(const std::string& robot = "hrp2") : leg(ShippedRobot(robot).legs[1]) {
    std::mt19937 random(1);
    for (int k = 0; k < 1024; ++k) {
      Vector6d posture;
      for (size_t i = 0; i < 6; ++i) {
        posture[static_cast<Eigen::Index>(i)] =
            std::uniform_real_distribution<>(leg.joints[i].lower, leg.joints[i].upper)(random);
      }
      q.push_back(posture);
      X_BSole.push_back(LegForwardKinematics(leg, posture)[6]);
    }
  }
  Leg leg;
  std::vector<Vector6d> q;
  std::vector<Eigen::Isometry3d> X_BSole;
};

// Calls `ask` with one posture's index after the other.
template <typename Ask>
void AskOfEach(benchmark::State& state, const Ask& ask) {
  size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ask(k++ % 1024));
}

void BM_SolveLegIk(benchmark::State& state, const std::string& robot) {
  const Postures p(robot);
  AskOfEach(state, [&](size_t k) { return SolveLegIk(p.leg, p.X_BSole[k]); });
}
BENCHMARK_CAPTURE(BM_SolveLegIk, hrp2, "hrp2");
BENCHMARK_CAPTURE(BM_SolveLegIk, wren, "wren");
BENCHMARK_CAPTURE(BM_SolveLegIk, bison, "bison");

// The same pose after pose about where the sole stands: legs with offset axes, and HRP-2's.
void BM_SolveLegIkWalking(benchmark::State& state) {
  const std::vector<GeneratedRobot> offset = OffsetRobots();
  const size_t which = static_cast<size_t>(state.range(0));
  const Leg leg = which < offset.size() ? TemporaryRobot(offset[which]).Load().legs[0]
                                        : LoadRobot(InSources("wpg/robots/hrp2.yaml")).legs[0];
  state.SetLabel(which < offset.size() ? offset[which].name : "hrp2");
  std::mt19937 random(1);
  std::uniform_real_distribution<> unit(-1, 1);
  std::vector<Eigen::Isometry3d> X_BSole(1024, LegForwardKinematics(leg, leg.standing_q)[6]);
  for (Eigen::Isometry3d& X : X_BSole) {
    X.translation() +=
        Eigen::Vector3d(0.2 * unit(random), 0.1 * unit(random), 0.1 + 0.09 * unit(random));
    X.rotate(Eigen::AngleAxisd(0.3 * unit(random), Eigen::Vector3d::UnitZ()));
  }
  AskOfEach(state, [&](size_t k) { return SolveLegIk(leg, X_BSole[k]); });
}
BENCHMARK(BM_SolveLegIkWalking)->DenseRange(0, 3);

void BM_SolveLegIkAll(benchmark::State& state) {
  const Postures p;
  AskOfEach(state, [&](size_t k) { return SolveLegIkAll(p.leg, p.X_BSole[k]); });
}
BENCHMARK(BM_SolveLegIkAll);

void BM_LegForwardKinematics(benchmark::State& state) {
  const Postures p;
  AskOfEach(state, [&](size_t k) { return LegForwardKinematics(p.leg, p.q[k]); });
}
BENCHMARK(BM_LegForwardKinematics);

void BM_LegJacobian(benchmark::State& state) {
  const Postures p;
  AskOfEach(state, [&](size_t k) { return LegJacobian(p.leg, p.q[k]); });
}
BENCHMARK(BM_LegJacobian);

void BM_LegIkDerivative(benchmark::State& state) {
  const Postures p;
  const Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, 8> dq = Eigen::Matrix<double, 6, 8>::Zero();
  AskOfEach(state, [&](size_t k) {
    benchmark::DoNotOptimize(LegIkDerivative(p.leg, p.q[k], X_WB, p.X_BSole[k], &dq));
    return dq;
  });
}
BENCHMARK(BM_LegIkDerivative);

}  // namespace
}  // namespace halfstep
