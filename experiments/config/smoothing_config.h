#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/margins/demand_profile.h"
#include "smoothing/margins/margin.h"
#include "smoothing/methods/methods.h"
#include "smoothing/proof/certificate.h"
#include "smoothing/walk/parameter_table.h"
#include "wpg/files/fields.h"

namespace halfstep {

/// A parameter that methods leave alone, as a config names it: "overlap", 3 (from 1).
struct FixedConfig {
  std::string parameter = "overlap";  ///< the name of a parameter family
  int index = 1;                      ///< junction, step or half-step of the family, from 1
  std::optional<double> value;        ///< in the family's unit; none: as planned
};

/// Files that hold a walk of one's own, with columns of overlaps.csv and half_steps.csv; "": none.
struct GivenWalkFiles {
  std::string overlaps;    ///< one row a junction
  std::string half_steps;  ///< one row a half-step
};

/// The group `smoothing`: the methods, and what they have to keep.
struct SmoothingConfig {
  Methods known = Methods::Standard();  ///< those that `methods` may name; set by SetKnown
  std::vector<std::string> methods = {"dichotomy"};  ///< in the order in which they run
  std::string acceptance = "certified";  ///< "certified" or "sampled": how a method accepts a walk
  double sampling = 0.005;               ///< period of acceptance `sampled` [s]
  std::string stop_branches = "none";    ///< one of the names of StopBranches
  bool repair_plan = false;              ///< RepairPlan() before the methods
  int threads = 1;                       ///< of searches and proofs, the caller's included
  CertificationOptions certification;    ///< of proofs, whatever `acceptance` is
  MethodOptions options;                 ///< of the groups that the known methods have
  std::vector<FixedConfig> fixed;        ///< parameters that no method moves
  bool has_given = false;                ///< whether `given` names files
  GivenWalkFiles given;                  ///< of the method `given`
  std::string profile{Name(DemandProfile::kWalkable)};  ///< of which `limits` are, but for keys
  MarginLimits limits = LimitsOf(DemandProfile::kWalkable);  ///< limits, demanded margins, tube
  /// Acceleration that is assumed to be allowed to leg joints of which the robot file states none
  /// [rad/s²]; none: nothing is assumed.
  std::optional<double> assumed_acceleration;
  bool has_tube = false;  ///< whether `tube` is there, which may be all 0
};

/// Makes a config's methods, and the margins and costs of one's own, those that a program has.
void SetKnown(Methods known, SmoothingConfig* config);

/// Declares the keys of the group.
void DeclareSmoothing(Fields& fields, SmoothingConfig* config);
/// Those of its `tube`.
void DeclareTube(Fields& fields, Tube* tube);
/// The widest tube that the keys take.
Tube WidestTube();

/// The parameters that a config fixes. Precondition: each names a family, which reading ensures.
std::vector<FixedParameter> FixedParameters(const SmoothingConfig& config);

}  // namespace halfstep
