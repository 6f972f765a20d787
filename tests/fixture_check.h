#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "tests/places.h"
#include "wpg/files/input_error.h"

namespace halfstep {

/// Files tests/fixtures/<folder>/*.yaml, sorted: bad inputs, for INSTANTIATE_TEST_SUITE_P. Each
/// begins with one line "# expect: <part of the message>" for every complaint that it must cause.
inline std::vector<std::string> Fixtures(const std::string& folder) {
  const auto path = std::filesystem::path(InSources("tests/fixtures")) / folder;
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Name of a fixture's test: its file name without extension.
inline std::string FixtureName(const testing::TestParamInfo<std::string>& fixture) {
  return std::filesystem::path(fixture.param).stem().string();
}

/// Checks that `load(path)` throws InputError with exactly the complaints expected, in this order,
/// each with its place "path:line:column: " in front.
inline void CheckFixture(const std::string& path,
                         const std::function<void(const std::string&)>& load) {
  const std::string mark = "# expect: ";
  std::vector<std::string> expected;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.starts_with(mark);) {
    expected.push_back(line.substr(mark.size()));
  }
  ASSERT_FALSE(expected.empty()) << path << " does not begin with '" << mark << "'";
  try {
    load(path);
  } catch (const InputError& error) {
    ASSERT_EQ(error.complaints().size(), expected.size()) << error.what();
    for (size_t i = 0; i < expected.size(); ++i) {
      const std::string& complaint = error.complaints()[i];
      EXPECT_THAT(complaint, testing::HasSubstr(expected[i]));
      ASSERT_TRUE(complaint.starts_with(path)) << complaint;
      EXPECT_THAT(complaint.substr(path.size()), testing::ContainsRegex("^:[0-9]+:[0-9]+: "));
    }
    return;
  }
  ADD_FAILURE() << path << " was accepted";
}

}  // namespace halfstep
