#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/plot/direct_labels.h"
#include "experiments/plot/layout.h"
#include "experiments/plot/page_size.h"
#include "experiments/plot/style.h"
#include "experiments/plot/thinned.h"
#include "experiments/plot/ticks.h"
#include "tests/refusal_of.h"
#include "wpg/elementary.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::HasSubstr;

// As in a font all of whose letters are as wide.
double Measure(const std::string& text, bool) { return 3.6 * static_cast<double>(text.size()); }

std::vector<std::string> TextsOf(const std::vector<Tick>& ticks) {
  std::vector<std::string> texts;
  for (const Tick& tick : ticks) texts.push_back(tick.text);
  return texts;
}

std::vector<Vector2d> Wave(double phase) {
  std::vector<Vector2d> points;
  for (int i = 0; i <= 200; ++i) points.emplace_back(0.05 * i, Sin(0.05 * i + phase));
  return points;
}

Figure TwoWaves() {
  Panel panel;
  panel.title = "waves";
  panel.x = {.label = "time [s]", .low = 0.0, .high = 10.0};
  panel.y = {.label = "y [m]", .low = -1.2, .high = 1.2};
  panel.lines.push_back({.name = "a", .points = Wave(0.0), .label = "first"});
  panel.lines.push_back({.name = "b", .points = Wave(1.5), .label = "second"});
  return {.title = "waves", .width = 252.0, .rows = {{panel}}};
}

double DistanceTo(const PlacedPanel& placed, const Line& line, const PageBox& box) {
  double least = 1e9;
  for (const Vector2d& p : line.points) {
    least = std::min(least, box.exteriorDistance(placed.ToPage(p)));
  }
  return least;
}

TEST(PlotTicks, AreRoundAndFew) {
  EXPECT_THAT(TextsOf(ChosenTicks({.low = -0.12, .high = 0.31}, 6)),
              ElementsAre("−0.1", "0.0", "0.1", "0.2", "0.3"));
  EXPECT_THAT(TextsOf(ChosenTicks({.low = 0.0, .high = 7.2}, 5)), ElementsAre("0", "2", "4", "6"));
  EXPECT_THAT(TextsOf(ChosenTicks({.low = 1.0, .high = 30.0, .logarithmic = true}, 6)),
              ElementsAre("1", "2", "5", "10", "20"));
  for (const double length : {1e-6, 0.3, 1.0, 17.0, 1e5}) {
    for (int most = 2; most < 9; ++most) {
      const std::vector<Tick> ticks = ChosenTicks({.low = 0.37, .high = 0.37 + length}, most);
      EXPECT_GE(ticks.size(), 2u) << length;
      EXPECT_LE(static_cast<int>(ticks.size()), most + 2);
      for (const Tick& tick : ticks) {
        EXPECT_GE(tick.at, 0.37 - 1e-6 * length);
        EXPECT_LE(tick.at, 0.37 + length * (1 + 1e-6));
      }
    }
  }
}

TEST(PlotLayout, MapsTheAxesOntoTheFrame) {
  const PlacedFigure placed = PlaceFigure(TwoWaves(), Measure);
  const PlacedPanel& panel = placed.panels.front();
  EXPECT_TRUE(
      panel.ToPage({0.0, -1.2}).isApprox(Vector2d(panel.frame.min().x(), panel.frame.max().y())));
  EXPECT_TRUE(
      panel.ToPage({10.0, 1.2}).isApprox(Vector2d(panel.frame.max().x(), panel.frame.min().y())));
  EXPECT_EQ(placed.width, 252.0);
}

TEST(PlotLayout, EqualAxesHaveOneScale) {
  Figure figure = TwoWaves();
  Panel& panel = figure.rows[0][0];
  panel.equal = true;
  panel.height = 0.0;
  for (const double high : {1.2, 30.0}) {  // wide, and so high that the page would be too long
    panel.y.high = high;
    const PlacedPanel placed = PlaceFigure(figure, Measure).panels.front();
    const Vector2d origin = placed.ToPage({0, 0});
    EXPECT_NEAR(placed.ToPage({1, 0}).x() - origin.x(), origin.y() - placed.ToPage({0, 1}).y(),
                1e-9);
    EXPECT_LE(placed.frame.sizes().y(), 1.6 * placed.frame.sizes().x() + 1e-9);
  }
}

TEST(PlotLayout, SaysThatAWidthIsTooSmall) {
  Figure figure = TwoWaves();
  figure.width = 72.0;
  figure.rows[0].push_back(figure.rows[0][0]);
  EXPECT_THAT(RefusalOf([&] { PlaceFigure(figure, Measure); }),
              HasSubstr("--width: leaves no room for frames"));
}

TEST(PlotLabels, AreBesideTheirOwnLine) {
  const PlacedFigure placed = PlaceFigure(TwoWaves(), Measure);
  const PlacedPanel& panel = placed.panels.front();
  std::vector<PlacedText> labels;
  for (const PlacedText& text : placed.texts) {
    if (text.direct) labels.push_back(text);
  }
  ASSERT_EQ(labels.size(), 2u);
  EXPECT_FALSE(labels[0].box.intersects(labels[1].box));
  for (size_t i = 0; i < 2; ++i) {
    const double own = DistanceTo(panel, panel.panel.lines[i], labels[i].box);
    EXPECT_GT(own, 0.0) << "it covers a line";
    EXPECT_LT(own, 4.0);
    EXPECT_GT(DistanceTo(panel, panel.panel.lines[1 - i], labels[i].box), own);
    EXPECT_TRUE(panel.frame.contains(labels[i].box));
  }
}

// Where everything is taken but one place, it is found.
TEST(PlotLabels, KeepOffWhatIsTaken) {
  PlacedPanel panel = PlaceFigure(TwoWaves(), Measure).panels.front();
  panel.panel.lines.resize(1);
  const double right = panel.frame.max().x() - 40.0;
  const PageBox taken(panel.frame.min(), Vector2d(right, panel.frame.max().y()));
  const std::vector<PlacedText> labels = DirectLabels(panel, Measure, {taken});
  ASSERT_EQ(labels.size(), 1u);
  EXPECT_GT(labels[0].box.min().x(), right);
}

TEST(PlotThinning, KeepsWithinItsTolerance) {
  const std::vector<Vector2d> wave = Wave(0.3);
  const std::vector<Vector2d> thin = Thinned(wave, 0.01);
  EXPECT_LT(thin.size(), wave.size() / 3);
  for (const Vector2d& p : wave) {
    double least = 1e9;
    for (size_t i = 1; i < thin.size(); ++i) {
      const Vector2d d = thin[i] - thin[i - 1];
      const double t = std::clamp((p - thin[i - 1]).dot(d) / d.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - thin[i - 1] - t * d).norm());
    }
    EXPECT_LE(least, 0.01);
  }
  // Breaks stay where they are.
  std::vector<Vector2d> broken = wave;
  broken[100].y() = std::nan("");
  const std::vector<Vector2d> rest = Thinned(broken, 0.01);
  EXPECT_EQ(std::ranges::count_if(rest, [](const Vector2d& p) { return std::isnan(p.y()); }), 1);
}

TEST(PlotWidth, TakesInchesAndMetricLengths) {
  EXPECT_EQ(PointsOf("--width", "3.5in"), 252.0);
  EXPECT_NEAR(PointsOf("--width", "8.89cm"), 252.0, 1e-9);
  EXPECT_NEAR(PointsOf("--width", "88.9mm"), 252.0, 1e-9);
  EXPECT_THAT(RefusalOf([] { PointsOf("--width", "3.5"); }),
              HasSubstr("--width: '3.5' is no length (valid: 3.5in, 8.9cm, 89mm)"));
  EXPECT_THAT(RefusalOf([] { PointsOf("--width", "0.2in"); }), HasSubstr("valid: 1in … 20in"));
}

TEST(PlotStyle, TextIsLargeEnoughForAColumn) { EXPECT_GE(style::kTextSize, 7.0); }

}  // namespace
}  // namespace halfstep::plot
