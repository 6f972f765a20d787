#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/search/planners.h"
#include "planner/search/step_set.h"
#include "planner/swept/swept_volume.h"
#include "wpg/files/fields.h"

namespace halfstep {

/// Where the walk shall end, in place of footsteps.
struct GoalConfig {
  std::string part = "either_foot";  ///< a name of GoalPart
  Pose2 X_WG;           ///< centre of the region, in W; its yaw is the middle of the range of yaw
  double radius = 0.1;  ///< [m]
  std::vector<double> box;              ///< edge lengths [m]; empty: the disc
  std::optional<double> yaw_tolerance;  ///< [rad]; none: any yaw
  std::string level = {};               ///< name of a surface, or "floor"; "": any

  /// The region as planners take it.
  GoalRegion Region() const;
};

/// The group `planner`.
struct PlannerConfig {
  std::string name = "best";  ///< one of known.Names()
  std::string cost = {};      ///< a name of CostKind; "": as `name` wants it
  std::string free_by = {};   ///< volumes or certificates; "": as the ground wants it
  std::string moving = {};    ///< in_time or everywhere; "": as the planner can
  StepCost estimate;          ///< its numbers; Cost() sets its kind by `cost`
  int max_nodes = 100000;     ///< ends the search
  /// Ends after these without a better plan; 0: at the first plan; none: as `name` wants it.
  std::optional<double> unimproved_nodes = {};
  double improving_effort = 2.0;  ///< of `best`: ends when there is a plan after this much work
  double effort = 60.0;           ///< ends the search (PlanProgress::effort)
  double deadline = 0.0;          ///< an emergency stop by the clock [s]; 0: none
  int max_refusals = 5;           ///< plans that the full check may refuse before planning ends
  std::vector<double> workspace;  ///< x_min, y_min, x_max, y_max [m]; empty: the planner's
  PlannerOptions options;         ///< of the planner by that name
  Planners known = Planners::Standard();  ///< those that `name` may name

  /// The cost that plans are compared by; `in_time`: of plans in time.
  StepCost Cost(bool in_time = false) const;
  std::string CostName(bool in_time = false) const;  ///< its name
  /// When a plan is good enough; `in_time`: in time, where `best` takes four times the work.
  Termination Enough(bool in_time) const;
};

/// The group `swept_volumes`.
struct SweptVolumesConfig {
  SweptVolumeOptions options;  ///< its clearance is the demanded margin's
  std::string cache;           ///< folder; "": DefaultCacheFolder()
};

/// Declare the keys of one group each.
void DeclareGoal(Fields& fields, GoalConfig* config);
/// The keys of `planner`.
void DeclarePlanner(Fields& fields, PlannerConfig* config);
/// The keys of `step_set`.
void DeclareStepSet(Fields& fields, StepGrid* grid);
/// The keys of `swept_volumes`.
void DeclareSweptVolumes(Fields& fields, SweptVolumesConfig* config);

}  // namespace halfstep
