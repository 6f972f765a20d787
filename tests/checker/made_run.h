#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/checker/walk_run.h"
#include "experiments/checker/walk_state.h"
#include "experiments/run/exit_status.h"
#include "experiments/verify/csv_text.h"
#include "tests/experiments/child_process.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep::checker {

/// A run by the dichotomy.
struct MadeRun {
  explicit MadeRun(const std::string& config, const std::string& scene = "",
                   const std::string& smoothing = "") {
    WriteText(place / "scene.yaml", scene);
    WriteText(place / "config.yaml", config + "smoothing:\n  methods: [dichotomy]\n" + smoothing);
    const Outcome made = Halfstep(place.path(), {"run", "config.yaml", "--out", "made", "--quiet"});
    if (made.status != kSuccess) throw std::runtime_error(made.err);
    walk = ReadWalkRun((place / "made").string(), "dichotomy");
  }
  TrajectoryCheck Check() const { return CheckRun(walk); }

  TemporaryFolder place;
  WalkRun walk;
};

/// A walk at instants and on intervals.
struct Moving {
  explicit Moving(const WalkRun& of)
      : walk(of),
        motion(of.tables),
        solvers{LegSolver(of.robot.legs[0]), LegSolver(of.robot.legs[1])} {
    FollowLegs(of.robot, motion, Height(), motion.knots(), &solvers);
  }
  Interval Height() const { return Interval(walk.robot.waist_height) - Interval(walk.crouch); }
  WalkState On(double from, double to) const {
    return {walk.robot, solvers, motion, Height(), from, to};
  }

  const WalkRun& walk;
  WalkMotion motion;
  std::array<LegSolver, 2> solvers;
};

/// Whether both may hold one number.
inline bool Holds(const Interval& wide, const Interval& narrow) {
  return wide.lo <= narrow.hi && wide.hi >= narrow.lo;
}

/// Findings that are not proved.
inline std::vector<const TrajectoryFinding*> Missed(const TrajectoryCheck& check) {
  std::vector<const TrajectoryFinding*> missed;
  for (const TrajectoryFinding& finding : check.findings) {
    if (!finding.proved) missed.push_back(&finding);
  }
  return missed;
}

/// The columns of a run's trajectory.csv at its rows.
class Rows {
 public:
  explicit Rows(const MadeRun& run) {
    const std::string text =
        verify::ReadBytes((run.place / "made/dichotomy/trajectory.csv").string());
    std::string head = text.substr(0, text.find('\n'));
    for (size_t at = 0; at <= head.size();) {
      const size_t comma = std::min(head.find(',', at), head.size());
      header_.push_back(head.substr(at, comma - at));
      at = comma + 1;
    }
    table_.emplace("trajectory.csv", text, header_);
  }
  size_t size() const { return table_->size(); }
  double At(size_t row, const std::string& column) const {
    const auto at = std::ranges::find(header_, column) - header_.begin();
    return table_->Number(row, static_cast<size_t>(at));
  }

 private:
  std::vector<std::string> header_;
  std::optional<verify::CsvText> table_;
};

/// The least of a family in all rows is found: what is demanded 10⁻⁶ above it is not proved, what
/// is demanded `room` below it is.
struct FoundLimit {
  verify::Family family;
  const char* column;
  double room;
};
inline void ExpectFound(const MadeRun& run, const FoundLimit& limit) {
  const Rows rows(run);
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < rows.size(); ++i) least = std::min(least, rows.At(i, limit.column));
  WalkRun walk = run.walk;
  walk.certificate.demanded.fill(verify::kNotDemanded);
  double& demanded = walk.certificate.demanded[static_cast<size_t>(limit.family)];
  demanded = least + 1e-6;
  EXPECT_FALSE(CheckRun(walk).proved()) << limit.column;
  demanded = least - limit.room;
  EXPECT_TRUE(CheckRun(walk).proved()) << limit.column;
}

}  // namespace halfstep::checker
