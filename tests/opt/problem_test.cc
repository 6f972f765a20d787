#include "opt/problem/problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "opt/problem/problem_derivatives.h"
#include "tests/problems/auto_blocks.h"
#include "tests/problems/hock_schittkowski.h"

namespace halfstep::testing {
namespace {

using ::testing::HasSubstr;

/// Two rows over three variables, deliberately not square; `wrong` spoils one derivative.
class Pair : public opt::ConstraintBlock {
 public:
  explicit Pair(double wrong = 0.0) : wrong_(wrong) {}
  std::string name() const override { return "pair"; }
  std::string unit() const override { return "m"; }
  int rows() const override { return 2; }
  const opt::SparsityPattern& pattern() const override { return pattern_; }
  Eigen::VectorXd lower() const override { return Vector({0, -kInfinity}); }
  Eigen::VectorXd upper() const override { return Vector({1, 2}); }
  void Evaluate(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values) const override {
    values << x[0] * x[2], x[1];
  }
  void Jacobian(const Eigen::VectorXd& x, std::span<double> nonzeros) const override {
    nonzeros[0] = 1.0;
    nonzeros[1] = x[2];
    nonzeros[2] = x[0] + wrong_;
  }
  opt::SparsityPattern pattern_{{1, 0, 0}, {1, 0, 2}};

 private:
  double wrong_;
};

opt::Problem TwoBlocks(double wrong = 0.0) {
  opt::Problem problem;
  problem.AddVariables({"overlap", "s", Vector({1, 2}), Vector({0, 0}), Vector({3, 3})});
  problem.AddVariables({"height", "m", Vector({5}), Vector({0}), Vector({kInfinity})});
  problem.AddConstraint(std::make_unique<Pair>(wrong));
  problem.AddConstraint(std::make_unique<Pair>());
  const auto sum = [](const auto& x) { return x[0] + x[1] * x[1] + 3.0 * x[2]; };
  problem.AddCost(std::make_unique<AutoCost<decltype(sum)>>(sum), 2.0);
  problem.AddCost(std::make_unique<AutoCost<decltype(sum)>>(sum), 0.5);
  return problem;
}

TEST(Problem, StacksBlocksInOrder) {
  const opt::Problem problem = TwoBlocks();
  const Eigen::VectorXd x = Vector({1, 2, 5});
  EXPECT_EQ(problem.num_variables(), 3);
  EXPECT_EQ(problem.num_constraints(), 4);
  EXPECT_EQ(problem.num_equalities(), 0);
  EXPECT_EQ(problem.initial(), x);
  EXPECT_EQ(problem.upper()[2], kInfinity);
  EXPECT_EQ(problem.Cost(x), 2.5 * 20.0);
  EXPECT_EQ(problem.Gradient(x), Vector({2.5, 10, 7.5}));
  EXPECT_EQ(problem.Constraints(x), Vector({5, 2, 5, 2}));
  Eigen::MatrixXd jacobian(4, 3);
  jacobian << 5, 0, 1, 0, 1, 0, 5, 0, 1, 0, 1, 0;
  EXPECT_EQ(problem.DenseJacobian(x), jacobian);
  EXPECT_EQ(problem.RowName(3), "pair[1]");
  EXPECT_EQ(problem.VariableName(1), "overlap[1]");
  EXPECT_EQ(problem.VariableName(2), "height[0]");
  EXPECT_EQ(problem.VariableUnit(2), "m");
}

TEST(Problem, NamesTheWorstRowOrVariable) {
  const opt::Problem problem = TwoBlocks();
  EXPECT_EQ(problem.MaxViolation(Vector({0.1, 1, 5})).amount, 0.0);
  const opt::Violation row = problem.MaxViolation(Vector({1, 2.5, 5}));
  EXPECT_EQ(row.amount, 4.0);
  EXPECT_EQ(row.row, "pair[0]");
  EXPECT_EQ(row.unit, "m");
  const opt::Violation bound = problem.MaxViolation(Vector({-2, 1, 0}));
  EXPECT_EQ(bound.amount, 2.0);
  EXPECT_EQ(bound.row, "overlap[0]");
  EXPECT_EQ(problem.MaxViolation(Vector({std::nan(""), 1, 0})).amount, kInfinity);
}

TEST(Problem, ReportsTheLeastRoomFirst) {
  const std::string report = TwoBlocks().Report(Vector({1, 2, 5}), 3);
  EXPECT_THAT(report, HasSubstr("3 variables, 4 constraint rows (0 equalities)"));
  EXPECT_THAT(report, HasSubstr("2 of 7 rows and variables violated; the 3 with the least room"));
  const size_t worst = report.find("pair[0]"), held = report.find("pair[1]");
  EXPECT_LT(worst, held);
  EXPECT_EQ(report.find("height[0]"), std::string::npos);
  // Aligned: the lines of the last table are equally long.
  const std::string table = report.substr(report.find("row "));
  const size_t width = table.find('\n');
  EXPECT_EQ(table.size(), 4 * (width + 1)) << report;
}

TEST(Problem, RefusesWhatDoesNotFit) {
  opt::Problem problem;
  EXPECT_THROW(problem.AddVariables({"a", "s", Vector({0}), Vector({1}), Vector({0})}),
               std::logic_error);
  EXPECT_THROW(problem.AddVariables({"a", "s", Vector({0}), Vector({std::nan("")}), Vector({0})}),
               std::logic_error);
  EXPECT_THROW(problem.AddVariables({"a", "s", Vector({0}), Vector({0, 0}), Vector({0})}),
               std::logic_error);
  problem.AddVariables({"a", "s", Vector({0, 0, 0}), Constant(3, -1), Constant(3, 1)});
  auto outside = std::make_unique<Pair>();
  outside->pattern_.cols[0] = 3;
  EXPECT_THROW(problem.AddConstraint(std::move(outside)), std::logic_error);
  auto twice = std::make_unique<Pair>();
  twice->pattern_ = {{0, 0, 1}, {1, 1, 0}};
  EXPECT_THROW(problem.AddConstraint(std::move(twice)), std::logic_error);
  problem.AddConstraint(std::make_unique<Pair>());
  EXPECT_THROW(problem.AddVariables({"b", "s", Vector({0}), Vector({0}), Vector({0})}),
               std::logic_error);
  EXPECT_THROW((void)problem.Cost(Vector({0})), std::logic_error);
}

TEST(CheckDerivatives, NamesTheWrongEntry) {
  const Eigen::VectorXd x = Vector({1, 2, 5});
  EXPECT_TRUE(opt::CheckDerivatives(TwoBlocks(), x).Passed(1e-9));
  const opt::ProblemDerivativeReport report = opt::CheckDerivatives(TwoBlocks(0.1), x);
  EXPECT_FALSE(report.Passed(1e-3));
  EXPECT_THAT(report.message, HasSubstr("pair[0] with respect to height[0]"));
}

TEST(CheckDerivatives, FindsAnEntryThatThePatternForgets) {
  opt::Problem problem = ProblemBuilder(Vector({1, 2}))
                             .Row("both", 0.0, [](const auto& x) { return x[0] * x[1]; }, 1.0, {1})
                             .Build();
  const opt::ProblemDerivativeReport report = opt::CheckDerivatives(problem, Vector({1, 2}));
  EXPECT_FALSE(report.Passed(1e-3));
  EXPECT_THAT(report.message, HasSubstr("both with respect to x[0]: "));
}

}  // namespace
}  // namespace halfstep::testing
