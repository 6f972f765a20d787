#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "experiments/compare/comparison_tables.h"
#include "experiments/tables/ending_words.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

std::string Left(const std::string& text, size_t width) {
  return text + std::string(width - std::min(width, text.size()) + 2, ' ');
}

std::string Seconds(const std::optional<RuntimeToTarget>& work) {
  return work ? Formatted("%9.3f s", work->wall) : Formatted("%11s", "never");
}

std::string Mean(double value, const char* format) {
  return std::isnan(value) ? Formatted("%11s", "-") : Formatted(format, value);
}

// `overlaps+heights+…`; where all are there that `all_families` adds, "every family".
std::string VariableWords(const std::string& variables) {
  constexpr int kDefaultFamilies = 11;
  constexpr std::string_view kFootsteps = "+footsteps";
  const size_t footsteps = variables.find(kFootsteps);
  const bool moved = footsteps != std::string::npos;
  if (std::ranges::count(variables, '+') + 1 - (moved ? 1 : 0) < kDefaultFamilies) return variables;
  return moved ? "every family, footsteps" : "every family";
}

// Wide enough for every method: its name, its variables.
struct Widths {
  size_t name = 6, variables = 9, status = 6;
};

Widths WidthsOf(const Comparison& comparison) {
  Widths widths;
  for (const ComparedCase& one : comparison.cases) {
    for (const ComparedMethod& method : one.methods) {
      widths.name = std::max(widths.name, method.record.name.size());
      widths.variables = std::max(widths.variables, VariableWords(method.record.variables).size());
      widths.status = std::max(widths.status, Name(method.record.ending).size());
    }
  }
  return widths;
}

std::string CaseTable(const ComparedCase& one, const Widths& widths) {
  std::string text =
      one.scenario + ", " + one.objective + Formatted(", %d half-steps", one.half_steps);
  text += one.best_cost
              ? Formatted("; best certified: cost %.4f by ", *one.best_cost) + one.best_method
              : "; no method has a certified walk of its own";
  text += "\n\n" + Left("method", widths.name) + Left("variables", widths.variables) +
          Left("status", widths.status) +
          Formatted("%-9s %10s %8s %9s %11s %11s %11s %11s %11s\n", "certified", "duration",
                    "speed-up", "gap", "cost", "effort", "wall time", "to 5 %", "to 1 %");
  for (const ComparedMethod& method : one.methods) {
    const MethodRecord& record = method.record;
    text += Left(record.name, widths.name) +
            Left(record.raw() ? "-" : VariableWords(record.variables), widths.variables) +
            Left(std::string(Name(record.ending)), widths.status) +
            Formatted("%-9s %8.3f s %7.2fx ", record.certified ? "yes" : "no", record.duration,
                      record.speedup);
    text += std::isfinite(method.gap) ? Formatted("%7.2f %% ", 100.0 * method.gap)
                                      : Formatted("%9s ", "-");
    text += std::isnan(method.gap) ? Formatted("%11s ", "-") : Formatted("%11.4f ", record.cost);
    text += Formatted("%11.3f %9.3f s ", record.effort, record.wall);
    text += record.raw() ? Formatted("%11s %11s", "-", "-")
                         : Seconds(method.reached[1]) + " " + Seconds(method.reached[0]);
    const std::string words(NotRepeatable(record.ending, record.message));
    text += words.empty() ? "\n" : "  (" + words + ")\n";
  }
  return text + "\n";
}

// What the certificates of the cases do not speak of, cases of which that is the same together.
std::string NotCoveredOfCases(const Comparison& comparison) {
  std::vector<std::pair<const std::vector<NotCovered>*, std::string>> lists;
  for (const ComparedCase& one : comparison.cases) {
    const auto same = std::ranges::find_if(
        lists, [&one](const auto& list) { return *list.first == one.not_covered; });
    if (same == lists.end()) {
      lists.emplace_back(&one.not_covered, one.scenario);
    } else {
      same->second += ", " + one.scenario;
    }
  }
  std::string text;
  for (const auto& [list, scenarios] : lists) {
    if (list->empty()) continue;
    text +=
        scenarios + ":\n" + NotCoveredText(*list, "not_covered in certificate.json", "  ") + "\n";
  }
  return text;
}

}  // namespace

std::string ComparisonScreen(const Comparison& comparison) {
  const Widths widths = WidthsOf(comparison);
  std::string text;
  for (const ComparedCase& one : comparison.cases) text += CaseTable(one, widths);
  text += NotCoveredOfCases(comparison);
  const std::vector<MethodMeans> means = Means(comparison);
  if (means.empty()) return text;
  text += Formatted(
              "cases: %zu; shifted geometric means, a failure as ten times the slowest success\n\n",
              comparison.cases.size()) +
          Left("method", widths.name) + Left("variables", widths.variables) + Left("objective", 9) +
          Formatted("%5s %8s %9s %6s %8s %8s %8s %8s %11s %11s %11s\n", "cases", "missing",
                    "certified", "failed", "ended", "in 5 %", "in 1 %", "speed-up", "to its end",
                    "to 5 %", "to 1 %");
  for (const MethodMeans& mean : means) {
    text +=
        Left(mean.method.name, widths.name) +
        Left(VariableWords(mean.method.variables), widths.variables) +
        Left(mean.method.objective, 9) +
        Formatted("%5d %8d %9d %6d %8d %8d %8d %7.2fx", mean.cases, mean.missing, mean.certified,
                  mean.failed(), mean.solved[2], mean.solved[1], mean.solved[0], mean.speedup);
    for (size_t target : {2, 1, 0}) text += " " + Mean(mean.work[target].wall, "%9.3f s");
    text += "\n";
  }
  return text;
}

}  // namespace halfstep
