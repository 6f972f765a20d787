#pragma once

#include <gtest/gtest.h>

#include <string>

namespace halfstep {

/// The text with the first `from` replaced; fails the test where there is none.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace halfstep
