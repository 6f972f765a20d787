#pragma once

#include <string>

namespace halfstep {

/// `text`, so many times.
inline std::string Repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace halfstep
