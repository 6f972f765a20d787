#include "experiments/run/margin_words.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "smoothing/margins/family_traits.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// A sentence with what it names in place of the names in braces.
std::string Filled(std::string_view sentence,
                   const std::vector<std::pair<std::string_view, std::string>>& words) {
  std::string text(sentence);
  for (const auto& [name, word] : words) {
    const size_t place = text.find(name);
    if (place != std::string::npos) text.replace(place, name.size(), word);
  }
  return text;
}

// What the value says of distances, else of a limit.
std::string ValueWords(const Margin& margin, const std::string& subject) {
  const FamilyTraits& traits = Traits(margin.family);
  const size_t dash = std::min(subject.find(" - "), subject.size());
  const bool of_two = margin.other >= 0 && !traits.of_two.inside.empty();
  const MarginSentence& sentence = of_two ? traits.of_two : traits.sentence;
  return Filled(margin.value < 0.0 ? sentence.beyond : sentence.inside,
                {{"{family}", std::string(traits.name)},
                 {"{amount}", Amount(std::abs(margin.value), traits.unit)},
                 {"{subject}", subject},
                 {"{first}", subject.substr(0, dash)},
                 {"{second}", dash < subject.size() ? subject.substr(dash + 3) : "something"}});
}

}  // namespace

std::string Amount(double value, std::string_view unit) {
  if (unit == "m" && std::abs(value) < 0.1) {
    const double millimetres = 1e3 * value;
    return Formatted(std::abs(millimetres) < 0.1 && value != 0.0 ? "%.3f mm" : "%.1f mm",
                     millimetres);
  }
  const std::string number = Formatted("%.3g", value);
  return unit == "1" ? number : number + " " + std::string(unit);
}

std::string MissedWords(const MarginEvaluator& evaluator, const Margin& margin) {
  const std::string subject = evaluator.Subject(margin);
  const std::string of = std::string(Name(margin.family)) + " of " + subject;
  if (std::isnan(margin.value)) return of + " could not be decided";
  if (std::isinf(margin.value)) {
    return of + std::string(Traits(margin.family).untold.of_plan);
  }
  std::string words = ValueWords(margin, subject);
  const MarginLimits& limits = evaluator.limits();
  const double raised = Nth(limits.raised, margin.family);
  // Clearances are those of the worst motion, of other families more is demanded.
  const bool of_tube = limits.tube != Tube{} && Traits(margin.family).in_tube != nullptr;
  if (of_tube && raised == 0.0) words += " in the worst of the tube";
  const double demanded = limits.demanded_of(margin.family);
  if (demanded != 0.0) {
    words += "; " + Amount(demanded, Unit(margin.family)) + " demanded";
    if (raised > 0.0) words += ", " + Amount(raised, Unit(margin.family)) + " of it for the tube";
  }
  if (margin.stop_after >= 0) {
    words += Formatted(", if the walk is stopped after half-step %d", margin.stop_after + 1);
  }
  return words;
}

}  // namespace halfstep
