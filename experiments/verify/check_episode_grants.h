#pragma once

#include "experiments/verify/check_episode_walks.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Whether grants.csv names walks and worlds that there are and begun.csv half-steps 1, 2, 3, … of
/// the last walk and grants that there are. CheckEpisodeGrants() and CheckSuccessors() need it.
/// Precondition: there is a walk.
bool CheckGrantNumbers(const EpisodeText& episode, const EpisodeWalks& all, Findings* findings);

/// Whether every grant was given in order, of the walk in execution, against a world that was known
/// then, and is valid no longer than the measurements of that world (the least t_m + H of obstacles
/// that may move); and whether every half-step of begun.csv was allowed to begin when the last walk
/// says it did: by a grant that counted then, proved from no later on, that reaches up to it, is of
/// the walk in execution or one before, is valid until it ends, and is not void (the newest world
/// known then has sound_since no later than the grant's world).
void CheckEpisodeGrants(const EpisodeText& episode, const EpisodeWalks& all, Findings* findings);

}  // namespace halfstep::verify
