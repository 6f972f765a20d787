#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "experiments/plot/canvas.h"
#include "experiments/plot/plot.h"
#include "experiments/plot/plotted_run.h"
#include "experiments/plot/support_band.h"
#include "tests/experiments/made_once.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/refusal_of.h"

namespace halfstep::plot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A folder with a run of two half-steps over a box, "run".
class PlotCommandTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!WhyNoPlots().empty()) GTEST_SKIP() << WhyNoPlots();
    CopyMadeOnce(place_.path(), {"run", ShippedConfig("fig5_box"), "--out", "run", "--quiet",
                                 "--set", "smoothing.methods=[dichotomy]"});
  }
  Figure FigureWith(const std::vector<std::string>& what, const std::vector<std::string>& methods,
                    const std::string& folder = "run") {
    return FigureOf({.folder = (place_ / folder).string(), .what = what, .methods = methods});
  }
  Outcome Plot(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"plot", "--quiet"});
    return Halfstep(place_.path(), arguments);
  }
  std::string Refusal(const std::vector<std::string>& arguments) {
    const Outcome outcome = Plot(arguments);
    EXPECT_EQ(outcome.status, kBadInput) << outcome.err;
    EXPECT_THAT(NamesIn(place_.path()), ElementsAre("run"));
    return outcome.err;
  }

  TemporaryFolder place_;
};

const std::vector<std::string> kSubjects = {"walk", "foot", "side", "zmp", "margins", "joints"};

void CheckPage(const PlacedFigure& placed) {
  const PageBox page(Eigen::Vector2d(0, 0), Eigen::Vector2d(placed.width, placed.height));
  for (size_t i = 0; i < placed.texts.size(); ++i) {
    const PlacedText& text = placed.texts[i];
    EXPECT_TRUE(page.contains(text.box)) << text.text;
    if (!text.direct) continue;
    for (size_t j = 0; j < placed.texts.size(); ++j) {
      if (j == i) continue;
      EXPECT_FALSE(text.box.intersects(placed.texts[j].box))
          << text.text << " covers " << placed.texts[j].text;
    }
  }
  for (const PlacedPanel& panel : placed.panels) {
    EXPECT_TRUE(page.contains(panel.frame));
    EXPECT_GE(panel.panel.y.ticks.size(), 2u);
  }
}

TEST_F(PlotCommandTest, EverythingIsWithinThePageAndLabelsCoverNoText) {
  for (const std::vector<std::string>& methods :
       {std::vector<std::string>{}, std::vector<std::string>{"raw", "dichotomy"}}) {
    Figure figure = FigureWith(kSubjects, methods);
    for (const double width : {3.5, 7.16}) {
      SCOPED_TRACE(width);
      figure.width = width * kPointsPerInch;
      CheckPage(PlaceFigure(figure, TextWidth));
    }
  }
}

TEST_F(PlotCommandTest, CurvesAreTheRows) {
  const Figure figure = FigureWith({"zmp", "foot"}, {"raw", "dichotomy"});
  std::map<std::string, ParsedCsv> tables;
  for (const std::string method : {"raw", "dichotomy"}) {
    tables.emplace(method, ReadText(place_ / "run" / method / "trajectory.csv"));
  }
  int compared = 0;
  for (const Row& row : figure.rows) {
    for (const Line& line : row.front().lines) {
      const size_t slash = line.name.find('/');
      const std::string column = line.name.substr(slash + 1);
      const ParsedCsv& rows = tables.at(line.name.substr(0, slash));
      const double factor = column.ends_with("foot_z_m") ? 100.0 : 1.0;  // [cm]
      ASSERT_EQ(line.points.size(), rows.size());
      for (size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(line.points[i].x(), rows.Number(i, "t_s"));
        ASSERT_EQ(line.points[i].y(), factor * rows.Number(i, column));
      }
      ++compared;
    }
  }
  EXPECT_EQ(compared, 16);
}

// A ZMP is inside the polygon by d just when each coordinate is in the band of d.
TEST_F(PlotCommandTest, BandsAreWhatMarginsSay) {
  const PlottedRun run = ReadPlottedRun(place_ / "run", {"dichotomy"}, {});
  const PlottedWalk& walk = run.walks.front();
  const std::vector<double> margin = walk.rows.Numbers("zmp_margin_m");
  int inside = 0, outside = 0;
  for (const double demanded : {0.01, 0.06, 0.1}) {
    for (const int k : {0, 1}) {
      const std::vector<double> zmp = walk.rows.Numbers(k == 0 ? "zmp_x_m" : "zmp_y_m");
      const std::vector<SupportBand> bands =
          SupportBands(walk, run.place.robot.sole_size, k, demanded);
      for (size_t i = 0; i < zmp.size(); ++i) {
        if (std::abs(margin[i] - demanded) < 1e-9) continue;
        const bool within = bands[i].low <= zmp[i] && zmp[i] <= bands[i].high;
        ASSERT_EQ(within, margin[i] > demanded) << i << ' ' << k << ' ' << demanded;
        ++(within ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

TEST_F(PlotCommandTest, TheBoxIsWhereItIs) {
  for (const auto& [what, first, second] :
       {std::tuple{"side", Eigen::Vector2d(12.8, 0.0), Eigen::Vector2d(14.6, 8.0)},
        std::tuple{"walk", Eigen::Vector2d(0.128, -0.5), Eigen::Vector2d(0.146, 0.5)}}) {
    const Panel panel = FigureWith({what}, {}).rows[0][0];
    ASSERT_EQ(panel.areas.front().name, "box");
    PageBox bounds;
    for (const Eigen::Vector2d& corner : panel.areas.front().corners) bounds.extend(corner);
    EXPECT_NEAR(bounds.min().x(), first.x(), 1e-9) << what;
    EXPECT_NEAR(bounds.max().x(), second.x(), 1e-9) << what;
    if (std::string(what) == "side") {
      EXPECT_NEAR(bounds.min().y(), first.y(), 1e-9);
      EXPECT_NEAR(bounds.max().y(), second.y(), 1e-9);
    }
  }
}

TEST_F(PlotCommandTest, ProvedMarginsAreNoLargerThanFoundOnes) {
  const Figure figure = FigureWith({"margins"}, {});
  int panels = 0;
  for (const Row& row : figure.rows) {
    for (const Panel& panel : row) {
      ++panels;
      double proved = 1e300, found = 1e300;
      for (const Line& line : panel.lines) {
        double& least = line.name.ends_with("proved") ? proved : found;
        // One line over time, though rows of a certificate overlap.
        EXPECT_TRUE(std::ranges::is_sorted(line.points, {}, [](const auto& p) { return p.x(); }))
            << line.name;
        for (const Eigen::Vector2d& p : line.points) {
          if (std::isfinite(p.y())) least = std::min(least, p.y());
        }
      }
      EXPECT_LE(proved, found + 1e-9) << panel.title;
      EXPECT_GE(proved, panel.areas.front().corners[2].y() - 1e-9) << "below what is demanded";
    }
  }
  EXPECT_EQ(panels, 8);
}

TEST_F(PlotCommandTest, FilesHaveTheAskedSizeAndTheSameBytesEachTime) {
  for (const std::string ending : {"pdf", "svg", "png"}) {
    for (const std::string name : {"a.", "b."}) {
      ASSERT_EQ(Plot({"run", "--what", "walk,zmp", "--width", "89mm", name + ending}).status,
                kSuccess);
    }
    EXPECT_EQ(ReadText(place_ / ("a." + ending)), ReadText(place_ / ("b." + ending))) << ending;
  }
  const std::string pdf = ReadText(place_ / "a.pdf");
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 252.28"));
  EXPECT_THAT(pdf, HasSubstr("/FontFile"));
  EXPECT_THAT(ReadText(place_ / "a.svg"), HasSubstr("width=\"252.28"));
  const std::string png = ReadText(place_ / "a.png").substr(16, 4);  // of IHDR
  const int width = 256 * static_cast<unsigned char>(png[2]) + static_cast<unsigned char>(png[3]);
  EXPECT_EQ(width, 1051);
}

TEST_F(PlotCommandTest, RefusesWhatItCannotDraw) {
  EXPECT_THAT(
      Refusal({"run", "--what", "walk,torques", "a.pdf"}),
      HasSubstr("--what: 'torques' is unknown (valid: walk, foot, side, zmp, margins, joints)"));
  EXPECT_THAT(Refusal({"run", "--what", "zpm", "a.pdf"}), HasSubstr("did you mean 'zmp'?"));
  EXPECT_THAT(Refusal({"run", "--method", "ipopt", "a.pdf"}),
              HasSubstr("--method: 'ipopt' is not in "));
  EXPECT_THAT(Refusal({"run", "--method", "raw,dichotomy,raw", "a.pdf"}),
              HasSubstr("--method: 3 methods (valid: one, or two to be compared)"));
  EXPECT_THAT(Refusal({"run", "--method", "raw,raw", "a.pdf"}), HasSubstr("twice"));
  EXPECT_THAT(Refusal({"run", "a.eps"}),
              HasSubstr("OUT: 'a.eps' (valid: a name that ends in .pdf, .svg or .png)"));
  EXPECT_THAT(Refusal({"run", "--width", "wide", "a.pdf"}), HasSubstr("--width: 'wide'"));
  EXPECT_THAT(Refusal({"run", "--what", "joints", "--width", "1in", "a.pdf"}),
              HasSubstr("--width: leaves no room"));
  EXPECT_THAT(Refusal({"run/footsteps.csv", "a.pdf"}), HasSubstr("is no table of"));
  EXPECT_THAT(Refusal({"nowhere", "a.pdf"}), HasSubstr("nowhere: no such run folder"));
}

TEST_F(PlotCommandTest, ReplacesOnlyWhatItIsToldTo) {
  WriteText(place_ / "a.pdf", "years of work");
  const Outcome outcome = Plot({"run", "a.pdf"});
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("a.pdf: is there already (--overwrite replaces it)"));
  EXPECT_EQ(ReadText(place_ / "a.pdf"), "years of work");
  EXPECT_EQ(Plot({"run", "a.pdf", "--overwrite"}).status, kSuccess);
  EXPECT_THAT(ReadText(place_ / "a.pdf"), testing::StartsWith("%PDF"));
}

TEST_F(PlotCommandTest, DrawsComparisonsAndHalfStepTables) {
  ASSERT_EQ(Halfstep(place_.path(), {"compare", "run", "--out", "c", "--quiet"}).status, kSuccess);
  for (const std::string what : {"durations", "profiles", "anytime"}) {
    SCOPED_TRACE(what);
    CheckPage(PlaceFigure(FigureWith({what}, {}, "c"), TextWidth));
  }
  const Figure durations = FigureWith({}, {}, "c");
  ASSERT_EQ(durations.rows.size(), 1u);
  const Panel& panel = durations.rows[0][0];
  const ParsedCsv table(ReadText(place_ / "c/comparison.csv"));
  ASSERT_EQ(panel.areas.size(), table.size());
  for (size_t i = 0; i < table.size(); ++i) {
    EXPECT_NEAR(panel.areas[i].corners[1].x(),
                table.Number(i, "duration_s") / table.Number(0, "duration_s"), 1e-12);
  }
  EXPECT_THAT(RefusalOf([&] { FigureWith({"walk"}, {}, "c"); }),
              HasSubstr("--what: 'walk' is unknown (valid: durations, profiles, anytime)"));
  WriteText(place_ / "steps.csv", "half_step,x_m,y_m,yaw_rad\n1,0.2,-0.2,0\n2,0.1,-0.25,-0.5\n");
  const Figure steps = FigureWith({}, {}, "steps.csv");
  EXPECT_EQ(steps.rows[0][0].marks.size(), 3u);
  EXPECT_EQ(steps.rows[0][0].marks[0].at, Eigen::Vector2d(0.2, 0.2));  // right of the left sole
  CheckPage(PlaceFigure(steps, TextWidth));
}

}  // namespace
}  // namespace halfstep::plot
