#include "experiments/run/run_screen.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "experiments/run/margin_words.h"
#include "experiments/run/tube_words.h"
#include "experiments/tables/answer_words.h"
#include "experiments/tables/ending_words.h"
#include "experiments/tables/not_covered_json.h"
#include "smoothing/margins/not_covered_by.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "wpg/files/plain_locale.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

const Margin& Of(const MethodRun& run, MarginFamily family) { return Nth(run.margins, family); }

// What refused a larger overlap: "clearance of RLEG_LINK5 - bar". It may have been refused because
// the proof could not decide, which is no violation.
std::string HolderWords(const MarginEvaluator& evaluator, const Margin& margin) {
  return std::string(Name(margin.family)) + " of " + evaluator.Subject(margin) +
         (std::isnan(margin.value) ? ", undecided" : "");
}

// "11 up_down overlaps: 0.412 s on average of 0.950 s, limited by clearance of RLEG_LINK5 - bar (2)
// …"
std::string Holders(const MarginEvaluator& evaluator, const MethodRun& run, JunctionKind kind) {
  std::map<std::string, int> holders;
  double overlap = 0.0, bound = 0.0;
  int count = 0;
  for (const JunctionResult& junction : run.result.junctions) {
    if (junction.kind != kind) continue;
    ++count;
    overlap += junction.overlap;
    bound += junction.upper_bound;
    const std::string what = junction.limited_by     ? HolderWords(evaluator, *junction.limited_by)
                             : junction.fixed        ? "smoothing.fixed"
                             : run.method == "given" ? "what was given"
                             : junction.overlap < junction.upper_bound - 1e-9
                                 ? "the balance of the program"
                                 : "the upper bound";
    ++holders[what];
  }
  if (count == 0) return "";
  std::string text = Formatted("  %s: %d overlap%s, mean %.3f s of %.3f s, limited by ",
                               kind == JunctionKind::kUpDown ? "up→down" : "down→up", count,
                               count == 1 ? "" : "s", overlap / count, bound / count);
  std::string separator;
  for (const auto& [what, times] : holders) {
    text += separator + what + Formatted(" (%d)", times);
    separator = ", ";
  }
  return text + "\n";
}

// What a price says of one unit of the family's scale, or of all that is demanded where that is
// less: to first order, and no more than the overlap has room.
std::string Promise(const MarginLimits& limits, const JunctionResult& junction) {
  const MarginFamily family = junction.limited_by->family;
  const double demanded = limits.demanded_of(family);
  const double less = demanded > 0.0 ? std::min(Scale(family), demanded) : Scale(family);
  const double part = less / Scale(family);
  const double room = std::max(0.0, junction.upper_bound - junction.overlap);
  std::string text =
      Amount(less, Unit(family)) + Formatted(" %s would save %.2g s",
                                             demanded > 0.0 ? "less demanded" : "beyond its limit",
                                             std::min(part * *junction.price, room));
  if (junction.multiplier && std::isnan(*junction.multiplier)) {
    text +=
        "; with all parameters adapting it is not determined: the program's rows there hardly "
        "depend on them";
  } else if (junction.multiplier && *junction.multiplier > 0.0) {
    text += Formatted(" (%.2g s with all parameters adapting)", part * *junction.multiplier);
  }
  return text;
}

// The junctions where a little less demanded would save most: "junction 5 (up→down), 0.612 s …".
std::string Prices(const MarginEvaluator& evaluator, const MethodRun& run) {
  constexpr size_t kMost = 3;
  std::vector<std::pair<double, size_t>> dearest;
  for (size_t j = 0; j < run.result.junctions.size(); ++j) {
    if (run.result.junctions[j].price) dearest.push_back({-*run.result.junctions[j].price, j});
  }
  std::sort(dearest.begin(), dearest.end());
  std::string text;
  for (size_t k = 0; k < std::min(kMost, dearest.size()); ++k) {
    const JunctionResult& junction = run.result.junctions[dearest[k].second];
    const Margin& limit = *junction.limited_by;
    text += Formatted("  junction %zu (%s), %.3f s: ", dearest[k].second + 1,
                      junction.kind == JunctionKind::kUpDown ? "up→down" : "down→up",
                      junction.overlap) +
            HolderWords(evaluator, limit) +
            Formatted(" at half-step %d, τ = %.2f s; ", limit.at.half_step + 1, limit.at.tau) +
            Promise(evaluator.limits(), junction);
    text += "\n";
  }
  return text;
}

std::vector<NotCovered> ListOf(const MarginEvaluator& evaluator) {
  return NotCoveredBy(evaluator.robot(), evaluator.scene(), evaluator.limits());
}

bool IsUndecided(const MethodRun& run) {
  return run.certified.answer.verdict == Verdict::kUndecided;
}

// The least clearance at the rows of trajectory.csv, unless the proof could not decide it between.
std::string ClearanceCell(const MarginEvaluator& evaluator, const MethodRun& run) {
  const Margin& clearance = Of(run, MarginFamily::kClearance);
  if (IsUndecided(run) && run.certified.answer.witness.family == MarginFamily::kClearance) {
    return Formatted("%10s", "undecided");
  }
  if (!std::isfinite(clearance.value)) return Formatted("%10s", "-");
  return clearance.other < 0 ? Formatted("   > %2.0f cm", 100.0 * evaluator.limits().clearance_cap)
                             : Formatted("%7.1f cm", 100.0 * clearance.value);
}

std::string WorstCell(const MarginEvaluator& evaluator, const MethodRun& run) {
  const Margin& worst = WorstOf(run.margins, evaluator.limits());
  const std::string name(Name(worst.family));
  if (!std::isfinite(worst.value)) return name + " cannot be told";
  const bool same = worst.family == run.certified.answer.witness.family;
  if (IsUndecided(run) && same) return name + " undecided";
  return name + " " + Amount(worst.value, Unit(worst.family));
}

std::string_view NotRepeatable(const MethodRun& run) {
  return halfstep::NotRepeatable(run.result.ending, run.result.message);
}

// At the end of a method's row: " (ended by the clock, not repeatable)".
std::string ClockCell(const MethodRun& run) {
  const std::string words(NotRepeatable(run));
  return words.empty() ? "" : " (" + words + ")";
}

// How the walks went on simulated robots.
std::string Replays(const std::vector<MethodRun>& runs) {
  std::string text = "\nsimulated, which proves nothing (experiments/replay.md):\n";
  for (const MethodRun& run : runs) {
    const std::optional<WalkReplay>& replay = run.replay;
    text += Formatted("  %-22s ", run.method.c_str());
    if (!replay) {
      text += "not replayed\n";
      continue;
    }
    const bool falls = replay->stands < replay->seeds;
    text += falls ? Formatted("falls in %d of %d", replay->seeds - replay->stands, replay->seeds)
                  : "stands in " + replay->Standing();
    text += Formatted(", median tilt %.1f deg\n", replay->median_tilt * 180 / std::numbers::pi);
  }
  return text;
}

// Rows of a Pareto curve.
std::string Curve(const MethodRun& run) {
  std::string text;
  for (const ParetoPoint& point : run.result.pareto) {
    text += Formatted("  %8.3f s: every margin at least %.2f of its scale inside\n", point.duration,
                      point.least_slack);
  }
  return text;
}

}  // namespace

std::string RunTable(const Experiment& experiment, const WalkProblem& problem,
                     const std::vector<MethodRun>& runs, const RunPlaces& places) {
  const MarginEvaluator& evaluator = problem.evaluator();
  PlainStream out;
  out << experiment.config.name << ": " << experiment.robot.name << ", "
      << experiment.sequence.size() << " half-steps, " << experiment.scene.obstacles.size()
      << (experiment.scene.obstacles.size() == 1 ? " obstacle" : " obstacles")
      << "; feasible means " << problem.test().Description() << "\n"
      << TubeWords(evaluator) << "\n";
  out << Formatted("%-22s %-16s %-10s %10s %8s %9s %10s %s\n", "method", "status", "for all t",
                   "duration", "speed-up", "low apex", "clearance", "worst margin");
  for (const MethodRun& run : runs) {
    out << Formatted("%-22s %-16s %-10s %8.3f s %7.2fx %6.1f cm ", run.method.c_str(),
                     std::string(Name(run.result.ending)).c_str(),
                     std::string(VerdictName(run.certified.answer.verdict)).c_str(), run.duration,
                     runs.front().duration / run.duration, 100.0 * run.lowest_apex)
        << ClearanceCell(evaluator, run) << " " << WorstCell(evaluator, run) << ClockCell(run)
        << "\n";
  }
  if (experiment.config.has_replay) out << Replays(runs);
  for (const MethodRun& run : runs) {
    if (!IsUndecided(run)) continue;
    out << "\n"
        << run.method << ": undecided: "
        << AnswerWords(evaluator, experiment.config.smoothing.certification, run.certified.answer)
        << "\n";
  }
  for (const MethodRun& run : runs) {
    // What the planned motion misses is told before this table.
    if (!runs.front().result.feasible && run.result.parameters == runs.front().result.parameters) {
      continue;
    }
    if (!HasOwnResult(run.result.ending)) {
      out << "\n"
          << run.method << ": " << Name(run.result.ending) << ": " << run.result.message << "\n";
      continue;  // what follows would be about another method's walk
    }
    if (run.result.junctions.empty()) continue;
    out << "\n"
        << run.method
        << Formatted(" (effort %.2f, %.2f s)\n", run.result.work.effort(), run.result.wall)
        << Holders(evaluator, run, JunctionKind::kUpDown)
        << Holders(evaluator, run, JunctionKind::kDownUp) << Prices(evaluator, run) << Curve(run)
        << "  " << run.result.message << "\n";
  }
  out << "\n" << NotCoveredText(ListOf(evaluator), places.not_covered);
  out << "\nwritten: " << places.folder << "\n";
  return out.str();
}

std::string RunJson(const Experiment& experiment, const WalkProblem& problem,
                    const std::vector<MethodRun>& runs,
                    const std::vector<InfeasibleWalk>& infeasible, const std::string& folder) {
  const MarginEvaluator& evaluator = problem.evaluator();
  nlohmann::ordered_json json = {{"folder", folder},
                                 {"not_covered", NotCoveredJson(ListOf(evaluator))}};
  for (const MethodRun& run : runs) {
    const Margin& worst = WorstOf(run.margins, evaluator.limits());
    json["methods"].push_back({{"method", run.method},
                               {"status", Name(run.result.ending)},
                               {"message", run.result.message},
                               {"repeatable", NotRepeatable(run).empty()},
                               {"effort", run.result.work.effort()},
                               {"judged_by", Name(run.result.evidence)},
                               {"verdict", VerdictName(run.certified.answer.verdict)},
                               {"duration_s", run.duration},
                               {"speedup", runs.front().duration / run.duration},
                               {"lowest_apex_m", run.lowest_apex},
                               {"worst_margin", worst.value},
                               {"worst_margin_name", Name(worst.family)}});
    if (run.replay) {
      json["methods"].back()["replay"] = {{"stands", run.replay->Standing()},
                                          {"median_tilt_rad", run.replay->median_tilt}};
    }
    if (IsUndecided(run)) {
      json["methods"].back()["undecided"] =
          AnswerWords(evaluator, experiment.config.smoothing.certification, run.certified.answer);
    }
  }
  for (const InfeasibleWalk& walk : infeasible) {
    json["infeasible"][walk.method] = InfeasibleJson(problem, walk);
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
