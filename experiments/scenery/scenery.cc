#include "experiments/scenery/scenery.h"

#include <algorithm>

namespace halfstep {

void Scenery::Tell(const std::string& sentence) {
  if (std::find(told.begin(), told.end(), sentence) == told.end()) told.push_back(sentence);
}

}  // namespace halfstep
