#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "experiments/report/report_page.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/temporary_folder.h"

namespace halfstep {

/// The same files, and beside every CSV its schema.
inline std::set<std::string> WithSchemas(std::set<std::string> files) {
  const std::set<std::string> all = files;
  for (const std::string& file : all) {
    if (file.ends_with(".csv")) {
      files.insert(file.substr(0, file.size() - 4) + ".schema.json");
    }
  }
  return files;
}

/// Files of a run folder whose methods have the folders `methods`.
inline std::set<std::string> RunFiles(const std::vector<std::string>& methods) {
  std::set<std::string> files = {
      "config.yaml",         "footsteps.csv",        "manifest.json",      "summary.csv",
      "raw/certificate.csv", "raw/certificate.json", "raw/half_steps.csv", "raw/trajectory.csv"};
  if (HasReport()) files.insert("report.html");
  for (const std::string& method : methods) {
    for (const std::string file : {"certificate.csv", "certificate.json", "half_steps.csv",
                                   "iterates.csv", "overlaps.csv", "trajectory.csv"}) {
      files.insert(method + "/" + file);
    }
  }
  return WithSchemas(files);
}

/// Checks that a run folder has all its files and that each of them is whole.
inline void CheckRunIsWhole(const std::filesystem::path& run,
                            const std::vector<std::string>& methods) {
  SCOPED_TRACE(run.string());
  ASSERT_TRUE(std::filesystem::is_directory(run));
  std::set<std::string> files = FilesBelow(run);
  // As many as robot and scene have: their hashes are for `verify`.
  EXPECT_GE(
      std::erase_if(files, [](const std::string& file) { return file.starts_with("inputs/"); }),
      2u);
  files.erase("infeasible.json");  // of plans that are not feasible
  EXPECT_EQ(files, RunFiles(methods));
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const std::string text = ReadText(run / file);
    if (file.ends_with(".csv")) {
      EXPECT_NO_THROW(ParsedCsv{text});
    } else if (file.ends_with(".json")) {
      EXPECT_TRUE(nlohmann::json::accept(text));
    } else {
      EXPECT_TRUE(text.ends_with('\n'));
    }
  }
  const ParsedCsv summary(ReadText(run / "summary.csv"));
  ASSERT_EQ(summary.size(), methods.size() + 1);
  for (size_t row = 0; row < summary.size(); ++row) {
    const std::string folder = row == 0 ? "raw" : methods[row - 1];
    const ParsedCsv trajectory(ReadText(run / folder / "trajectory.csv"));
    ASSERT_GT(trajectory.size(), 1u);
    EXPECT_EQ(trajectory.Text(trajectory.size() - 1, "t_s"), summary.Text(row, "duration_s"));
  }
}

}  // namespace halfstep
