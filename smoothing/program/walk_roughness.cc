#include "smoothing/program/walk_roughness.h"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace halfstep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Family = HomotopyParameter::Family;

// Nodes and weights of Gauss–Legendre quadrature on [−1, 1], the positive half.
constexpr std::array<std::pair<double, double>, 5> kGauss = {
    {{0.1488743389816312, 0.2955242247147529},
     {0.4333953941292472, 0.2692667193099963},
     {0.6794095682990244, 0.2190863625159821},
     {0.8650633666889845, 0.1494513491505806},
     {0.9739065285171717, 0.0666713443086881}}};

struct Integrand {
  Vector2d acceleration, jerk;
  Vector3d left, right;

  Integrand(const WalkJet& jet, const MotionModel& model)
      : acceleration(model.ComAcceleration(jet)),
        jerk(model.ComJerk(jet)),
        left(jet.first.segment<3>(FootIndex(Side::kLeft))),
        right(jet.first.segment<3>(FootIndex(Side::kRight))) {}

  // Half the derivative of the weighted integrand along d when d is the tangent of this.
  double Dot(const Integrand& d, const RoughnessWeights& w) const {
    return w.com_acceleration * acceleration.dot(d.acceleration) + w.com_jerk * jerk.dot(d.jerk) +
           w.foot_speed * (left.dot(d.left) + right.dot(d.right));
  }
};

// Local times at which some profile under way changes its formula, of half-step k's own stretch.
std::vector<double> KnotsOf(const SuperposedWalk& walk, int k, double stretch) {
  std::vector<double> knots = {0.0, stretch};
  for (int i = k; i >= std::max(0, k - 3); --i) {
    const double start = walk.start_of(i) - walk.start_of(k);
    for (const double tau : walk.tracks(i).Knots()) {
      if (start + tau > 0.0 && start + tau < stretch) knots.push_back(start + tau);
    }
  }
  std::sort(knots.begin(), knots.end());
  return knots;
}

// Calls visit(node, weight) for every node of every stretch.
void ForEachNode(const SuperposedWalk& walk,
                 const std::function<void(const LocalTime&, double)>& visit) {
  for (int k = 0; k < walk.num_half_steps(); ++k) {
    const bool last = k + 1 == walk.num_half_steps();
    const double end = last ? walk.duration() : walk.start_of(k + 1);
    const std::vector<double> knots = KnotsOf(walk, k, end - walk.start_of(k));
    for (size_t i = 0; i + 1 < knots.size(); ++i) {
      const double middle = 0.5 * (knots[i] + knots[i + 1]);
      const double half = 0.5 * (knots[i + 1] - knots[i]);
      if (!(half > 0.0)) continue;
      for (const auto& [node, weight] : kGauss) {
        visit({k, middle - half * node}, half * weight);
        visit({k, middle + half * node}, half * weight);
      }
    }
  }
}

}  // namespace

WalkRoughness RoughnessOf(const SuperposedWalk& walk) {
  WalkRoughness roughness;
  ForEachNode(walk, [&](const LocalTime& at, double weight) {
    const Integrand f(walk.At(at), walk.model());
    roughness.com_acceleration += weight * f.acceleration.squaredNorm();
    roughness.com_jerk += weight * f.jerk.squaredNorm();
    roughness.foot_speed += weight * (f.left.squaredNorm() + f.right.squaredNorm());
  });
  return roughness;
}

double WeightedRoughness(const SuperposedWalk& walk, const RoughnessWeights& weights,
                         ParameterGradient* gradient) {
  double value = 0.0;
  std::vector<WalkSensitivity> sensitivities;
  ForEachNode(walk, [&](const LocalTime& at, double weight) {
    const Integrand f(walk.At(at), walk.model());
    value += weight * f.Dot(f, weights);
    if (gradient == nullptr) return;
    walk.Sensitivities(at, &sensitivities);
    for (const WalkSensitivity& s : sensitivities) {
      gradient->emplace_back(s.parameter,
                             2.0 * weight * f.Dot(Integrand(s.jet, walk.model()), weights));
    }
  });
  if (gradient == nullptr) return value;
  // The own stretch of half-step k ends at T_k − Δ_k. The integrand is zero at the walk's end.
  for (int k = 0; k + 1 < walk.num_half_steps(); ++k) {
    const Integrand f(walk.At(LocalTime{k, walk.start_of(k + 1) - walk.start_of(k)}), walk.model());
    gradient->emplace_back(HomotopyParameter{Family::kDuration, k}, f.Dot(f, weights));
    gradient->emplace_back(HomotopyParameter{Family::kOverlap, k}, -f.Dot(f, weights));
  }
  return value;
}

}  // namespace halfstep
