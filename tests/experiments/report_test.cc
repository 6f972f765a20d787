#include "experiments/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/report/drawn_mesh.h"
#include "experiments/report/drawn_rods.h"
#include "experiments/report/report_page.h"
#include "experiments/report/report_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/made_once.h"
#include "tests/experiments/run_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

// Volume inside a closed surface whose triangles are counter-clockwise from outside [m³].
double Volume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const auto& t : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = mesh.vertices.col(t[0]), b = mesh.vertices.col(t[1]);
    volume += a.cross(b).dot(mesh.vertices.col(t[2])) / 6.0;
  }
  return volume;
}

TEST(DrawnMesh, IsInscribedAndNearlyAsLargeAsTheBody) {
  const double pi = std::acos(-1.0), ball = 4.0 / 3.0 * pi * 0.001, disc = pi * 0.01;
  const std::vector<std::pair<ConvexBody, double>> bodies = {
      {MakeBox({0.1, 0.2, 0.3}), 0.006},
      {MakeSphere(0.1), ball},
      {MakeCylinder(0.1, 0.5), 0.5 * disc},
      {MakeCapsule(0.1, 0.5), ball + 0.5 * disc}};
  for (const auto& [body, volume] : bodies) {
    const TriangleMesh mesh = DrawnMesh(body);
    EXPECT_LE(Volume(mesh), volume * (1.0 + 1e-9));
    EXPECT_GE(Volume(mesh), volume * 0.975);
    for (const auto& vertex : mesh.vertices.colwise()) {
      for (const auto& normal : body.normals.colwise()) {
        EXPECT_LE(normal.dot(vertex), Support(body, normal) + 1e-9);
      }
    }
  }
}

TEST(DrawnMesh, AHullWithABallHasNoMoreCornersThanTheHull) {
  ConvexBody body = MakeBox({0.1, 0.2, 0.3});
  body.ball_radius = 0.01;
  const TriangleMesh mesh = DrawnMesh(body);
  EXPECT_EQ(mesh.vertices.cols(), 8);
  EXPECT_GT(Volume(mesh), 0.006 * 1.1);
  for (const auto& vertex : mesh.vertices.colwise()) {
    const Eigen::Vector3d nearest = vertex.cwiseMax(Eigen::Vector3d(-0.05, -0.1, -0.15))
                                        .cwiseMin(Eigen::Vector3d(0.05, 0.1, 0.15));
    EXPECT_NEAR((vertex - nearest).norm(), 0.01, 1e-12) << "on the body's surface";
  }
}

TEST(DrawnMesh, CoarsenedHasAtMostSoManyTrianglesAndStaysWhereItIs) {
  const TriangleMesh mesh = DrawnMesh(MakeSphere(0.5));
  ASSERT_GT(mesh.triangles.cols(), 400);
  const TriangleMesh coarse = Coarsened(mesh, 200);
  EXPECT_LE(coarse.triangles.cols(), 200);
  EXPECT_GE(coarse.triangles.cols(), 40);
  EXPECT_LT(coarse.triangles.maxCoeff(), coarse.vertices.cols());
  EXPECT_GE(Volume(coarse), 0.5 * Volume(mesh));
  EXPECT_EQ(Coarsened(mesh, 10000).triangles, mesh.triangles);
}

// Whether the ends of a rod are within so much of two points of the waist's frame.
bool Joins(const DrawnRod& rod, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return (rod.from_B - from).norm() < 1e-9 && (rod.to_B - to).norm() < 1e-9;
}

TEST(DrawnRods, JoinWhatHangsOnLinksWithoutAShape) {
  RobotModel robot = LoadRobot(InSources("wpg/robots/hrp2.yaml"));
  const std::vector<DrawnRod> rods = DrawnRods(robot);
  // From the chest's joint to the neck's, which has no shape.
  const Eigen::Vector3d chest(0.032, 0, 0.3507), neck(0.025, 0, 0.648);
  EXPECT_EQ(std::ranges::count_if(rods, [&](const DrawnRod& r) { return Joins(r, chest, neck); }),
            1);
  // The forearms are as long as in the URDF, thinner than what hangs on them, and each other's
  // mirror images.
  std::vector<DrawnRod> forearms;
  std::ranges::copy_if(rods, std::back_inserter(forearms), [](const DrawnRod& rod) {
    return rod.from_B.z() < 0.3 && std::abs(rod.from_B.y()) > 0.2 && rod.to_B.z() > 0;
  });
  ASSERT_EQ(forearms.size(), 2u);
  for (const DrawnRod& rod : forearms) {
    EXPECT_NEAR((rod.to_B - rod.from_B).norm(), 0.25, 1e-9);
    EXPECT_EQ(rod.leg, -1);
    EXPECT_GT(rod.radius, 0.01);
    EXPECT_LT(rod.radius, 0.04);
  }
  EXPECT_NEAR(forearms[0].to_B.y(), -forearms[1].to_B.y(), 1e-9);
  // Where the robot's file is gone none is drawn, and nothing is thrown.
  robot.files[0].path = "/none/hrp2.yaml";
  EXPECT_TRUE(DrawnRods(robot).empty());
}

// The data of a page.
json DataOf(const std::string& page) {
  const std::string begin = "id=\"data\">";
  const size_t from = page.find(begin) + begin.size();
  return json::parse(page.substr(from, page.find("</script", from) - from));
}

TEST(WalkJson, NumbersTooLargeToDrawAreGaps) {
  const TemporaryFolder place;
  WriteText(place / "certificate.json",
            R"({"verdict": 0, "message": 0, "statement": 0, "demanded": 0, "limits": 0,
                "statements": 0, "not_covered": []})");
  WriteText(place / "half_steps.csv", "half_step\n1\n");
  WriteText(place / "trajectory.csv",
            "t_s,support,zmp_x_m\n0,both,-1e300\n0.02,both,0.5\n0.04,both,nan\n0.06,both,1e12\n"
            "0.08,both,0.25\n");
  const json walk = WalkJson(place.path(), 0.02);
  EXPECT_EQ(walk["columns"]["zmp_x_m"]["delta"], json({nullptr, 50000, nullptr, nullptr, -25000}));
}

size_t Count(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class ReportTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!HasReport()) GTEST_SKIP() << "this build has no report";
  }
  // A short run in `run`.
  std::string MakeRun() {
    CopyMadeOnce(place_.path(), {"run", ShippedConfig("fig5_box"), "--out", "run", "--quiet"});
    return ReadText(place_ / "run/report.html");
  }
  // The same around an obstacle of another name, its scene beside it.
  std::string MakeRunAround(const std::string& obstacle) {
    std::string scene = ReadText(InSources("experiments/scenes/box.yaml"));
    scene.replace(scene.find("- name: box"), 11, "- name: " + json(obstacle).dump());
    WriteText(place_ / "box.yaml", scene);
    const Outcome outcome =
        Halfstep(place_.path(), {"run", ShippedConfig("fig5_box"), "--out", "run", "--quiet",
                                 "--set", "scene=" + (place_ / "box.yaml").string()});
    EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
    return ReadText(place_ / "run/report.html");
  }
  TemporaryFolder place_;
};

TEST_F(ReportTest, TextsCannotLeaveTheirPlace) {
  const std::string hostile = "</script><script>alert(1)</script><!--\"'\\\n\u2028&amp;\xff";
  const std::string page = ReportPage({{hostile, hostile}}), plain = ReportPage({{"a", "b"}});
  EXPECT_EQ(Count(page, "<"), Count(plain, "<"));
  const json data = DataOf(page);
  EXPECT_EQ(data.begin().value(), hostile.substr(0, hostile.size() - 1) + "\uFFFD");
}

TEST_F(ReportTest, HoldsWhereObstaclesGo) {
  const Outcome outcome =
      Halfstep(place_.path(), {"run", ShippedConfig("crossing"), "--out", "run", "--quiet", "--set",
                               "smoothing.methods=[dichotomy]"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  const json data = DataOf(ReadText(place_ / "run/report.html"));
  const json& obstacles = data["scenes"][0]["obstacles"];
  EXPECT_EQ(obstacles[1]["places"].dump(),
            "[[0.0,0.68,-1.0,0.9,0.0],[10.0,0.68,1.0,0.9,0.52359878]]");
  // About its own origin: 0.3 × 0.4 × 0.3 m, in 0.1 mm.
  EXPECT_EQ(obstacles[1]["vertices"][0].get<long>() * obstacles[1]["vertices"][0].get<long>(),
            1500 * 1500);
}

TEST_F(ReportTest, HoldsTheWalksOfTheRun) {
  const std::string obstacle = "<img src=x onerror=alert(1)> \"&'";
  const json data = DataOf(MakeRunAround(obstacle));
  ASSERT_EQ(data["cases"].size(), 1u);
  EXPECT_EQ(data["cases"][0]["walks"].size(), 3u);
  EXPECT_EQ(data["scenes"][0]["obstacles"][0]["name"], obstacle);
  const json& walk = data["cases"][0]["walks"][1];
  EXPECT_EQ(walk["summary"]["method"], "dichotomy");
  EXPECT_EQ(walk["certificate"]["verdict"], "certified");
  EXPECT_THAT(walk["overlaps"][0]["limited_by"].get<std::string>(), HasSubstr(obstacle));
  // The nearest pair is that of the row with the least clearance.
  const json& nearest = walk["nearest"][0];
  EXPECT_EQ(nearest["family"], "clearance");
  EXPECT_EQ(nearest["between"][1], obstacle);
  const ParsedCsv rows(ReadText(place_ / "run/dichotomy/trajectory.csv"));
  double least = 1.0;
  for (size_t i = 0; i < rows.size(); ++i) least = std::min(least, rows.Number(i, "clearance_m"));
  EXPECT_NEAR(nearest["margin_m"].get<double>(), least, 1e-6);
  Eigen::Vector3d between;
  for (int k = 0; k < 3; ++k) {
    between[k] = nearest["points"][0][k].get<double>() - nearest["points"][1][k].get<double>();
  }
  EXPECT_NEAR(between.norm(), least, 1e-5);
  // What is proved of a family is no more than what any row has.
  const json& proved = walk["certificate"]["proved"];
  EXPECT_LE(proved["clearance"]["least"].get<double>(), least);
  EXPECT_GE(proved["clearance"]["least"].get<double>(),
            walk["certificate"]["demanded"]["clearance"].get<double>());
  // Columns add up to the trajectory's rows, every fourth and the last.
  for (const std::string column : {"t_s", "com_x_m", "right_foot_z_m", "q_RLEG_JOINT3_rad"}) {
    const json& shown = walk["columns"][column];
    ASSERT_EQ(shown["delta"].size(), (rows.size() - 1 + 3) / 4 + 1);
    long sum = 0;
    for (size_t i = 0; i < shown["delta"].size(); ++i) {
      sum += shown["delta"][i].get<long>();
      EXPECT_NEAR(static_cast<double>(sum) * 1e-5,
                  rows.Number(std::min(4 * i, rows.size() - 1), column), 0.51e-5);
    }
  }
}

TEST_F(ReportTest, IsMadeAnewWithTheSameBytes) {
  const std::string page = MakeRun();
  EXPECT_LT(page.size(), 2'000'000u);
  fs::remove(place_ / "run/report.html");
  const Outcome outcome = Halfstep(place_.path(), {"report", "run"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_EQ(outcome.out, "written: run/report.html\n");
  EXPECT_TRUE(ReadText(place_ / "run/report.html") == page);
  ASSERT_EQ(Halfstep(place_.path(), {"report", "run", "--out", "a.html"}).status, kSuccess);
  EXPECT_TRUE(ReadText(place_ / "a.html") == page);
  const Outcome again = Halfstep(place_.path(), {"report", "run", "--out", "a.html"});
  EXPECT_EQ(again.status, kFailed);
  EXPECT_THAT(again.err, HasSubstr("a.html: is there already (--overwrite replaces it)"));
}

TEST_F(ReportTest, RefusesWhatIsNoLongerTheRun) {
  MakeRun();
  const auto refusal = [&] {
    const Outcome outcome = Halfstep(place_.path(), {"report", "run", "--out", "a.html"});
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_FALSE(fs::exists(place_ / "a.html"));
    return outcome.err;
  };
  const std::string rows = ReadText(place_ / "run/dichotomy/trajectory.csv");
  WriteText(place_ / "run/dichotomy/trajectory.csv", rows.substr(0, rows.size() - 9));
  EXPECT_THAT(refusal(), HasSubstr("trajectory.csv"));
  WriteText(place_ / "run/dichotomy/trajectory.csv", rows);
  const fs::path scene = place_ / "run/inputs/scene/box.yaml";
  WriteText(scene, ReadText(scene) + "# changed\n");
  EXPECT_THAT(refusal(), HasSubstr("the files of the scene are not those of this run"));
  fs::remove(place_ / "run/manifest.json");
  EXPECT_THAT(refusal(), HasSubstr("run: no such run folder"));
}

TEST_F(ReportTest, ComparisonWithAnotherSceneKeepsItsTables) {
  MakeRun();
  ASSERT_EQ(Halfstep(place_.path(), {"compare", "run", "--out", "one"}).status, kSuccess);
  const json drawn = DataOf(ReadText(place_ / "one/report.html"))["cases"][0];
  EXPECT_EQ(drawn["walks"].size(), 3u);
  EXPECT_TRUE(drawn["walks"][2].contains("columns"));
  const fs::path scene = place_ / "run/inputs/scene/box.yaml";
  WriteText(scene, ReadText(scene) + "# changed\n");
  ASSERT_EQ(Halfstep(place_.path(), {"compare", "run", "--out", "two"}).status, kSuccess);
  const json tables = DataOf(ReadText(place_ / "two/report.html"))["cases"][0];
  EXPECT_THAT(tables["not_drawn"].get<std::string>(), HasSubstr("the files of the scene"));
  EXPECT_EQ(tables["walks"][1]["summary"], drawn["walks"][1]["summary"]);
  EXPECT_FALSE(tables["walks"][2].contains("columns"));
}

}  // namespace
}  // namespace halfstep
