#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/survey/robot_draft.h"
#include "experiments/survey/stance_search.h"

namespace halfstep {

/// What is asked of a URDF, and what the user knows better.
struct SurveyRequest {
  std::filesystem::path urdf;      ///< of the robot
  std::string name = {};           ///< "": that of `<robot>`, else of the URDF's file
  std::filesystem::path out = {};  ///< the robot file; "": beside the URDF, named like it or `name`
  LegNames legs = {};              ///< waist and feet, where the user names them
  std::map<std::string, std::string> packages = {};  ///< name → folder
  StanceRequest stance = {};                         ///< how the robot shall stand
  std::optional<StatedSoles> soles = {};             ///< where the user names them
};

/// What was found of a URDF.
struct RobotSurvey {
  RobotDraft draft;  ///< as far as it goes
  /// Complaints, the first of which is one sentence that says what keeps the robot from being of
  /// the class; empty: nothing does.
  std::vector<std::string> refused = {};
};

/// Makes a robot file of a URDF: finds waist and legs; asks whether the robot is of the class;
/// finds waist frame, soles, a posture to stand in, joints of the arms that keep them off the legs,
/// and neighbours that touch by design. Throws InputError for a URDF that cannot be read.
RobotSurvey SurveyRobot(const SurveyRequest& request);

}  // namespace halfstep
