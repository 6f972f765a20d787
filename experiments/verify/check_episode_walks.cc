#include "experiments/verify/check_episode_walks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/verify/check_overlaps.h"
#include "experiments/verify/level_tops.h"
#include "wpg/nth.h"

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

// Where the soles stand before half-step `first`, which begins a step.
std::array<Foothold, 2> StanceBefore(const WalkPlan& plan, int first) {
  if (first == 0) return plan.start;
  const auto& [down, X_WS, rest] = Nth(plan.half_steps, first - 1);
  std::array<Foothold, 2> feet;
  Nth(feet, Index(down.support)) = X_WS;
  Nth(feet, Index(down.swing())) = X_WS * down.X_SF;
  return feet;
}

// The plan of footsteps.csv from where the soles stand at `start`; of no half-steps when it is
// none.
WalkPlan PlanOf(const EpisodeWalkText& text, const std::array<Foothold, 2>& start,
                const EpisodeWalkFrame& frame, const std::string& path, Findings* findings) {
  const std::vector<FootstepRow>& rows = text.footsteps;
  WalkPlan none{.start = start, .half_steps = {}};
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
    } else if (static_cast<size_t>(Index(side)) != i || !Near(row.X_WF, start[i].Planar()) ||
               (!ground.even() && !Near(row.z, start[i].height))) {
      findings->Disagree(line + (text.first == 0
                                     ? "the walk does not start where config.yaml says"
                                     : "the foot does not stand there in the walk before it"));
    } else if (!Near(row.via_height, 0) || !Near(row.duration, 0)) {
      findings->Disagree(line + "no step leads to a foot that stands at the start");
    }
  }
  return PlanOf(start, footsteps, frame.half_step);
}

// Whether the rows of half_steps.csv make a walk of the half-steps, `before` those of the walk
// before it.
bool CheckHalfSteps(const EpisodeWalkText& text, const WalkPlan& planned,
                    const std::vector<HalfStepRow>& before, const std::string& folder,
                    Findings* findings) {
  const std::vector<HalfStepRow>& rows = text.half_steps;
  const std::string path = folder + "/half_steps.csv";
  if (rows.size() != planned.half_steps.size()) {
    findings->Disagree(path + Formatted(": %zu half-steps, the footsteps make %zu", rows.size(),
                                        planned.half_steps.size()));
    return false;
  }
  const size_t joined = text.first > 0 ? 1 : 0;  // overlaps before the first row
  if (text.overlaps.size() + 1 != rows.size() + joined) {
    findings->Disagree(folder + Formatted("/overlaps.csv: %zu overlaps of %zu half-steps",
                                          text.overlaps.size(), rows.size()));
    return false;
  }
  Faults faults;
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::string line = path + Formatted(":%zu: ", i + 2);
    const HalfStep& half_step = planned.half_steps[i].half_step;
    std::string fault = FaultOfHalfStep(rows[i], half_step);
    const bool begins = i + joined == 0;
    if (fault.empty() && begins && !Near(rows[0].start, 0)) fault = "the walk does not begin at 0";
    if (fault.empty() && i % 2 == 1) fault = FaultOfStep(rows[i - 1], rows[i]);
    if (fault.empty() && !begins) {
      const HalfStepRow& last = i > 0 ? rows[i - 1] : Nth(before, text.first - 1);
      const double overlap = last.start + last.duration - rows[i].start;
      fault = FaultOfOverlap(overlap, last, rows[i], half_step);
      if (fault.empty() && !Near(overlap, text.overlaps[i + joined - 1])) {
        fault = Formatted("overlap %.9g by starts and durations, %.9g in overlaps.csv", overlap,
                          text.overlaps[i + joined - 1]);
      }
    }
    if (fault.empty() && rows[i].FormOf(half_step).footstep != Pose2{}) {
      fault = "a footstep that is moved, which no walk of an episode has";
    }
    if (!fault.empty()) faults.Add(line + fault);
  }
  const long found = findings->disagreements();
  faults.Conclude(findings);
  return findings->disagreements() == found;
}

bool NearForms(const FormColumns& a, const FormColumns& b) {
  return std::ranges::all_of(
      kFormColumns, [&](const FormColumn& one) { return Near(a.*one.value, b.*one.value); });
}

// A walk as it is known so far: what a walk is before its part is that of the walk before it.
struct WholeWalk {
  WalkPlan planned;
  std::vector<HalfStepRow> rows;

  size_t size() const { return rows.size(); }
  // Puts the part of a walk in place of what is there from its first half-step on.
  void Join(const EpisodeWalkText& text, const WalkPlan& part) {
    const auto first = static_cast<size_t>(text.first);
    if (first == 0) planned.start = part.start;
    planned.half_steps.resize(first);
    rows.resize(first);
    planned.half_steps.insert(planned.half_steps.end(), part.half_steps.begin(),
                              part.half_steps.end());
    rows.insert(rows.end(), text.half_steps.begin(), text.half_steps.end());
  }
};

// Whether two half-steps are the same.
bool SameHalfStep(const HalfStepRow& x, const PlacedHalfStep& of_x, const HalfStepRow& y,
                  const PlacedHalfStep& of_y) {
  const auto& [p, X_WS, p_rest] = of_x;
  const auto& [q, Y_WS, q_rest] = of_y;
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

// The part of a walk, checked; of no half-steps when it is none.
WalkPlan CheckPart(const EpisodeText& episode, size_t k, const WholeWalk& before,
                   const EpisodeWalkFrame& frame, Findings* findings) {
  const EpisodeWalkText& text = episode.walks[k];
  const std::string folder = FolderOfWalk(k);
  if (text.first % 2 != 0 || text.first > static_cast<int>(before.size())) {
    findings->Disagree(folder + Formatted("/half_steps.csv: begins with half-step %d, where no "
                                          "step of the walk before it begins or ends",
                                          text.first + 1));
    return {};
  }
  const std::array<Foothold, 2> start =
      text.first == 0 ? frame.start : StanceBefore(before.planned, text.first);
  WalkPlan part = PlanOf(text, start, frame, folder + "/footsteps.csv", findings);
  if (part.half_steps.empty() || !CheckHalfSteps(text, part, before.rows, folder, findings)) {
    return {};
  }
  try {
    (void)DescribedWalk::PiecesOf(frame.robot, part, text.half_steps);
  } catch (const std::logic_error& error) {
    findings->Disagree(folder + "/half_steps.csv: describes no walk: " + error.what());
    return {};
  }
  return part;
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
  WholeWalk whole;
  for (size_t k = 0; k < episode.walks.size(); ++k) {
    const PlanRow& plan = episode.plans[k];
    const std::string line = Formatted("plans.csv:%zu: ", k + 2);
    if (k == 0 ? plan.handed_over != 0 : !(plan.handed_over > episode.plans[k - 1].handed_over)) {
      findings->Disagree(line + "the walks are not handed over in order, the first at 0");
    }
    all.parts.push_back(CheckPart(episode, k, whole, frame, findings));
    if (all.parts.back().half_steps.empty()) return all;
    whole.Join(episode.walks[k], all.parts.back());
    all.sizes.push_back(static_cast<int>(whole.size()));
    const int steps = whole.planned.num_steps();
    const double end = whole.rows.back().start + whole.rows.back().duration;
    const std::string folder = FolderOfWalk(k);
    if (plan.footsteps != steps) {
      findings->Disagree(
          line + Formatted("%d footsteps, but %s has %d", plan.footsteps, folder.c_str(), steps));
    }
    if (!Near(plan.duration, end)) {
      findings->Disagree(line + Formatted("%.9g s, but the walk of %s lasts %.9g s", plan.duration,
                                          folder.c_str(), end));
    }
    half_steps += std::ssize(episode.walks[k].half_steps);
  }
  all.planned = std::move(whole.planned);
  try {
    if (LevelTops(frame.scene).even()) {
      all.last.emplace(frame.robot, all.planned, whole.rows);
    } else {
      all.last.emplace(frame.robot, all.planned, whole.rows, frame.scene.ground->Floor());
    }
  } catch (const std::logic_error& error) {
    findings->Disagree(std::string("walks: the last one is none: ") + error.what());
    return all;
  }
  findings->Say("walks: " + Count(std::ssize(episode.walks)) + ", with " + Count(half_steps) +
                " half-steps that changed");
  return all;
}

void CheckSuccessors(const EpisodeText& episode, const EpisodeWalks& all, Findings* findings) {
  const size_t begun = episode.begun.size();
  WholeWalk whole;
  whole.Join(episode.walks[0], all.parts[0]);
  for (size_t k = 1, before = 0; k < episode.walks.size(); ++k) {
    const EpisodeWalkText& text = episode.walks[k];
    const double t = episode.plans[k].handed_over;
    const std::string file = FolderOfWalk(k) + "/half_steps.csv";
    // So many half-steps began before it was handed over, by the last walk.
    const auto began = [&](size_t i) {
      return all.last->WindowOf(static_cast<int>(i)).first < t - kWalkRounding;
    };
    while (before > 0 && !began(before - 1)) --before;
    while (before < begun && began(before)) ++before;
    const auto first = static_cast<size_t>(text.first);
    // Those before its part are the same as they are not told anew.
    for (size_t i = first; i < before; ++i) {
      const size_t row = i - first;
      const bool same = i < whole.size() && row < text.half_steps.size() &&
                        SameHalfStep(whole.rows[i], whole.planned.half_steps[i],
                                     text.half_steps[row], all.parts[k].half_steps[row]);
      if (same) continue;
      findings->Disagree(file + Formatted(":%zu: half-step %zu had begun before %.9g s, when this "
                                          "walk was handed over, and is changed",
                                          row + 2, i + 1, t));
      break;
    }
    const auto begins_early = [&] {
      return before < whole.size() && whole.rows[before].start < t - kWalkRounding;
    };
    if (begins_early() && !SaysStopped(episode, k - 1, before)) {
      findings->Disagree(FolderOfWalk(k - 1) +
                         Formatted("/half_steps.csv: half-step %zu begins before the next walk was "
                                   "handed over, and neither begun.csv nor a stop in events.csv "
                                   "says what became of it",
                                   before + 1));
    }
    whole.Join(text, all.parts[k]);
    if (begins_early()) {
      findings->Disagree(file + Formatted(": half-step %zu begins before %.9g s, when this walk "
                                          "was handed over",
                                          before + 1, t));
    }
    if (whole.size() < before) {
      findings->Disagree(file + Formatted(": the walk ends with half-step %zu, and %zu had begun",
                                          whole.size(), before));
    }
  }
}

}  // namespace halfstep::verify
