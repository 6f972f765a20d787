#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/check_overlaps.h"
#include "experiments/verify/described_walk.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// Everything that verify knows of the dichotomy's walk of Fig. 5, as values to be changed.
struct Material {
  RobotModel robot;
  Scene scene;
  WalkPlan planned;
  CertificateText certificate;
  std::vector<ClaimRow> claims;
  std::vector<PlayedRow> rows;
  std::vector<HalfStepRow> half_steps;
  std::optional<std::vector<OverlapRow>> overlaps;  ///< none: the raw walk
  std::vector<FootstepRow> footsteps;
};

/// The checks.
enum class Of {
  kMotion,
  kProved,
  kFloor,
  kConsistency,
  kClearances,
  kClaims,
  kColumns,
  kWalk,
  kOverlaps,
  kArithmetic
};

/// What is changed, and what the check says of it.
struct Wrong {
  std::string name;
  Of check;
  std::function<void(Material&)> tamper;
  std::string reason;  ///< how it begins
};
inline void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

/// A change of what is known.
using Change = std::function<void(Material&)>;

/// What half_steps.csv, overlaps.csv and footsteps.csv say wrongly.
std::vector<Wrong> WrongSteps();

}  // namespace halfstep::verify
