#include "experiments/plot/page_size.h"

#include <utility>

#include "experiments/plot/figure.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep::plot {

double PointsOf(const std::string& option, const std::string& text) {
  constexpr double kLeast = 1.0, kMost = 20.0;  // [in]
  for (const auto& [unit, inches] :
       {std::pair{"in", 1.0}, std::pair{"cm", 1.0 / 2.54}, std::pair{"mm", 1.0 / 25.4}}) {
    if (!text.ends_with(unit)) continue;
    const NumberText number = ParseNumber(text.substr(0, text.size() - 2));
    if (number.kind != NumberText::Kind::kNumber) break;
    if (number.value * inches < kLeast || number.value * inches > kMost) {
      throw InputError({option + ": " + Quote(text) + " (valid: 1in … 20in)"});
    }
    return number.value * inches * kPointsPerInch;
  }
  throw InputError({option + ": " + Quote(text) + " is no length (valid: 3.5in, 8.9cm, 89mm)"});
}

}  // namespace halfstep::plot
