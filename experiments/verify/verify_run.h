#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/verify/walk_prover.h"
#include "wpg/robot/not_covered.h"

namespace halfstep::verify {

/// `tolerance` is how far the played motion, which is straight between rows, may leave the
/// certified walk [m] (chord against curve: about 0.3 mm at rows every 5 ms for HRP-2); where it is
/// not given, Tolerances::played of the robot, 1 mm for HRP-2. It is taken off what is demanded of
/// that motion's clearances and of the heights of its bodies that are not on a foot, and off
/// nothing else: of the walk itself all that is demanded is proved, and rows and claims are
/// compared with it.
struct VerifyOptions {
  WalkProver prove = {};                   ///< has to be given (std::logic_error)
  std::string run;                         ///< run folder
  std::optional<std::string> method = {};  ///< none: every one of the run
  std::optional<double> tolerance = {};    ///< see above; 0 … 1 [m]
  std::optional<std::string> robot = {};   ///< YAML instead of the certificate's
  std::optional<std::string> scene = {};   ///< YAML instead of the certificate's
  Toolbox tools = {};                      ///< that this program knows
};

/// What was found about one method of a run, or about an episode.
struct MethodVerification {
  std::string method;              ///< its folder's name; of an episode "episode"
  bool verified = false;           ///< whether it agrees in everything
  bool readable = true;            ///< false: `complaints` says what cannot be read
  std::vector<std::string> lines;  ///< one for each check
  /// What no check could look at, with the reason: it is not part of `verified`.
  std::vector<std::string> not_examined;
  std::string too_coarse;               ///< why the rows cannot settle it; "": they can
  std::vector<std::string> reasons;     ///< why it is not verified, the first twenty
  long disagreements = 0;               ///< all of them
  std::vector<std::string> complaints;  ///< of unreadable input, "file:line: …"
  std::string statement;                ///< the certificate's own
  std::vector<NotCovered> not_covered;  ///< what it does not speak of, as found here
  std::string remark;                   ///< what to say beside "verified"; "": nothing
  bool of_episode = false;              ///< which list of NotExamined is its own
  /// False of a plan, `raw`, that manifest and certificate call infeasible, where another walk of
  /// the run is verified: there is nothing to verify.
  bool claimed = true;
};

/// Checks the certificates of a run against its other files, robot and scene: that they speak of
/// the same things, that half_steps.csv and overlaps.csv describe one walk, that trajectory.csv has
/// its rows and margins, that the certificate's rows are true of it, that it keeps what is demanded
/// at every instant (`prove`), and that so does, less the tolerance, the robot that plays the
/// trajectory. Distances are its own (Solid), and only of the very files that the certificate is
/// about. None of the smoothing takes part; shared with the search for walks are the readers of
/// input files.
/// A method without a certificate is not verified. Throws InputError when no method has one. The
/// folder of an episode gives one result (VerifyEpisode), and has no methods.
std::vector<MethodVerification> VerifyRun(const VerifyOptions& options);

/// The result as `halfstep verify` prints it: a line, and the first reasons when it is not
/// verified.
std::string Summary(const MethodVerification& result);
/// The same with a line for each check, all reasons that are kept, and the certificate's statement.
std::string Describe(const MethodVerification& result);
/// What is not examined of a result, one line an entry.
std::string TellNotExamined(const MethodVerification& result);

}  // namespace halfstep::verify
