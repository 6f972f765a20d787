#include "experiments/verify/check_episode_commands.h"

#include <algorithm>
#include <cmath>

#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

constexpr double kSameFootstep = 1e-9;  // [m], [rad], [s]

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

// Of the rows `commanded`: one of each world where another command counts.
void CheckTold(const EpisodeText& episode, const std::vector<int>& counts, Findings* findings) {
  Faults faults;
  const int first = episode.grants.empty() ? 0 : episode.grants.front().world;
  int told = 0;
  for (size_t world = 0; world < counts.size(); ++world) {
    const long rows = std::ranges::count_if(episode.events, [&](const EventRow& event) {
      return event.what == "commanded" && event.world == static_cast<int>(world);
    });
    const bool looked = static_cast<int>(world) >= first;
    const long due = looked && counts[world] != told ? 1 : 0;
    if (rows != due) {
      faults.Add(Formatted("events.csv: %ld rows `commanded` of world %zu instead of %ld", rows,
                           world, due));
    }
    if (looked) told = counts[world];
  }
  faults.Conclude(findings);
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
  std::vector<int> counts;
  for (const WorldRow& world : episode.worlds) {
    counts.push_back(CommandAt(options, manifest.waited, world.measured));
  }
  CheckTold(episode, counts, findings);
  if (manifest.ending == "arrived" && counts.back() != 0) {
    findings->Disagree(
        Formatted("manifest.json: ending: the robot has not arrived: command %d counts in place of "
                  "the goal",
                  counts.back()));
  }
  long listed = 0;
  for (size_t k = 0; k < episode.plans.size() && k < episode.walks.size(); ++k) {
    if (episode.plans[k].kind != "commanded") continue;
    ++listed;
    const double by = episode.plans[k].handed_over + manifest.waited;
    const bool same =
        options.drift > 0 || std::ranges::any_of(options.script, [&](const ScriptEvent& event) {
          return event.what == "footsteps" && event.at <= by + kSameFootstep &&
                 EndsWith(episode.walks[k].footsteps, event.footsteps);
        });
    if (same) continue;
    findings->Disagree(FolderOfWalk(k) + "/footsteps.csv: does not end with footsteps that had " +
                       Formatted("been commanded by %.9g s", episode.plans[k].handed_over));
  }
  findings->Say("commands: " + Count(std::ranges::count_if(options.script, IsCommand)) +
                " of the script, each told when a frame made it known; " + Count(listed) +
                " walks end with commanded footsteps");
  findings->NotExamined("how far walks keep to a commanded velocity or path");
}

}  // namespace halfstep::verify
