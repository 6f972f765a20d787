#pragma once

#include <optional>
#include <string>
#include <vector>

namespace halfstep::verify {

/// `tolerance` is how far the played motion, straight between rows, may leave the certified walk
/// (chord against curve: about 0.3 mm at rows every 5 ms). It is taken off the clearances and the
/// height of a moving sole [m], and off margins at the midpoints of certificate rows [m, rad; 20
/// times as much for speeds]. By it also hang how well c, ċ, c̈ of the rows must fit each other:
/// tolerance·√(g/z_c) [m/s] and tolerance·g/z_c [m/s²]. Everything else is compared at the rows
/// themselves, where only rounding is allowed for (check_rows.cc).
struct VerifyOptions {
  std::string run;                         ///< run folder
  std::optional<std::string> method = {};  ///< none: every one of the run
  double tolerance = 0.001;                ///< see above; 0 … 1
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
/// kinematics and distances of its own only; distances only of the very files that the certificate is
/// about. A method without a certificate is not verified. Throws InputError when no method has one.
std::vector<MethodVerification> VerifyRun(const VerifyOptions& options);

/// The result as `halfstep verify` prints it.
std::string Describe(const MethodVerification& result);

}  // namespace halfstep::verify
