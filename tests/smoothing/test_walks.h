#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "smoothing/margins/margin.h"
#include "smoothing/walk/parameter_table.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/wpg/sequence_draw.h"

namespace halfstep {

/// The largest absolute value.
inline double Largest(const WalkState& x) { return x.cwiseAbs().maxCoeff(); }
inline double Largest(const WalkJet& x) {
  return std::max({Largest(x.value), Largest(x.first), Largest(x.second)});
}

inline const Margin& Of(const MarginSet& margins, MarginFamily family) {
  return margins[static_cast<size_t>(family)];
}

/// Random walks, reproducible from the seed.
class WalkDraw : public SequenceDraw {
 public:
  using SequenceDraw::SequenceDraw;

  /// Durations within 20 % of the planned ones, heights from a tenth to all, support points within
  /// 3 cm of the planned ones, forms of each half-step's own, footsteps moved by
  /// some cm, and overlaps between `low` and `high` of their natural bounds.
  HomotopyParameters Parameters(const HalfStepSequence& sequence, double low, double high) {
    HomotopyParameters parameters = PlannedMotion(sequence);
    for (double& T : parameters.durations) T *= Uniform(0.8, 1.2);
    for (size_t j = 0; j < parameters.height_scales.size(); ++j) {
      const double least = LeastHeightScale(sequence, static_cast<int>(j));
      parameters.height_scales[j] = std::max(Uniform(0.1, 1.0), least);
      if (uneven()) parameters.height_scales[j] = Form(least + 0.02 * (1.0 - least), 1.0);
    }
    for (double& offset : parameters.support_points) offset += Form(-0.03, 0.03);
    for (double& via : parameters.of(ParameterFamily::kViaLateral)) via += Form(-0.02, 0.03);
    for (double& ramp : parameters.of(ParameterFamily::kFootRamp)) ramp = Form(0.3, 0.45);
    for (double& delay : parameters.of(ParameterFamily::kFootDelay)) delay = Form(0.02, 0.18);
    for (double& share : parameters.of(ParameterFamily::kLiftShare)) share = Form(0.6, 0.95);
    for (size_t j = 0; j < parameters.of(ParameterFamily::kViaAlong).size(); ++j) {
      parameters.of(ParameterFamily::kViaAlong)[j] =
          Form(-0.1, 0.1) * parameters.of(ParameterFamily::kViaLateral)[j];
    }
    for (double& shift : parameters.zmp_shifts) shift = Form(0.03, 0.2);
    for (double& ramp : parameters.of(ParameterFamily::kZmpBumpRamp)) {
      ramp = Form(0, 1) < 0.5 ? Form(0.3, 0.45) : Form(0.55, 0.95);
    }
    for (size_t j = 0; j < parameters.footstep_xs.size(); ++j) {
      if (Form(0, 1) < 0.3) continue;
      parameters.footstep_xs[j] = Form(-0.01, 0.01);
      parameters.footstep_ys[j] = Form(-0.005, 0.005);
      parameters.footstep_yaws[j] = Form(-0.05, 0.05);
    }
    for (size_t i = 0; uneven() && i < sequence.half_steps.size(); ++i) {
      parameters.of(ParameterFamily::kRiseBegin)[i] = Form(0.01, 0.74);
      parameters.of(ParameterFamily::kRiseEnd)[i] = Form(0.86, 0.99);
    }
    for (int i = 0; i < sequence.num_junctions(); ++i) {
      const double bound = NaturalOverlapBound(parameters, i);
      parameters.overlaps[static_cast<size_t>(i)] = Uniform(low, high) * bound;
    }
    return parameters;
  }

  /// Every overlap at a random one of: zero, a random value, the natural bound.
  HomotopyParameters ExtremeParameters(const HalfStepSequence& sequence) {
    HomotopyParameters parameters = Parameters(sequence, 0.0, 1.0);
    for (int i = 0; i < sequence.num_junctions(); ++i) {
      const double bound = NaturalOverlapBound(parameters, i);
      const double choice = Uniform(0, 3);
      if (choice < 1) parameters.overlaps[static_cast<size_t>(i)] = 0.0;
      if (choice > 2) parameters.overlaps[static_cast<size_t>(i)] = bound;
    }
    return parameters;
  }
};

/// The same walk of the mirrored sequence.
inline HomotopyParameters Mirrored(HomotopyParameters parameters) {
  for (double& y : parameters.footstep_ys) y = -y;
  for (double& yaw : parameters.footstep_yaws) yaw = -yaw;
  return parameters;
}

/// Every parameter of a sequence, but when waists rise that keep their height.
inline std::vector<HomotopyParameter> AllParameters(const HalfStepSequence& sequence) {
  std::vector<HomotopyParameter> all;
  const ParameterTable table(sequence);
  for (const ParameterRow& row : table.rows()) {
    const ParameterFamilyTraits& traits = Traits(row.parameter.family);
    const bool rests = traits.of_heights && traits.stays(sequence, row.parameter.index);
    if (!rests) all.push_back(row.parameter);
  }
  return all;
}

/// Every overlap at a fraction of its natural bound, the rest as planned.
inline HomotopyParameters Overlapped(const HalfStepSequence& sequence, double fraction) {
  HomotopyParameters parameters = PlannedMotion(sequence);
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    parameters.overlaps[static_cast<size_t>(i)] = fraction * NaturalOverlapBound(parameters, i);
  }
  return parameters;
}

/// Absolute times where some profile of the walk is not smooth: its third derivative jumps [s].
inline std::vector<double> Knots(const SuperposedWalk& walk) {
  std::vector<double> knots;
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const HalfStepTracks& p = walk.tracks(i);
    knots.push_back(walk.start_of(i));
    for (const double tau : p.Knots()) {
      knots.push_back(walk.start_of(i) + tau);
    }
  }
  return knots;
}

/// Whether a knot is nearer than `distance` [s].
inline bool NearKnot(const SuperposedWalk& walk, double t, double distance) {
  const std::vector<double> knots = Knots(walk);
  return std::any_of(knots.begin(), knots.end(),
                     [&](double knot) { return std::abs(knot - t) < distance; });
}

/// Whether a walk is C² at an instant: from h before it to h after it the second time derivatives,
/// which are continuous, differ by no more than they may change in that time.
inline bool IsC2At(const SuperposedWalk& walk, double t, double h) {
  const WalkJet before = walk.At(t - h), after = walk.At(t + h);
  return Largest(after.value - before.value) < 1e-7 && Largest(after.first - before.first) < 1e-6 &&
         Largest(after.second - before.second) < 1e-3;
}

/// A random instant of a random walk.
struct DrawnInstant {
  HomotopyParameters parameters;
  SuperposedWalk walk;
  double t;
  LocalTime at;

  /// Overlaps are between `low` and `high` of their natural bounds.
  DrawnInstant(const HalfStepSequence& sequence, double low, double high, WalkDraw* draw)
      : parameters(draw->Parameters(sequence, low, high)),
        walk(sequence, parameters),
        t(draw->Uniform(0, walk.duration())),
        at(walk.Locate(t)) {}
};

/// Value, first and second derivative one below the other (42×1).
inline Eigen::VectorXd Stacked(const WalkJet& jet) {
  Eigen::VectorXd all(3 * kNumQuantities);
  all << jet.value, jet.first, jet.second;
  return all;
}

}  // namespace halfstep
