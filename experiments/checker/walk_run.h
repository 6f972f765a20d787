#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/checker/walk_motion.h"
#include "experiments/verify/certificate_text.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// A walk of a run folder, and what is demanded of it.
struct WalkRun {
  WalkTables tables;                                 ///< that describe it
  RobotModel robot;                                  ///< that walks
  Scene scene;                                       ///< among what
  verify::CertificateText certificate;               ///< what is demanded; its rows are not read
  double crouch = 0.0;                               ///< [m]
  std::vector<std::string> not_covered;              ///< sentences on what is not looked at
  std::optional<std::vector<double>> overlaps = {};  ///< [s]; none: `starts` are as planned
  std::vector<InputFile> files = {};                 ///< that it was read from
};

/// The folders of a run's methods: the one of `method`, or all that say they are certified. Throws
/// InputError where there is none, or no run.
std::vector<std::string> CertifiedMethods(const std::string& run,
                                          const std::optional<std::string>& method);

/// Reads the walk of a method's folder. Robot and scene are found as `halfstep verify` finds them:
/// in the folder, or by SHA-256 where `robot_file` or `scene_file` ("": not given) or the config
/// has them. Throws InputError for what cannot be read, and for tables that disagree on when
/// half-steps begin.
WalkRun ReadWalkRun(const std::string& run, const std::string& method,
                    const std::string& robot_file = "", const std::string& scene_file = "");

}  // namespace halfstep::checker
