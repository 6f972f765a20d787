#include "experiments/verify/check_episode_commands.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

constexpr double kSameFootstep = 1e-9;  // [m], [rad]
// Times of the script are rounded once more than those of worlds [s].
constexpr double kSameTime = 1e-9;

bool IsCommand(const ScriptEvent& event) {
  return event.what == "walk" || event.what == "follow" || event.what == "footsteps";
}

// Which command counts at a time of the walk [s], from 1; 0: none, or the goal was set since.
int CommandAt(const LiveOptions& options, double waited, double t) {
  int counts = 0, number = 0;
  for (const ScriptEvent& event : options.script) {
    if (event.at - waited > t) break;
    if (IsCommand(event)) counts = ++number;
    if (event.what == "goal") counts = 0;
  }
  return counts;
}

// Whether the last rows of footsteps.csv are the footsteps of an event.
bool EndsWith(const std::vector<FootstepRow>& rows, const std::vector<CommandedFootstep>& listed) {
  if (rows.size() < listed.size() + 2) return false;
  for (size_t i = 0; i < listed.size(); ++i) {
    const FootstepRow& row = rows[rows.size() - listed.size() + i];
    const Pose2& wanted = listed[i].X_WF;
    const bool same = row.foot == Name(listed[i].side) &&
                      std::abs(row.X_WF.x - wanted.x) <= kSameFootstep &&
                      std::abs(row.X_WF.y - wanted.y) <= kSameFootstep &&
                      std::abs(row.X_WF.yaw - wanted.yaw) <= kSameFootstep;
    if (!same) return false;
  }
  return true;
}

// Of the rows `commanded`: one of each world where another command counts. Returns which one counts
// in the last world.
int CheckTold(const EpisodeText& episode, const LiveOptions& options, double waited,
              Findings* findings) {
  Faults faults;
  std::vector<long> rows_of(episode.worlds.size());
  for (const EventRow& event : episode.events) {
    if (event.what != "commanded") continue;
    if (event.world >= 0 && event.world < std::ssize(rows_of)) {
      ++rows_of[static_cast<size_t>(event.world)];
    } else {
      faults.Add(
          Formatted("events.csv: a row `commanded` of world %d, which is not there", event.world));
    }
  }
  const int first = episode.grants.empty() ? 0 : episode.grants.front().world;
  int told = 0;
  for (size_t world = 0; world < episode.worlds.size(); ++world) {
    const long rows = rows_of[world];
    const bool looked = static_cast<int>(world) >= first;
    const double t = episode.worlds[world].measured;
    int counts = CommandAt(options, waited, t + kSameTime);
    // A command of this very instant may count from the next world on.
    if (rows == 0 && CommandAt(options, waited, t - kSameTime) == told) counts = told;
    const long due = looked && counts != told ? 1 : 0;
    if (rows != due) {
      faults.Add(Formatted("events.csv: %ld rows `commanded` of world %zu instead of %ld", rows,
                           world, due));
    }
    if (looked) told = counts;
  }
  faults.Conclude(findings);
  return told;
}

}  // namespace

void CheckEpisodeCommands(const EpisodeText& episode, const EpisodeManifest& manifest,
                          const LiveOptions& options, Findings* findings) {
  const bool tells = std::ranges::any_of(
      episode.events, [](const EventRow& event) { return event.what == "commanded"; });
  if (options.sensing.source == "client" || manifest.ending == "killed") {
    if (tells) findings->NotExamined("what clients commanded: the script does not have it");
    return;
  }
  if (!tells && std::ranges::none_of(options.script, IsCommand)) return;
  const int last = CheckTold(episode, options, manifest.waited, findings);
  if (manifest.ending == "arrived" && last != 0) {
    findings->Disagree(
        Formatted("manifest.json: ending: the robot has not arrived: command %d counts in place of "
                  "the goal",
                  last));
  }
  long listed = 0;
  for (size_t k = 0; k < episode.plans.size() && k < episode.walks.size(); ++k) {
    if (episode.plans[k].kind != "commanded") continue;
    ++listed;
    const double by = episode.plans[k].handed_over + manifest.waited;
    if (options.drift > 0) continue;
    const bool same = std::ranges::any_of(options.script, [&](const ScriptEvent& event) {
      return event.what == "footsteps" && event.at <= by + kSameTime &&
             EndsWith(episode.walks[k].footsteps, event.footsteps);
    });
    if (same) continue;
    findings->Disagree(FolderOfWalk(k) + "/footsteps.csv: does not end with footsteps that had " +
                       Formatted("been commanded by %.9g s", episode.plans[k].handed_over));
  }
  findings->Say("commands: " + Count(std::ranges::count_if(options.script, IsCommand)) +
                " of the script, each told when a frame made it known" +
                (options.drift > 0
                     ? ""
                     : "; " + Count(listed) + (listed == 1 ? " walk ends" : " walks end") +
                           " with commanded footsteps"));
  if (options.drift > 0 && listed > 0) {
    findings->NotExamined("whether walks end with commanded footsteps: the world drifts");
  }
  findings->NotExamined("how far walks keep to a commanded velocity or path");
}

}  // namespace halfstep::verify
