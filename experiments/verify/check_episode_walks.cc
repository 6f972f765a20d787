#include "experiments/verify/check_episode_walks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/verify/check_overlaps.h"
#include "experiments/verify/level_tops.h"

namespace halfstep::verify {
namespace {

constexpr double kWalkRounding = 1e-9;  // [s], [m], [rad], 1

bool Near(double a, double b) { return std::abs(a - b) <= kWalkRounding; }  // false for nan

bool Near(const Pose2& a, const Pose2& b) {
  return Near(a.x, b.x) && Near(a.y, b.y) && Near(a.yaw, b.yaw);
}

bool Near(const Foothold& a, const Foothold& b) {
  return Near(a.Planar(), b.Planar()) && Near(a.height, b.height);
}

bool IsFinite(const FootstepRow& row) {
  return row.X_WF.AllFinite() && std::isfinite(row.via_height) && std::isfinite(row.duration);
}

// The plan of footsteps.csv; of no half-steps when it is none.
WalkPlan PlanOf(const std::vector<FootstepRow>& rows, const EpisodeWalkFrame& frame,
                const std::string& path, Findings* findings) {
  WalkPlan none{.start = frame.start, .half_steps = {}};
  if (rows.size() < 3) {
    findings->Disagree(path + ": no footstep");
    return none;
  }
  const LevelTops ground(frame.scene);
  std::vector<PlannedFootstep> footsteps;
  for (size_t i = 0; i < rows.size(); ++i) {
    const FootstepRow& row = rows[i];
    const std::string line = path + Formatted(":%zu: ", i + 2);
    if (!IsFinite(row)) {
      findings->Disagree(line + "a number is not finite");
      return none;
    }
    const Side side = row.foot == "left" ? Side::kLeft : Side::kRight;
    if (i >= 2 && !(row.duration > 0)) {
      findings->Disagree(line + Formatted("duration_s: %.9g", row.duration));
      return none;
    }
    if (i >= 2) {
      const double z = ground.even() ? frame.start[0].height : row.z;
      if (!ground.even() && ground.HeightUnder(frame.robot, row.X_WF, z) != z) {
        findings->Disagree(line + Formatted("no level at z = %.9g m bears all of the sole", z));
        return none;
      }
      footsteps.push_back({side, Foothold(row.X_WF, z), row.via_height, row.duration});
    } else if (static_cast<size_t>(Index(side)) != i || !Near(row.X_WF, frame.start[i].Planar()) ||
               (!ground.even() && !Near(row.z, frame.start[i].height))) {
      findings->Disagree(line + "the walk does not start where config.yaml says");
    } else if (!Near(row.via_height, 0) || !Near(row.duration, 0)) {
      findings->Disagree(line + "no step leads to a foot that stands at the start");
    }
  }
  return PlanOf(frame.start, footsteps, frame.half_step);
}

// Whether the rows of half_steps.csv make a walk of the half-steps.
bool CheckHalfSteps(const EpisodeWalkText& text, const WalkPlan& planned, const std::string& folder,
                    Findings* findings) {
  const std::vector<HalfStepRow>& rows = text.half_steps;
  const std::string path = folder + "/half_steps.csv";
  if (rows.size() != planned.half_steps.size()) {
    findings->Disagree(path + Formatted(": %zu half-steps, the footsteps make %zu", rows.size(),
                                        planned.half_steps.size()));
    return false;
  }
  if (text.overlaps.size() + 1 != rows.size()) {
    findings->Disagree(folder + Formatted("/overlaps.csv: %zu overlaps of %zu half-steps",
                                          text.overlaps.size(), rows.size()));
    return false;
  }
  Faults faults;
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::string line = path + Formatted(":%zu: ", i + 2);
    const HalfStep& half_step = planned.half_steps[i].half_step;
    std::string fault = FaultOfHalfStep(rows[i], half_step);
    if (fault.empty() && i == 0 && !Near(rows[0].start, 0)) fault = "the walk does not begin at 0";
    if (fault.empty() && i % 2 == 1) fault = FaultOfStep(rows[i - 1], rows[i]);
    if (fault.empty() && i > 0) {
      const double overlap = rows[i - 1].start + rows[i - 1].duration - rows[i].start;
      fault = FaultOfOverlap(overlap, rows[i - 1], rows[i], half_step);
      if (fault.empty() && !Near(overlap, text.overlaps[i - 1])) {
        fault = Formatted("overlap %.9g by starts and durations, %.9g in overlaps.csv", overlap,
                          text.overlaps[i - 1]);
      }
    }
    if (fault.empty() && rows[i].FormOf(half_step).footstep != Pose2{}) {
      fault = "a footstep that is moved, which no walk of an episode has";
    }
    if (!fault.empty()) faults.Add(line + fault);
  }
  const long before = findings->disagreements();
  faults.Conclude(findings);
  return findings->disagreements() == before;
}

bool NearForms(const FormColumns& a, const FormColumns& b) {
  return std::ranges::all_of(
      kFormColumns, [&](const FormColumn& one) { return Near(a.*one.value, b.*one.value); });
}

// Whether half-step i is the same in two walks.
bool SameHalfStep(const EpisodeText& episode, const EpisodeWalks& all, size_t a, size_t b,
                  size_t i) {
  const HalfStepRow &x = episode.walks[a].half_steps[i], &y = episode.walks[b].half_steps[i];
  const auto& [p, X_WS, p_rest] = all.planned[a].half_steps[i];
  const auto& [q, Y_WS, q_rest] = all.planned[b].half_steps[i];
  return p.up == q.up && p.support == q.support && Near(X_WS, Y_WS) && Near(p.X_SF, q.X_SF) &&
         Near(p.via_height, q.via_height) && Near(x.start, y.start) &&
         Near(x.duration, y.duration) && Near(x.height_scale, y.height_scale) &&
         Near(x.support_point, y.support_point) && NearForms(x.FormOf(p), y.FormOf(q));
}

// Whether the robot had stopped in a walk, with so many half-steps begun.
bool SaysStopped(const EpisodeText& episode, size_t walk, size_t begun) {
  return std::ranges::any_of(episode.events, [&](const EventRow& event) {
    return event.what == "stopped" && event.walk == static_cast<int>(walk) &&
           event.half_step == static_cast<int>(begun);
  });
}

}  // namespace

EpisodeWalks CheckEpisodeWalks(const EpisodeText& episode, const EpisodeWalkFrame& frame,
                               Findings* findings) {
  EpisodeWalks all;
  if (episode.plans.size() != episode.walks.size()) {
    findings->Disagree(Formatted("plans.csv: %zu walks, manifest.json has %zu",
                                 episode.plans.size(), episode.walks.size()));
    return all;
  }
  long half_steps = 0;
  for (size_t k = 0; k < episode.walks.size(); ++k) {
    const EpisodeWalkText& text = episode.walks[k];
    const PlanRow& plan = episode.plans[k];
    const std::string line = Formatted("plans.csv:%zu: ", k + 2);
    if (k == 0 ? plan.handed_over != 0 : !(plan.handed_over > episode.plans[k - 1].handed_over)) {
      findings->Disagree(line + "the walks are not handed over in order, the first at 0");
    }
    const std::string folder = FolderOfWalk(k);
    const WalkPlan planned = PlanOf(text.footsteps, frame, folder + "/footsteps.csv", findings);
    if (planned.half_steps.empty() || !CheckHalfSteps(text, planned, folder, findings)) {
      return all;
    }
    try {
      if (LevelTops(frame.scene).even()) {
        all.walks.emplace_back(frame.robot, planned, text.half_steps);
      } else {
        all.walks.emplace_back(frame.robot, planned, text.half_steps, frame.scene.ground->Floor());
      }
    } catch (const std::logic_error& error) {
      findings->Disagree(folder + "/half_steps.csv: describes no walk: " + error.what());
      return all;
    }
    all.planned.push_back(planned);
    if (plan.footsteps != planned.num_steps()) {
      findings->Disagree(line + Formatted("%d footsteps, but %s has %d", plan.footsteps,
                                          folder.c_str(), planned.num_steps()));
    }
    if (!Near(plan.duration, all.walks.back().end())) {
      findings->Disagree(line + Formatted("%.9g s, but the walk of %s lasts %.9g s", plan.duration,
                                          folder.c_str(), all.walks.back().end()));
    }
    half_steps += planned.size();
  }
  findings->Say("walks: " + Count(std::ssize(episode.walks)) + " of " + Count(half_steps) +
                " half-steps in all");
  return all;
}

void CheckSuccessors(const EpisodeText& episode, const EpisodeWalks& all, Findings* findings) {
  const DescribedWalk& last = all.walks.back();
  const size_t begun = episode.begun.size();
  for (size_t k = 1; k < all.walks.size(); ++k) {
    const double t = episode.plans[k].handed_over;
    const std::string file = FolderOfWalk(k) + "/half_steps.csv";
    size_t before = 0;
    while (before < begun && last.WindowOf(static_cast<int>(before)).first < t - kWalkRounding) {
      ++before;
    }
    const size_t older = static_cast<size_t>(all.walks[k - 1].num_half_steps());
    const size_t newer = static_cast<size_t>(all.walks[k].num_half_steps());
    for (size_t i = 0; i < before; ++i) {
      if (i < older && i < newer && SameHalfStep(episode, all, k - 1, k, i)) continue;
      findings->Disagree(file + Formatted(":%zu: half-step %zu had begun before %.9g s, when this "
                                          "walk was handed over, and is changed",
                                          i + 2, i + 1, t));
      break;
    }
    const auto begins_early = [&](size_t walk, size_t size) {
      return before < size &&
             all.walks[walk].WindowOf(static_cast<int>(before)).first < t - kWalkRounding;
    };
    if (begins_early(k, newer)) {
      findings->Disagree(file + Formatted(":%zu: half-step %zu begins before %.9g s, when this "
                                          "walk was handed over",
                                          before + 2, before + 1, t));
    }
    if (begins_early(k - 1, older) && !SaysStopped(episode, k - 1, before)) {
      findings->Disagree(FolderOfWalk(k - 1) +
                         Formatted("/half_steps.csv:%zu: half-step %zu begins before the next walk "
                                   "was handed over, and neither begun.csv nor a stop in "
                                   "events.csv says what became of it",
                                   before + 2, before + 1));
    }
  }
}

}  // namespace halfstep::verify
