#include "experiments/verify/check_episode_proof.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "experiments/config/known_names.h"
#include "experiments/verify/check_certificate.h"
#include "experiments/verify/check_clearance.h"
#include "experiments/verify/check_episode_worlds.h"
#include "experiments/verify/check_played.h"
#include "experiments/verify/distances.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

// A world as a grant knows it.
struct KnownWorld {
  KnownWorld(const RobotModel& robot, Scene known)
      : scene(std::move(known)), distances(robot, scene) {}
  KnownWorld(const KnownWorld&) = delete;
  KnownWorld& operator=(const KnownWorld&) = delete;

  Scene scene;
  Distances distances;
};

// The half-steps, from 1, of which events.csv says that they began nearer to an obstacle than
// demanded.
std::set<int> ThoseNear(const EpisodeText& episode) {
  std::set<int> near;
  for (const EventRow& event : episode.events) {
    if (event.what == "near") near.insert(event.half_step);
  }
  return near;
}

// What a half-step, from 0, is held to that begins at rest nearer to obstacles than demanded: from
// these it keeps what it has when it begins, less kNearer, and at least 0. To demand less of an
// obstacle is said here as a smaller error.
Scene SceneFromRest(const DescribedWalk& walk, int half_step, Scene scene, double demanded,
                    double tolerance, Findings* findings) {
  constexpr double kNearer = 1e-3, kAtRest = 1e-9;  // [m], [s]
  const std::string name = Formatted("half-step %d begins near an obstacle, ", half_step + 1);
  const double t = walk.WindowOf(half_step).first;
  // A walk begins at rest.
  if (half_step > 0 && !(walk.WindowOf(half_step - 1).second <= t + kAtRest)) {
    findings->Disagree(name + "but not from rest");
    return scene;
  }
  Distances distances(walk.robot(), scene);
  const Placement at = PlaceRobot(walk.robot(), walk.Row(t));
  for (size_t o = 0; o < distances.num_obstacles(); ++o) {
    double margin = demanded;
    for (size_t b = 0; b < distances.num_bodies(); ++b) {
      margin = std::min(margin, distances.FromObstacle(b, o, at, t, demanded + kQuick).distance);
    }
    if (!(margin >= -tolerance)) {
      findings->Disagree(name + Formatted("which may be touched there: %.4g m from ", margin) +
                         Quote(scene.obstacles[o].name));
    }
    if (margin >= demanded) continue;
    scene.obstacles[o].motion.error -= demanded - std::max(0.0, margin - kNearer);
  }
  return scene;
}

}  // namespace

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

void CheckEpisodeProof(const EpisodeText& episode, const DescribedWalk& walk, const Scene& scene,
                       const CertificateText& demands, const EpisodeProofOptions& options,
                       Findings* findings) {
  const std::set<int> told_near = ThoseNear(episode);
  std::set<int> worlds;
  int of_world = -1;
  std::unique_ptr<KnownWorld> world;
  long statements = 0, kept = 0, coarse = 0, near = 0;
  Reached nearest;
  nearest.spare = std::numeric_limits<double>::infinity();
  for (const BegunRow& begun : episode.begun) {
    const GrantRow& grant = Nth(episode.grants, begun.grant);
    if (!world || grant.world != of_world) {
      world = std::make_unique<KnownWorld>(
          walk.robot(), SceneOfWorld(episode, scene, static_cast<size_t>(grant.world)));
      of_world = grant.world;
      worlds.insert(of_world);
    }
    Findings of_branch;
    std::unique_ptr<KnownWorld> from_rest;
    if (told_near.contains(begun.half_step)) {
      from_rest = std::make_unique<KnownWorld>(
          walk.robot(), SceneFromRest(walk, begun.half_step - 1, world->scene,
                                      demands.demanded[kClearance], options.tolerance, findings));
      ++near;
    }
    CheckStopBranch(walk, begun.half_step - 1, 0, options.period, demands, options.tolerance,
                    &(from_rest ? from_rest : world)->distances, &of_branch);
    const std::string where =
        Formatted("stopped after half-step %d, against world %d: ", begun.half_step, grant.world);
    findings->TakeReasons(of_branch, where);
    for (const Reached& reached : of_branch.reached()) {
      statements += reached.count;
      if (reached.name == "clearance" && reached.spare < nearest.spare) nearest = reached;
    }
    if (!of_branch.too_coarse().empty()) {
      findings->TooCoarse(where + of_branch.too_coarse());
      ++coarse;
    } else if (of_branch.disagreements() == 0) {
      ++kept;
    }
  }
  findings->Say("proof: " + Count(kept) + " of " + Count(std::ssize(episode.begun)) +
                " stop branches keep every margin, against " + Count(std::ssize(worlds)) +
                " worlds, by " + Count(statements) + " statements" +
                (coarse == 0 ? "" : "; " + Count(coarse) + " are too coarse to tell"));
  if (near > 0) {
    findings->Say("near: " + Count(near) + " half-steps began at rest nearer to an obstacle than " +
                  "demanded, and are held to what they had there");
  }
  const double seen = kQuick - options.tolerance;
  findings->Say(
      nearest.spare < seen
          ? Formatted("clearance: least measured %.4g m beyond what was demanded (",
                      nearest.spare) +
                nearest.where + ")"
          : Formatted("clearance: everywhere %.4g m and more beyond what was demanded", seen));
}

}  // namespace halfstep::verify
