#include "wpg/elementary.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "wpg/geometry/rotation.h"

namespace halfstep {
namespace {

// Numbers of [lower, upper], the same in every C++ library.
std::vector<double> Drawn(double lower, double upper) {
  std::mt19937_64 random(17);
  std::vector<double> all(5000);
  for (double& x : all) x = lower + (upper - lower) * 0x1p-64 * static_cast<double>(random());
  return all;
}

struct Function {
  const char* name;
  std::function<double(double)> ours;
  std::function<long double(long double)> exact;
  double lower, upper;
  std::uint64_t bits;  // a hash (FNV-1a, by words) of the results
};

const std::vector<Function>& Functions() {
  static const std::vector<Function> all = {
      {"sin", Sin, [](long double x) { return std::sin(x); }, -7, 7, 0xb1acbf0a593a2c18},
      {"cos", Cos, [](long double x) { return std::cos(x); }, -7, 7, 0x25e5dbcc43cd9a39},
      {"asin", Asin, [](long double x) { return std::asin(x); }, -1, 1, 0xdefa2edbece2b30b},
      {"acos", Acos, [](long double x) { return std::acos(x); }, -1, 1, 0x26e64b3037f375fc},
      {"atan2", [](double x) { return Atan2(x, -0.7); },
       [](long double x) { return std::atan2(x, -static_cast<long double>(0.7)); }, -7, 7,
       0x08306e8b90bb2be5},
      {"exp", Exp, [](long double x) { return std::exp(x); }, -60, 3, 0x619a3ac1fbacb619},
      {"log", Log, [](long double x) { return std::log(x); }, 1e-9, 100, 0xce0c27da7c09d72e},
      {"log10", Log10, [](long double x) { return std::log10(x); }, 1e-9, 100, 0x482495665654379c},
      {"pow", [](double x) { return Pow(50, x); },
       [](long double x) { return std::pow(static_cast<long double>(50), x); }, -1, 2,
       0x9d0c1d69ea5b1df1},
  };
  return all;
}

TEST(Elementary, FunctionsAreOffByLessThanAUnitInTheLastPlace) {
  for (const Function& f : Functions()) {
    for (const double x : Drawn(f.lower, f.upper)) {
      const long double exact = f.exact(x);
      const double nearest = std::abs(static_cast<double>(exact));
      const double unit = std::nextafter(nearest, 1e300) - nearest;
      EXPECT_LE(std::abs(static_cast<long double>(f.ours(x)) - exact), unit) << f.name << ' ' << x;
    }
  }
}

// Another library of them, or one that looks at the CPU, shows here before it shows in files.
TEST(Elementary, ResultsHaveTheBitsThatTheyHaveOnEveryMachine) {
  for (const Function& f : Functions()) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const double x : Drawn(f.lower, f.upper)) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(f.ours(x))) * 0x100000001b3;
    }
    EXPECT_EQ(hash, f.bits) << f.name << std::hex << " 0x" << hash;
  }
}

TEST(Elementary, SymmetriesAndPlainValuesAreExact) {
  constexpr double kPi = std::numbers::pi;
  for (const double x : Drawn(-20, 20)) {
    EXPECT_EQ(Sin(-x), -Sin(x));
    EXPECT_EQ(Cos(-x), Cos(x));
    EXPECT_EQ(Atan2(-x, 3.0), -Atan2(x, 3.0));
  }
  for (int quarter = -1000; quarter <= 1000; ++quarter) {
    for (const double x : Drawn(-1e-7, 1e-7)) {
      const SineCosine both = SinCos(quarter * kPi / 2 + x);
      ASSERT_LE(std::max(std::abs(both.sin), std::abs(both.cos)), 1.0) << quarter << ' ' << x;
    }
  }
  EXPECT_EQ(Sin(0.0), 0.0);
  EXPECT_EQ(Cos(0.0), 1.0);
  EXPECT_EQ(Acos(1.0), 0.0);
  EXPECT_EQ(Acos(-1.0), kPi);
  EXPECT_EQ(Atan2(0.0, -1.0), kPi);
  EXPECT_EQ(Atan2(-0.0, -1.0), -kPi);
  EXPECT_EQ(Atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(Atan2(1.0, 0.0), kPi / 2);
  EXPECT_EQ(Exp(0.0), 1.0);
  EXPECT_EQ(Exp(-1e9), 0.0);
  EXPECT_EQ(Log(1.0), 0.0);
  EXPECT_EQ(Log(0.0), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(Acos(1.1)) && std::isnan(Log(-1.0)) && std::isnan(Sin(NAN)));
}

TEST(Rotation, IsThatOfEigen) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-4, 4);
  for (int i = 0; i < 1000; ++i) {
    const double roll = angle(random), pitch = angle(random), yaw = angle(random);
    const Eigen::Vector3d axis = Eigen::Vector3d(roll, pitch, yaw).normalized();
    const Eigen::Matrix3d R = Eigen::AngleAxisd(roll, axis).toRotationMatrix();
    EXPECT_LT((AxisRotation(roll, axis) - R).norm(), 1e-15);
    EXPECT_NEAR(AngleOf(R), std::abs(std::remainder(roll, 2 * std::numbers::pi)), 1e-14);
    const Eigen::Matrix3d turned = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
    EXPECT_LT((RollPitchYaw(roll, pitch, yaw) - turned).norm(), 3e-15);
    EXPECT_LT((PlaneRotation(yaw) - Eigen::Rotation2Dd(yaw).toRotationMatrix()).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace halfstep
