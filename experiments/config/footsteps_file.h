#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// A footstep as a file has it.
struct FiledFootstep {
  Side foot = Side::kLeft;           ///< the foot that steps
  Pose2 X_WF;                        ///< the sole's place in W, seen from above
  std::optional<double> via_height;  ///< [m]; none: the file does not say
  std::optional<double> duration;    ///< of each half-step [s]; none: the file does not say
  std::optional<double> z = {};      ///< height of the level there [m]; none: the file does not say
  std::optional<double> rest = {};   ///< Footstep::rest [s]; none: the file does not say
  std::optional<double> rest_on_one_foot = {};  ///< the same of Footstep::rest_on_one_foot
  std::optional<double> crouch = {};            ///< and of Footstep::crouch [m]
};

/// The footsteps of a file.
struct FiledFootsteps {
  /// Where the soles stand at the start, left and right; none: the file does not say.
  std::optional<std::vector<Pose2>> start;
  /// Their heights, where it says them: as many, or none.
  std::vector<double> start_heights = {};
  std::vector<FiledFootstep> steps;  ///< in the order of stepping, at least one
};

/// Reads footsteps from a file of either form, which its ending says:
///
/// - `.csv`: a row a footstep with the columns foot (left, right), x_m, y_m, yaw_rad or yaw_deg
///   and, if wanted, via_height_m, duration_s, rest_s, rest_on_one_foot_s and crouch_m; other
///   columns of a run's footsteps.csv are allowed, and rows whose column `footstep` is 0 say where
///   the feet stand at the start.
/// - `.yaml`, `.yml`: humanoid_nav_msgs/StepTarget[], a list or a map with the list `footsteps`, of
///   `pose: {x, y, theta}` and `leg` (0 right, 1 left). Its angles may be wrapped: each is taken as
///   the turn nearest to the yaw of the foot beside it.
///
/// `relative` is for StepTargets whose poses are seen from the sole that carries, as the message
/// defines them, in place of W; `start` is then where the soles stand, left and right.
///
/// Throws InputError with every complaint as file:line:column: what cannot be read, unknown or
/// missing columns and keys, what is no finite number or out of range, a yaw of a CSV that is more
/// than half a turn from that of the foot beside it.
FiledFootsteps ReadFootsteps(const std::string& path, bool relative,
                             const std::optional<std::vector<Pose2>>& start);

}  // namespace halfstep
