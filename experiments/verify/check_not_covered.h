#pragma once

#include <string>
#include <vector>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"
#include "planner/scene/scene.h"
#include "wpg/robot/not_covered.h"

namespace halfstep::verify {

/// What a certificate with these demands and limits does not speak of, found from robot and scene
/// anew, without what the certificate lists.
std::vector<NotCovered> FindNotCovered(const CertificateText& certificate, const RobotModel& robot,
                                       const Scene& scene);

/// Whether the list in a file is that one: nothing left out, added or said in other words. `file`
/// names it: "certificate.json".
void CheckNotCovered(const std::string& file, const std::vector<NotCoveredItem>& listed,
                     const std::vector<NotCovered>& found, Findings* findings);

}  // namespace halfstep::verify
