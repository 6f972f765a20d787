#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/walk_text.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// What a run says of a walk, and what is demanded of it.
struct WalkToProve {
  const RobotModel& robot;                     ///< that walks
  const Scene& scene;                          ///< among what
  const CertificateText& certificate;          ///< what is demanded; its rows are not read
  const HalfStep& form;                        ///< of half-steps, by the config
  const std::vector<FootstepRow>& footsteps;   ///< footsteps.csv
  const std::vector<HalfStepRow>& half_steps;  ///< half_steps.csv
  const std::optional<std::vector<OverlapRow>>& overlaps;  ///< none: that of the plan
  const std::string& stop_branches;                        ///< demanded: none, down or all
};
/// The same of an episode.
struct EpisodeToProve {
  const RobotModel& robot;         ///< that walks
  const Scene& scene;              ///< with the boxes to spare
  const CertificateText& demands;  ///< what is demanded
  const HalfStep& form;            ///< of half-steps, by the config
  const EpisodeText& episode;      ///< its tables
};

/// A statement about all instants of a walk and of what it is cut to.
struct ProvedStatement {
  std::optional<Family> family = {};  ///< none: at most one foot is in the air
  std::string subject = {};           ///< whose margin it is
  bool proved = false;                ///< at least `demanded` is kept
  double demanded = 0;                ///< [unit of the family]
  double least = 0;                   ///< proved: no less is kept; else about what is kept at `at`
  double at = 0;                      ///< [s]
};
/// All statements of a walk or an episode.
struct ProvedStatements {
  std::vector<ProvedStatement> statements;  ///< those of branches among them
  size_t branches = 0;                      ///< walks that are cut, of which the same is said
};

/// Proves statements about all instants of walks, from what tables say of these alone. Each throws
/// InputError for what is no walk. Handed in: the interval checker, which has the readers of verify
/// and lies above it (checker::ProverOfWalks).
struct WalkProver {
  std::function<ProvedStatements(const WalkToProve&)> of_run = {};         ///< of a method
  std::function<ProvedStatements(const EpisodeToProve&)> of_episode = {};  ///< of what began
};

/// What verify calls the margins of a family.
const char* NameOf(Family family);

/// Tells what was proved: a line for each family, and a disagreement where a statement of it was
/// not. An InputError of `prove` is one, too.
void TellProved(const std::function<ProvedStatements()>& prove, Findings* findings);

}  // namespace halfstep::verify
