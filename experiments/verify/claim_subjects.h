#pragma once

#include <array>
#include <map>
#include <string>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/distances.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// What a row of a certificate is about, as indices: a side; a side and a joint; a body and an
/// obstacle; two bodies; a foot and an area. −1: the row names none.
struct ClaimSubject {
  int first = -1, second = -1;
};

/// By family and the subject's name in certificate.csv.
using ClaimSubjects = std::array<std::map<std::string, ClaimSubject>, kNumFamilies>;

/// All subjects that a row may have, by their names.
ClaimSubjects SubjectsOf(const RobotModel& robot, const Distances& distances);

}  // namespace halfstep::verify
