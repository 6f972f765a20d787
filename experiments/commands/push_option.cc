#include "experiments/commands/push_option.h"

#include <algorithm>
#include <cmath>

#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// "T,FX,FY,SECONDS" of --push.
replay::Push PushOf(const std::string& text) {
  std::vector<double> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const NumberText number = ParseNumber(text.substr(begin, end - begin));
    const bool good = number.kind == NumberText::Kind::kNumber && std::abs(number.value) <= 1e4;
    numbers.push_back(good ? number.value : std::nan(""));
    begin = end + 1;
  }
  const bool good = numbers.size() == 4 && numbers[0] >= 0.0 && numbers[3] > 0.0 &&
                    numbers[3] <= 10.0 && std::isfinite(numbers[1]) && std::isfinite(numbers[2]);
  if (!good) {
    throw InputError({"--push " + Quote(text) +
                      ": is no push (valid: T,FX,FY,SECONDS with T in s from 0, forces in N up to "
                      "10000, and up to 10 s)"});
  }
  return {.at = numbers[0],
          .duration = numbers[3],
          .impulse_W = numbers[3] * Eigen::Vector3d(numbers[1], numbers[2], 0.0)};
}

}  // namespace

std::vector<replay::Push> PushesOf(const std::vector<std::string>& texts) {
  std::vector<replay::Push> pushes;
  for (const std::string& text : texts) {
    pushes.push_back(PushOf(text));
    if (pushes.size() == 1) continue;
    const replay::Push& before = pushes[pushes.size() - 2];
    if (pushes.back().at >= before.at + before.duration) continue;
    throw InputError({"--push " + Quote(text) +
                      ": begins before the one before it ends (valid: one "
                      "after the other)"});
  }
  return pushes;
}

}  // namespace halfstep
