#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/proof_hints.h"
#include "experiments/checker/walk_motion.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/walk_prover.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// A walk that is cut after a half-step, so that it ends at rest, from some time on.
struct StopBranch {
  std::string name;                         ///< "stopped after half-step 3"
  size_t last = 0;                          ///< half-steps after it do not begin; from 0
  double from = 0.0;                        ///< [s]
  std::shared_ptr<const Scene> world = {};  ///< in place of the run's scene; null: that one
};

/// A walk of a run or an episode, and what is demanded of it.
struct WalkRun {
  WalkTables tables = {};                            ///< that describe it
  RobotModel robot = {};                             ///< that walks
  Scene scene = {};                                  ///< among what
  verify::CertificateText certificate = {};          ///< what is demanded; its rows are not read
  double crouch = 0.0;                               ///< [m]
  bool whole = true;                                 ///< whether it is asked about itself
  std::vector<StopBranch> branches = {};             ///< of which the same is demanded
  std::vector<std::string> not_covered = {};         ///< sentences on what is not looked at
  std::optional<std::vector<double>> overlaps = {};  ///< [s]; none: `starts` are as planned
  std::vector<InputFile> files = {};                 ///< that a run's walk was read from
};

/// The folders of a run's methods: the one of `method`, or all that say they are certified; of an
/// episode "", itself. Throws InputError where there is none, or no run.
std::vector<std::string> CertifiedMethods(const std::string& run,
                                          const std::optional<std::string>& method);

/// Reads the walk of a method's folder, or of an episode, `method` "". Robot and scene are found as
/// `halfstep verify` finds them: in the folder, or by SHA-256 where `robot_file` or `scene_file`
/// ("": not given) or the config has them. Throws InputError for what cannot be read, and for
/// tables that disagree on when half-steps begin.
WalkRun ReadWalkRun(const std::string& run, const std::string& method,
                    const std::string& robot_file = "", const std::string& scene_file = "");
/// The walk of a method's tables, and the stop branches that are demanded. Throws InputError as
/// above.
WalkRun RunOf(const verify::WalkToProve& of);
/// That of an episode: what was executed from when a half-step began until the next one did is the
/// beginning of the last walk, cut after it, in the world of its grant. Source:
/// experiments/episodes.md.
WalkRun RunOf(const verify::EpisodeToProve& of);
/// The same of its folder.
WalkRun ReadEpisodeRun(const std::string& folder, const std::string& robot_file,
                       const std::string& scene_file);

/// What files say that nothing is claimed of; pairs of bodies in one sentence.
std::vector<std::string> SentencesOf(const std::vector<verify::NotCoveredItem>& not_covered);

/// CheckWalk of the walk and of its branches, each from its `from` on: of each statement what is
/// kept least, or missed. `hints` are of the walk itself.
TrajectoryCheck CheckRun(const WalkRun& run, const std::function<bool(double done)>& progress = {},
                         ProofHints* hints = nullptr);

}  // namespace halfstep::checker
