#pragma once

#include <sstream>
#include <string>

namespace halfstep {

/// The part of a config with a straight walk of 40 footsteps on an empty floor, rows of its
/// trajectory every 0.2 s.
inline std::string LongWalk() {
  std::ostringstream yaml;
  yaml << "robot: hrp2\nscene: none\noutput: {period_s: 0.2}\nfootsteps:\n";
  for (int i = 1; i <= 40; ++i) {
    const bool left = i % 2 == 0;
    yaml << "  - {foot: " << (left ? "left" : "right") << ", x_m: " << 0.1 * i
         << ", y_m: " << (left ? 0.105 : -0.105) << "}\n";
  }
  return yaml.str();
}

}  // namespace halfstep
