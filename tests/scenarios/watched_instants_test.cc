#include "smoothing/program/watched_instants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/scenarios/load_experiment.h"
#include "tests/scenarios/row_slopes.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

class WatchedInstantsTest : public testing::Test {
 protected:
  // Overlaps about where smoothing ends, everything else about as planned.
  Eigen::VectorXd Draw(WalkDraw* draw) const { return Draw(variables_, draw); }
  Eigen::VectorXd Draw(const OverlapVariables& variables, WalkDraw* draw) const {
    Eigen::VectorXd x(variables.size());
    const HomotopyParameters planned = PlannedMotion(e_.sequence);
    for (int v = 0; v < variables.size(); ++v) {
      const HomotopyParameter& p = variables.at(v);
      switch (p.family) {
        case ParameterFamily::kOverlap:
          x[v] = draw->Uniform(0.6, 0.95);
          break;
        case ParameterFamily::kHeightScale:
        case ParameterFamily::kLiftShare:
          x[v] = draw->Uniform(0.7, 1.0);
          break;
        case ParameterFamily::kSupportPoint:
          x[v] = draw->Uniform(-0.01, 0.02);
          break;
        case ParameterFamily::kFootDelay:
          x[v] = draw->Uniform(0.12, 0.19);
          break;
        case ParameterFamily::kFootRamp:
          x[v] = draw->Uniform(0.35, 0.48);
          break;
        case ParameterFamily::kViaAlong:
          x[v] = draw->Uniform(-0.01, 0.01);
          break;
        case ParameterFamily::kZmpShift:
          x[v] = draw->Uniform(0.03, 0.08);
          break;
        case ParameterFamily::kZmpBumpRamp:
          x[v] = draw->Uniform(0.6, 0.98);
          break;
        // Soles that stand parallel are at a kink of their distance.
        case ParameterFamily::kFootstepX:
        case ParameterFamily::kFootstepY:
          x[v] = draw->Uniform(-0.01, 0.01);
          break;
        case ParameterFamily::kFootstepYaw:
          x[v] = draw->Uniform(-0.08, 0.08);
          break;
        default:
          x[v] = draw->Uniform(0.9, 1.1) * p.in(planned);
      }
    }
    return x;
  }

  // The Jacobian of `table`, of these variables, against differences of its rows.
  void ExpectSlopes(const WatchedInstants& table, const OverlapVariables& variables,
                    unsigned seed) const {
    WalkDraw draw(seed);
    int compared = 0, kinks = 0, caught = 0, off = 0;
    for (int i = 0; i < Draws(10); ++i) {
      const Eigen::VectorXd x = Draw(variables, &draw);
      const RowSlopes slopes(table, x, &draw);
      ASSERT_EQ(slopes.nonzeros.size(), table.num_nonzeros());
      const Eigen::VectorXd &coarse = slopes.coarse, &fine = slopes.fine;
      size_t entry = 0;
      for (int row = 0; row < table.rows(); ++row) {
        double analytic = 0.0;
        for (int v : table.band(table.half_step_of(row))) {
          analytic += slopes.nonzeros[entry++] * slopes.direction[v];
        }
        const double size = 1 + std::abs(fine[row]);
        if (std::abs(coarse[row] - fine[row]) > 1e-3 * size) {
          ++kinks;
          continue;
        }
        ++compared;
        // The normal of a distance is known to some 10⁻³ rad, as exactly as the distance is found;
        // along it nothing is lost, across it some percent in some rows.
        const bool distance = Traits(table.family_of(row)).cost >= MarginCost::kObstacles;
        if (distance && std::abs(analytic - fine[row]) > 5e-3 * size) {
          ++off;
          continue;
        }
        EXPECT_NEAR(analytic, fine[row], 5e-3 * size)
            << Name(table.family_of(row)) << " in half-step " << table.half_step_of(row);
        caught += std::abs(-analytic - fine[row]) > 5e-3 * size;
      }
    }
    EXPECT_GT(compared, Draws(10) * 50);
    EXPECT_LT(kinks, compared / 20);
    EXPECT_LE(off, 2 + compared / 200);
    EXPECT_GT(caught, compared / 10);
  }

  const Experiment e_ = LoadExperiment("bar_8cm");
  const MarginEvaluator evaluator_{e_.robot, e_.scene, e_.config.smoothing.limits};
  const OverlapVariables variables_{
      e_.sequence, ParameterTable(e_.sequence, {}, {.heights = true, .durations = true})};
  const WatchedInstants table_{variables_, evaluator_, {.instants = 4}};
};

TEST_F(WatchedInstantsTest, OutsideOfItsBandAVariableChangesNothingAtAll) {
  WalkDraw draw(360);
  const Eigen::VectorXd x = Draw(&draw);
  Eigen::VectorXd before, after;
  table_.Evaluate(x, &before, nullptr);
  int outside = 0, changed = 0;
  for (int v = 0; v < variables_.size(); ++v) {
    Eigen::VectorXd y = x;
    y[v] *= 0.98;
    table_.Evaluate(y, &after, nullptr);
    for (int k = 0; k < e_.sequence.size(); ++k) {
      const std::vector<int>& band = table_.band(k);
      const auto rows = Eigen::seqN(k * table_.NumRowFamilies(), table_.NumRowFamilies());
      if (std::find(band.begin(), band.end(), v) != band.end()) {
        changed += (before(rows) - after(rows)).norm() > 0;
        continue;
      }
      ++outside;
      EXPECT_LT((before(rows) - after(rows)).cwiseAbs().maxCoeff(), 1e-9)
          << "variable " << v << ", half-step " << k;
    }
  }
  EXPECT_GT(outside, 20);
  EXPECT_GT(changed, 20);
}

TEST_F(WatchedInstantsTest, ARowNeverExceedsTheLeastSlackAndNearsItAsItSharpens) {
  WalkDraw draw(361);
  WatchedInstants table(variables_, evaluator_, {.instants = 4});
  const Eigen::VectorXd x = Draw(&draw);
  std::array<bool, kNumMarginFamilies> all;
  all.fill(true);
  const double least = table.LeastSlack(variables_.ToParameters(x), all);
  double gap = 1e9;
  for (double sharpness : {20.0, 100.0, 500.0}) {
    table.SetSharpness(sharpness);
    Eigen::VectorXd rows;
    table.Evaluate(x, &rows, nullptr);
    ASSERT_EQ(rows.size(), table.rows());
    EXPECT_LE(rows.minCoeff(), least + 1e-12);
    EXPECT_LE(rows.maxCoeff(), 3.0);
    EXPECT_LE(least - rows.minCoeff(), gap);
    gap = least - rows.minCoeff();
    EXPECT_LT(gap, std::log(1000.0) / sharpness);
  }
}

TEST_F(WatchedInstantsTest, JacobianAlongRandomDirectionsAgreesWithDifferences) {
  ExpectSlopes(table_, variables_, 362);
}

// With the instants that move with the horizontal motion.
TEST_F(WatchedInstantsTest, SoDoesThatOfForms) {
  const OverlapVariables variables(e_.sequence, ParameterTable(e_.sequence, {}, EveryFamily()));
  ExpectSlopes(WatchedInstants(variables, evaluator_, {.instants = 4}), variables, 366);
}

TEST_F(WatchedInstantsTest, SoDoesThatOfStopBranches) {
  ExpectSlopes({variables_, evaluator_, {.instants = 4, .stop_branches = StopBranches::kAll}},
               variables_, 363);
}

// Every row that looks at branches is at most the one that does not, and the least slack is that of
// the walk and of all its branches, sampled densely.
TEST_F(WatchedInstantsTest, BranchesLowerRowsAndTheLeastSlack) {
  WalkDraw draw(364);
  WatchedInstants stoppable(variables_, evaluator_,
                            {.instants = 32, .stop_branches = StopBranches::kAll});
  const WatchedInstants plain(variables_, evaluator_, {.instants = 32});
  std::array<bool, kNumMarginFamilies> all;
  all.fill(true);
  int lower = 0;
  for (int i = 0; i < Draws(4); ++i) {
    const Eigen::VectorXd x = Draw(&draw);
    Eigen::VectorXd with, without;
    stoppable.Evaluate(x, &with, nullptr);
    plain.Evaluate(x, &without, nullptr);
    ASSERT_EQ(with.size(), without.size());
    EXPECT_LE((with - without).maxCoeff(), 1e-12);
    lower += (with - without).minCoeff() < -0.05;
    const HomotopyParameters parameters = variables_.ToParameters(x);
    const SuperposedWalk walk(e_.sequence, parameters);
    SlackEvaluator slacks(evaluator_, 1.5);
    InstantSlacks instant;
    double least = 1.5;
    for (int k = 0; k + 1 < walk.num_half_steps(); ++k) {
      const SuperposedWalk branch = walk.StopBranch(k);
      for (double t = walk.start_of(k + 1); t < walk.end_of(k); t += 0.004) {
        slacks.At(branch, branch.Locate(t), {}, false, &instant);
        for (const SlackRow& row : instant.rows) least = std::min(least, row.slack);
      }
    }
    const double known = plain.LeastSlack(parameters, all);
    const double expected = std::min(least, known);
    EXPECT_NEAR(stoppable.LeastSlack(parameters, all), expected, 0.03 * (1 + std::abs(expected)));
    const double focused = std::ranges::min(stoppable.Focus(walk, 0.002, 0.0));
    EXPECT_NEAR(stoppable.LeastSlack(parameters, all), focused, 0.01 * (1 + std::abs(focused)));
  }
  EXPECT_GT(lower, 0);
}

TEST_F(WatchedInstantsTest, AnInstantIsLearnedOnce) {
  WatchedInstants table(variables_, evaluator_, {.instants = 4});
  const SuperposedWalk walk(e_.sequence, PlannedMotion(e_.sequence));
  EXPECT_TRUE(table.Learn(walk, {2, 0.4321}));
  EXPECT_FALSE(table.Learn(walk, {2, 0.4321}));
  EXPECT_TRUE(table.Learn(walk, {3, 0.4321}));
}

// What Focus leaves out is far from its limit, and what it adds is not missed by dense sampling.
TEST_F(WatchedInstantsTest, FocusSeesTheLeastSlackWithFewerRows) {
  WatchedInstants table(variables_, evaluator_, {.instants = 32, .row_per_instant = true});
  const int rows = table.rows();
  HomotopyParameters parameters = PlannedMotion(e_.sequence);
  for (double& duration : parameters.durations) duration *= 0.8;
  const SuperposedWalk walk(e_.sequence, parameters);
  const std::vector<double> leasts = table.Focus(walk, 0.002, 0.0);
  EXPECT_EQ(std::ssize(leasts), walk.num_half_steps());
  const double least = std::ranges::min(leasts);
  EXPECT_LT(table.rows(), rows);
  std::array<bool, kNumMarginFamilies> all;
  all.fill(true);
  EXPECT_NEAR(table.LeastSlack(parameters, all), least, 1e-3);
  Eigen::VectorXd values;
  table.Evaluate(variables_.ToVariables(parameters), &values, nullptr);
  EXPECT_NEAR(values.minCoeff() + (3.0 + std::log(2.0)) / table.sharpness(), least, 0.02);
  const int focused = table.rows();
  table.Focus(walk, 0.002, 0.0);
  EXPECT_EQ(table.rows(), focused);  // nothing piles up
}

// So that a search can hold back the half-steps at fault, and no others.
TEST_F(WatchedInstantsTest, FocusTellsTheLeastSlackOfEachHalfStep) {
  WatchedInstants table(variables_, evaluator_, {.instants = 8, .row_per_instant = true});
  HomotopyParameters parameters = PlannedMotion(e_.sequence);
  const std::vector<double> before =
      table.Focus(SuperposedWalk(e_.sequence, parameters), 0.002, 0.0);
  EXPECT_GE(std::ranges::min(before), 0.0) << "the plan keeps all";
  EXPECT_LE(std::ranges::max(before), 1.0 + 1e-12);
  parameters.durations[3] *= 0.3;
  const std::vector<double> after =
      table.Focus(SuperposedWalk(e_.sequence, parameters), 0.002, 0.0);
  for (size_t k = 0; k < before.size(); ++k) {
    if (k == 3) {
      EXPECT_LT(after[k], 0.0);
    } else {
      EXPECT_NEAR(after[k], before[k], 0.05) << k;  // other samples of the same stretch
    }
  }
}

// Values and derivatives are counted apart, whatever their order and the threads.
TEST_F(WatchedInstantsTest, WhatIsLookedAtIsCounted) {
  WatchedInstants table(variables_, evaluator_, {.instants = 8});
  const HomotopyParameters parameters = PlannedMotion(e_.sequence);
  const Eigen::VectorXd x = variables_.ToVariables(parameters);
  Eigen::VectorXd values;
  std::vector<double> nonzeros;
  table.Evaluate(x, &values, nullptr);  // not counted anywhere
  Work alone;
  table.SetWork(&alone);
  table.Evaluate(x, &values, nullptr);
  EXPECT_GE(alone.instants, 8 * e_.sequence.size());
  EXPECT_EQ(alone, (Work{.instants = alone.instants}));
  const long instants = alone.instants;
  table.Evaluate(x, &values, &nonzeros);
  EXPECT_EQ(alone, (Work{.instants = instants, .derivatives = instants}));
  table.Focus(SuperposedWalk(e_.sequence, parameters), 0.01, 0.0);
  EXPECT_GT(alone.instants, instants + std::lround(DurationOf(parameters) / 0.01));

  Workers workers(3);
  WatchedInstants again(variables_, evaluator_, {.instants = 8});
  Work shared;
  again.SetWorkers(&workers);
  again.SetWork(&shared);
  again.Evaluate(x, &values, nullptr);
  again.Evaluate(x, &values, &nonzeros);
  again.Focus(SuperposedWalk(e_.sequence, parameters), 0.01, 0.0);
  EXPECT_EQ(alone, shared);
}

// The rows of what was refused ask for more from then on, and no others.
TEST_F(WatchedInstantsTest, ARefusalCostsOnlyTheRowsOfItsHalfStep) {
  WatchedInstants table(variables_, evaluator_, {.instants = 8, .row_per_instant = true});
  const HomotopyParameters parameters = PlannedMotion(e_.sequence);
  const Eigen::VectorXd x = variables_.ToVariables(parameters);
  table.Focus(SuperposedWalk(e_.sequence, parameters), 0.01, 0.0);
  Eigen::VectorXd before, after;
  table.Evaluate(x, &before, nullptr);
  table.LearnReserves(true, {{.family = MarginFamily::kZmp, .value = 0.0, .at = {2, 0.1}}});
  table.Evaluate(x, &after, nullptr);
  int lower = 0;
  for (int row = 0; row < table.rows(); ++row) {
    const double change = before[row] - after[row];
    if (table.half_step_of(row) != 2) {
      EXPECT_EQ(change, 0.0) << row;
    } else if (table.family_of(row) == MarginFamily::kZmp) {
      EXPECT_NEAR(change, 3.0 / table.sharpness(), 1e-9) << row;
      ++lower;
    } else {
      EXPECT_GE(change, 0.0) << row;
    }
  }
  EXPECT_GT(lower, 3);
  table.SetReserves(1.0);
  table.Evaluate(x, &after, nullptr);
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace halfstep
