#pragma once

#include <optional>
#include <string>
#include <vector>

namespace halfstep::verify {

struct VerifyOptions {
  std::string run;                         ///< run folder
  std::optional<std::string> method = {};  ///< none: every one that has a certificate
  double tolerance = 0.001;                ///< of clearances [m]; what follows for others: README
  std::optional<std::string> robot = {};   ///< YAML instead of the certificate's
  std::optional<std::string> scene = {};
};

/// What was found about one method of a run.
struct MethodVerification {
  std::string method;  ///< its folder's name
  bool verified = false;
  bool readable = true;              ///< false: `complaints` says what cannot be read
  std::vector<std::string> lines;    ///< one a check
  std::vector<std::string> reasons;  ///< why it is not verified, the first ten
  long disagreements = 0;
  std::vector<std::string> complaints;  ///< of unreadable input, "file:line: …"
  std::string statement;                ///< the certificate's own
};

/// Checks the certificates of a run against its trajectories, the robot and the scene, by forward
/// kinematics and triangle distances only; distances only of the very files that the certificate is
/// about. Throws InputError when there is nothing to check.
std::vector<MethodVerification> VerifyRun(const VerifyOptions& options);

/// The result as `halfstep verify` prints it.
std::string Describe(const MethodVerification& result);

}  // namespace halfstep::verify
