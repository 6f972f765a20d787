#include "experiments/verify/check_episode_proof.h"

#include <optional>

#include "experiments/config/known_names.h"
#include "experiments/verify/check_certificate.h"

namespace halfstep::verify {

CertificateText DemandsOf(const MarginLimits& limits, Findings* findings) {
  CertificateText demands;
  for (const NamedDemand& of_config : NamedDemands(limits)) {
    const std::optional<Family> family = FamilyNamed(of_config.family, findings);
    // The formula of `own` is not known here.
    if (family && family != kOwn) demands.demanded[*family] = of_config.demanded;
  }
  demands.foot_speed = limits.foot_speed;
  demands.foot_yaw_rate = limits.foot_yaw_rate;
  demands.joint_speed_scale = limits.joint_speed_scale;
  demands.landing_speed = limits.landing_speed;
  return demands;
}

}  // namespace halfstep::verify
