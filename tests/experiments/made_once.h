#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/run/exit_status.h"
#include "tests/experiments/child_process.h"
#include "tests/temporary_folder.h"

namespace halfstep {

/// Copies into `place` what `halfstep arguments` writes in an empty folder. The command, which must
/// succeed, runs once a process for the same arguments: what tests of a suite only read, or change
/// in their own copies, is made once.
inline void CopyMadeOnce(const std::filesystem::path& place,
                         const std::vector<std::string>& arguments) {
  static std::map<std::vector<std::string>, TemporaryFolder> folders;
  const auto [at, is_new] = folders.try_emplace(arguments);
  const std::filesystem::path& made = at->second.path();
  if (is_new) {
    const Outcome outcome = Halfstep(made, arguments);
    ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  }
  std::filesystem::copy(made, place, std::filesystem::copy_options::recursive);
}

}  // namespace halfstep
