#include "experiments/export/message_float.h"

#include "wpg/files/number_text.h"

namespace halfstep {

std::string MessageFloat(double value) {
  std::string text = ShortestText(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  // YAML 1.1 knows an exponent only behind a point.
  const size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) {
    text.insert(exponent, ".0");
  }
  return text;
}

}  // namespace halfstep
