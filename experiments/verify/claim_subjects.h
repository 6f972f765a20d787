#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/distances.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// What a row of a certificate is about, as indices: a side; a side and a joint; a body, or a
/// foot, and an obstacle; two bodies; a foot and an area; a half-step. −1: the row names none.
struct ClaimSubject {
  int first = -1, second = -1;  ///< −1: none
};

/// All subjects that a row of certificate.csv may have, by family and name.
class ClaimSubjects {
 public:
  /// Names of both are taken over.
  ClaimSubjects(const RobotModel& robot, const Distances& distances);

  /// None when nothing of the family is called so.
  std::optional<ClaimSubject> Find(Family family, const std::string& name) const;

 private:
  std::array<std::map<std::string, ClaimSubject>, kNumFamilies> subjects_;
  // A body or a foot and an obstacle, "BODY - OBSTACLE": too many pairs to list.
  std::vector<std::string> bodies_;
  std::map<std::string, int> obstacles_;
  int num_of_scene_ = 0;  // obstacles; solids of the ground come after these
};

}  // namespace halfstep::verify
