#include "smoothing/program/watched_instants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

class WatchedInstantsTest : public testing::Test {
 protected:
  // Overlaps about where smoothing ends, everything else about as planned.
  Eigen::VectorXd Draw(WalkDraw* draw) const {
    Eigen::VectorXd x(variables_.size());
    const HomotopyParameters planned = PlannedMotion(e_.sequence);
    for (int v = 0; v < variables_.size(); ++v) {
      const HomotopyParameter& p = variables_.at(v);
      x[v] = p.family == HomotopyParameter::Family::kOverlap ? draw->Uniform(0.6, 0.95)
             : p.family == HomotopyParameter::Family::kHeightScale
                 ? draw->Uniform(0.7, 1.0)
                 : draw->Uniform(0.9, 1.1) * planned.durations[static_cast<size_t>(p.index)];
    }
    return x;
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
      const auto rows =
          Eigen::seqN(k * WatchedInstants::NumRowFamilies(), WatchedInstants::NumRowFamilies());
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
  WalkDraw draw(362);
  int compared = 0, kinks = 0, caught = 0;
  for (int i = 0; i < Draws(10); ++i) {
    const Eigen::VectorXd x = Draw(&draw);
    Eigen::VectorXd direction(x.size());
    for (Eigen::Index v = 0; v < x.size(); ++v) direction[v] = draw.Uniform(-1, 1);
    Eigen::VectorXd values;
    std::vector<double> nonzeros;
    table_.Evaluate(x, &values, &nonzeros);
    ASSERT_EQ(nonzeros.size(), table_.num_nonzeros());
    const auto slope = [&](double h) {
      Eigen::VectorXd more, less;
      table_.Evaluate(x + h * direction, &more, nullptr);
      table_.Evaluate(x - h * direction, &less, nullptr);
      return Eigen::VectorXd((more - less) / (2 * h));
    };
    const Eigen::VectorXd coarse = slope(1e-5), fine = slope(2e-6);
    size_t entry = 0;
    for (int row = 0; row < table_.rows(); ++row) {
      double analytic = 0.0;
      for (int v : table_.band(table_.half_step_of(row))) {
        analytic += nonzeros[entry++] * direction[v];
      }
      const double size = 1 + std::abs(fine[row]);
      if (std::abs(coarse[row] - fine[row]) > 1e-3 * size) {
        ++kinks;
        continue;
      }
      ++compared;
      EXPECT_NEAR(analytic, fine[row], 5e-3 * size)
          << Name(WatchedInstants::family_of(row)) << " in half-step " << table_.half_step_of(row);
      caught += std::abs(-analytic - fine[row]) > 5e-3 * size;
    }
  }
  EXPECT_GT(compared, Draws(10) * 50);
  EXPECT_LT(kinks, compared / 20);
  EXPECT_GT(caught, compared / 10);
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
  const double least = table.Focus(walk, 0.002, 0.0);
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

}  // namespace
}  // namespace halfstep
