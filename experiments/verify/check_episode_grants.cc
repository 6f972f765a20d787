#include "experiments/verify/check_episode_grants.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

// Times of two clocks that count the same ticks [s].
constexpr double kTick = 1e-9;

std::string LineOfGrant(size_t grant) { return Formatted("grants.csv:%zu: ", grant + 2); }

// How long what is proved against a world holds [s].
double ValidUntil(const EpisodeText& episode, size_t world) {
  double until = std::numeric_limits<double>::infinity();
  for (const ObstacleRow& row : episode.obstacles) {
    if (row.world != static_cast<int>(world) || !(row.speed > 0)) continue;
    until = std::min(until, episode.worlds[world].measured + row.horizon);
  }
  return until;
}

// The last row whose time is not after `t` [s]; precondition: the first one's is not.
template <typename Rows, typename Time>
size_t LatestAt(const Rows& rows, double t, const Time& time) {
  size_t latest = 0;
  while (latest + 1 < rows.size() && time(rows[latest + 1]) <= t) ++latest;
  return latest;
}

void CheckGrants(const EpisodeText& episode, Findings* findings) {
  Faults times, worlds, walks, valid;
  for (size_t g = 0; g < episode.grants.size(); ++g) {
    const GrantRow& grant = episode.grants[g];
    const size_t world = static_cast<size_t>(grant.world);
    const double known = episode.worlds[world].known, until = ValidUntil(episode, world);
    const auto walk = LatestAt(episode.plans, grant.t + kTick,
                               [](const PlanRow& row) { return row.handed_over; });
    if (!std::isfinite(grant.t) || !std::isfinite(grant.proved_from)) {
      times.Add(LineOfGrant(g) + "a time is not finite");
    }
    if (g > 0 && !(grant.t >= episode.grants[g - 1].t)) {
      times.Add(LineOfGrant(g) + "counts from before the grant before it");
    }
    if (!(grant.t >= known - kTick)) {
      worlds.Add(LineOfGrant(g) + Formatted("counts from %.9g s on, but world %d became known at "
                                            "%.9g s",
                                            grant.t, grant.world, known));
    }
    if (grant.walk != static_cast<int>(walk)) {
      walks.Add(LineOfGrant(g) +
                Formatted("of walk %d, but walk %zu was in execution", grant.walk, walk));
    }
    if (!(std::abs(grant.valid_until - until) <= kTick || grant.valid_until == until)) {
      valid.Add(LineOfGrant(g) + Formatted("valid until %.9g s, but by the measurements of world "
                                           "%d until %.9g s",
                                           grant.valid_until, grant.world, until));
    }
  }
  for (const Faults* faults : {&times, &worlds, &walks, &valid}) faults->Conclude(findings);
}

// Why a half-step, from 0, may not begin by a grant; "": it may.
std::string WhyNot(const EpisodeText& episode, const EpisodeWalks& all, int half_step,
                   const GrantRow& grant) {
  const auto [begin, end] = all.last->WindowOf(half_step);
  if (!(grant.t <= begin + kTick)) {
    return Formatted("begins at %.9g s, but its grant counts from %.9g s on", begin, grant.t);
  }
  if (!(grant.proved_from <= begin + kTick)) {
    return Formatted("begins at %.9g s, but its grant is proved from %.9g s on", begin,
                     grant.proved_from);
  }
  if (half_step + 1 > grant.through) {
    return Formatted("its grant reaches only through half-step %d", grant.through);
  }
  if (!(end <= grant.valid_until + kTick)) {
    return Formatted("ends at %.9g s, but its grant is valid until %.9g s", end, grant.valid_until);
  }
  const auto walk =
      LatestAt(episode.plans, begin + kTick, [](const PlanRow& row) { return row.handed_over; });
  if (grant.walk > static_cast<int>(walk)) {
    return Formatted("its grant is of walk %d, but walk %zu was in execution", grant.walk, walk);
  }
  const size_t newest =
      LatestAt(episode.worlds, begin - kTick, [](const WorldRow& row) { return row.known; });
  const int since = episode.worlds[newest].sound_since;
  if (since > grant.world) {
    return Formatted(
        "its grant is against world %d, which is void since world %zu, known at %.9g s",
        grant.world, newest, episode.worlds[newest].known);
  }
  return "";
}

}  // namespace

bool CheckGrantNumbers(const EpisodeText& episode, const EpisodeWalks& all, Findings* findings) {
  const long before = findings->disagreements();
  Faults grants, begun;
  for (size_t g = 0; g < episode.grants.size(); ++g) {
    const GrantRow& grant = episode.grants[g];
    if (grant.walk >= std::ssize(all.sizes)) {
      grants.Add(LineOfGrant(g) + Formatted("there is no walk %d", grant.walk));
    } else if (grant.through > Nth(all.sizes, grant.walk)) {
      grants.Add(LineOfGrant(g) + Formatted("through half-step %d, but walk %d has %d",
                                            grant.through, grant.walk, Nth(all.sizes, grant.walk)));
    }
    if (grant.world >= static_cast<int>(episode.worlds.size())) {
      grants.Add(LineOfGrant(g) + Formatted("there is no world %d", grant.world));
    }
  }
  if (episode.begun.empty()) findings->Disagree("begun.csv: no half-step began");
  if (std::ssize(episode.begun) > all.last->num_half_steps()) {
    findings->Disagree(Formatted("begun.csv: %zu half-steps, but the last walk has %d",
                                 episode.begun.size(), all.last->num_half_steps()));
  }
  for (size_t i = 0; i < episode.begun.size(); ++i) {
    const BegunRow& row = episode.begun[i];
    const std::string line = Formatted("begun.csv:%zu: ", i + 2);
    if (row.half_step != static_cast<int>(i) + 1) {
      begun.Add(line + Formatted("half-step %d instead of %zu", row.half_step, i + 1));
    }
    if (row.grant >= static_cast<int>(episode.grants.size())) {
      begun.Add(line + Formatted("there is no grant %d", row.grant));
    }
  }
  grants.Conclude(findings);
  begun.Conclude(findings);
  return findings->disagreements() == before;
}

void CheckEpisodeGrants(const EpisodeText& episode, const EpisodeWalks& all, Findings* findings) {
  CheckGrants(episode, findings);
  for (size_t i = 0; i < episode.begun.size(); ++i) {
    const BegunRow& row = episode.begun[i];
    const std::string fault =
        WhyNot(episode, all, static_cast<int>(i), Nth(episode.grants, row.grant));
    if (fault.empty()) continue;
    findings->Disagree(Formatted("begun.csv:%zu: half-step %d: ", i + 2, row.half_step) + fault);
  }
  findings->Say("begun: " + Count(std::ssize(episode.begun)) + " half-steps, allowed by " +
                Count(std::ssize(episode.grants)) + " grants");
}

}  // namespace halfstep::verify
