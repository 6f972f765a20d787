#include "planner/swept/swept_volume_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "planner/swept/swept_volume_bytes.h"
#include "tests/planner/swept_volume_draws.h"
#include "wpg/files/checked_file.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const SweptVolumeOptions kVeryCoarse{.cell = 0.08, .displacement = 0.05};

// HRP-2's feet alone: quickly baked.
const RobotModel& SmallRobot() {
  static const RobotModel robot = [] {
    RobotModel small = SweptRobot();
    std::erase_if(small.bodies, [](const RobotBody& b) { return b.leg < 0 || b.link < 5; });
    small.self_pairs.clear();
    return small;
  }();
  return robot;
}

StepSet TwoHalfSteps() {
  StepSet set = FewHalfSteps();
  set.placements.resize(2);
  return set;
}

std::string Read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void Write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string Bytes(const SweptVolumes& volumes) {
  std::string bytes;
  for (const auto& volume : volumes.down) bytes += VolumeBytes(volume);
  for (const auto& volume : volumes.up) bytes += VolumeBytes(volume);
  return bytes;
}

class SweptVolumeCacheTest : public ::testing::Test {
 protected:
  SweptVolumeCacheTest() {
    static std::atomic<int> counter{0};
    folder_ = fs::temp_directory_path() /
              ("halfstep-swept-" + std::to_string(getpid()) + "-" + std::to_string(counter++));
    fs::create_directories(folder_);
  }
  ~SweptVolumeCacheTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  CachedVolumes Get(BakeHooks hooks = {.threads = 1}, const RobotModel& robot = SmallRobot(),
                    const SweptVolumeOptions& options = kVeryCoarse) const {
    return LoadOrBakeSweptVolumes(robot, LipmOf(robot), TwoHalfSteps(), options, folder_.string(),
                                  hooks);
  }
  static const std::string& Truth() {
    static const std::string bytes = Bytes(*BakeSweptVolumes(
        SmallRobot(), LipmOf(SmallRobot()), TwoHalfSteps(), kVeryCoarse, {.threads = 1}));
    return bytes;
  }

  fs::path folder_;
};

TEST_F(SweptVolumeCacheTest, SecondTimeIsReadAndTheSame) {
  const CachedVolumes first = Get();
  ASSERT_TRUE(first.volumes);
  EXPECT_TRUE(first.baked);
  EXPECT_EQ(first.refused + first.not_kept, "");
  EXPECT_EQ(Bytes(*first.volumes), Truth());
  const CachedVolumes second = Get();
  ASSERT_TRUE(second.volumes);
  EXPECT_FALSE(second.baked);
  EXPECT_EQ(second.path, first.path);
  EXPECT_EQ(Bytes(*second.volumes), Truth());
  // Only the file itself is left.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(SweptVolumeCacheTest, AnyNumberOfThreadsBakesTheSame) {
  const auto volumes = BakeSweptVolumes(SmallRobot(), LipmOf(SmallRobot()), TwoHalfSteps(),
                                        kVeryCoarse, {.threads = 3});
  EXPECT_EQ(Bytes(*volumes), Truth());
}

TEST_F(SweptVolumeCacheTest, OtherRobotOptionsOrPlacementsAreAnotherFile) {
  const std::string path = Get().path;
  const auto provenance = [](const RobotModel& robot, const StepSet& set) {
    return SweptVolumeProvenance(robot, LipmOf(robot), set, kVeryCoarse);
  };
  RobotModel robot = SmallRobot();
  robot.bodies.back().shape.vertices(0, 0) += 1e-12;
  EXPECT_NE(provenance(robot, TwoHalfSteps()), provenance(SmallRobot(), TwoHalfSteps()));
  EXPECT_NE(provenance(SmallRobot(), FewHalfSteps()), provenance(SmallRobot(), TwoHalfSteps()));
  SweptVolumeOptions options = kVeryCoarse;
  options.clearance = 0.006;
  const CachedVolumes other = Get({.threads = 1}, SmallRobot(), options);
  EXPECT_NE(other.path, path);
  // A file under a name that is not its own is stale.
  fs::rename(other.path, path);
  const CachedVolumes again = Get();
  EXPECT_TRUE(again.baked);
  EXPECT_THAT(again.refused, HasSubstr("stale"));
  EXPECT_THAT(again.refused, HasSubstr("`clearance "));
  EXPECT_EQ(Bytes(*again.volumes), Truth());
}

TEST_F(SweptVolumeCacheTest, BitFlipsEverywhereAreRefused) {
  const std::string path = Get().path;
  const std::string whole = Read(path);
  const std::string provenance =
      SweptVolumeProvenance(SmallRobot(), LipmOf(SmallRobot()), TwoHalfSteps(), kVeryCoarse);
  ASSERT_TRUE(ReadCheckedFile(path, provenance).body);
  SweptDraw draw(1);
  // Magic, length, header, body, checksum: each byte at either end, and many between.
  for (int k = 0; k < 150; ++k) {
    const int size = static_cast<int>(whole.size());
    const int at = k < 60 ? k : k < 100 ? size - 1 - (k - 60) : draw.Index(size);
    std::string damaged = whole;
    damaged[static_cast<size_t>(at)] =
        static_cast<char>(damaged[static_cast<size_t>(at)] ^ (1 << draw.Index(8)));
    Write(path, damaged);
    const CheckedFile file = ReadCheckedFile(path, provenance);
    EXPECT_FALSE(file.body) << "byte " << at;
    EXPECT_THAT(file.refused, HasSubstr("refused")) << "byte " << at;
    EXPECT_EQ(file.refused.find('\n'), std::string::npos);
  }
  const CachedVolumes again = Get();
  EXPECT_TRUE(again.baked);
  EXPECT_THAT(again.refused, HasSubstr("checksum"));
  EXPECT_EQ(Bytes(*again.volumes), Truth());
  EXPECT_EQ(Read(path), whole);
}

TEST_F(SweptVolumeCacheTest, CutFilesAreRefused) {
  const std::string path = Get().path;
  const std::string whole = Read(path);
  const std::string provenance =
      SweptVolumeProvenance(SmallRobot(), LipmOf(SmallRobot()), TwoHalfSteps(), kVeryCoarse);
  for (const size_t size :
       {size_t{0}, size_t{1}, size_t{20}, size_t{60}, whole.size() / 2, whole.size() - 1}) {
    Write(path, whole.substr(0, size));
    const CheckedFile file = ReadCheckedFile(path, provenance);
    EXPECT_FALSE(file.body) << size;
    EXPECT_THAT(file.refused, HasSubstr("refused")) << size;
  }
  const CachedVolumes again = Get();
  EXPECT_TRUE(again.baked);
  EXPECT_EQ(Bytes(*again.volumes), Truth());
}

// A right checksum over wrong volumes: written by a mistaken program.
TEST_F(SweptVolumeCacheTest, VolumesThatMakeNoSenseAreRefused) {
  const std::string path = Get().path;
  const std::string provenance =
      SweptVolumeProvenance(SmallRobot(), LipmOf(SmallRobot()), TwoHalfSteps(), kVeryCoarse);
  const std::string body = *ReadCheckedFile(path, provenance).body;
  // The number of nodes, and the last node's last child.
  for (const size_t at : {size_t{3}, body.size() - 1}) {
    std::string damaged = body;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
    WriteCheckedFile(path, provenance, damaged);
    const CachedVolumes again = Get();
    EXPECT_TRUE(again.baked) << at;
    EXPECT_THAT(again.refused, HasSubstr("make no sense")) << at;
    EXPECT_EQ(Bytes(*again.volumes), Truth());
  }
}

TEST_F(SweptVolumeCacheTest, AStoppedBakeGoesOnWhereItWas) {
  BakeHooks hooks{.threads = 1};
  hooks.progress = [](double done) { return done < 0.4; };
  EXPECT_FALSE(Get(hooks).volumes);
  std::vector<double> seen;
  hooks.progress = [&](double done) { return seen.push_back(done), true; };
  // A damaged part is baked again.
  std::string path;
  for (const auto& entry : fs::directory_iterator(folder_)) path = entry.path().string();
  ASSERT_TRUE(path.ends_with(".parts"));
  const std::string part = path + "/0";
  std::string bytes = Read(part);
  ASSERT_GT(bytes.size(), 100u);
  bytes[bytes.size() / 2] ^= 1;
  Write(part, bytes);
  const CachedVolumes whole = Get(hooks);
  EXPECT_EQ(Bytes(*whole.volumes), Truth());
  EXPECT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen.back(), 1.0);
}

TEST_F(SweptVolumeCacheTest, ElementsAreRecalledNotBakedAgain) {
  std::atomic<int> kept{0};
  BakeHooks hooks{.threads = 1};
  const ElementVolumes empty{.down = BoxTree{}, .up = std::nullopt};
  hooks.recall = [&](int i) { return i == 1 ? std::optional(empty) : std::nullopt; };
  hooks.keep = [&](int, const ElementVolumes&) { ++kept; };
  const auto volumes =
      BakeSweptVolumes(SmallRobot(), LipmOf(SmallRobot()), TwoHalfSteps(), kVeryCoarse, hooks);
  ASSERT_TRUE(volumes);
  EXPECT_EQ(kept, 1);
  EXPECT_TRUE(volumes->down[1]->nodes.empty());
  EXPECT_FALSE(volumes->up[1]);
}

TEST_F(SweptVolumeCacheTest, StopTokenStops) {
  std::stop_source source;
  source.request_stop();
  BakeHooks hooks{.threads = 2};
  hooks.stop = source.get_token();
  EXPECT_FALSE(Get(hooks).volumes);
}

TEST_F(SweptVolumeCacheTest, WhatAHookThrowsEndsTheBake) {
  BakeHooks hooks{.threads = 2};
  hooks.progress = [](double) -> bool { throw std::runtime_error("enough"); };
  EXPECT_THROW(Get(hooks), std::runtime_error);
}

TEST_F(SweptVolumeCacheTest, SeveralBakesAtOnceAgree) {
  std::vector<CachedVolumes> results(2);
  {
    std::vector<std::jthread> bakes;
    for (CachedVolumes& result : results) bakes.emplace_back([&] { result = Get(); });
  }
  for (const CachedVolumes& result : results) {
    ASSERT_TRUE(result.volumes);
    EXPECT_EQ(Bytes(*result.volumes), Truth());
    EXPECT_EQ(result.refused + result.not_kept, "");
  }
  EXPECT_FALSE(Get().baked);
}

TEST_F(SweptVolumeCacheTest, KilledBakesNeverLeaveAWrongVolume) {
  (void)Truth();  // before the processes part
  SweptDraw draw(3);
  for (int trial = 0; trial < 4; ++trial) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      (void)Get();
      _exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(draw.Index(30000)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  const CachedVolumes whole = Get();
  ASSERT_TRUE(whole.volumes);
  EXPECT_EQ(Bytes(*whole.volumes), Truth());
  EXPECT_EQ(whole.refused, "");
}

TEST_F(SweptVolumeCacheTest, AFolderThatCannotBeWrittenCostsTheCacheOnly) {
  Write((folder_ / "file").string(), "x");
  const CachedVolumes result =
      LoadOrBakeSweptVolumes(SmallRobot(), LipmOf(SmallRobot()), TwoHalfSteps(), kVeryCoarse,
                             (folder_ / "file" / "below").string(), {.threads = 1});
  ASSERT_TRUE(result.volumes);
  EXPECT_EQ(Bytes(*result.volumes), Truth());
  EXPECT_THAT(result.not_kept, HasSubstr("cannot be written"));
}

// One after the other, everything that shapes a volume is changed by the least that can be.
TEST_F(SweptVolumeCacheTest, WhateverShapesAVolumeIsInItsKey) {
  struct Key {
    RobotModel robot = SmallRobot();
    double com_height = SmallRobot().com_height;
    StepSet set = TwoHalfSteps();
    SweptVolumeOptions options = kVeryCoarse;
    std::string Text() const {
      return SweptVolumeProvenance(robot, Lipm(com_height), set, options);
    }
  };
  const auto more = [](double& value) { value = std::nextafter(value, 1e9); };
  using Change = std::function<void(Key*)>;
  const std::vector<std::pair<const char*, Change>> changes = {
      {"lipm", [&](Key* k) { more(k->com_height); }},
      {"duration", [&](Key* k) { more(k->set.prototype.duration); }},
      {"via height", [&](Key* k) { more(k->set.prototype.via_height); }},
      {"via lateral", [&](Key* k) { more(k->set.prototype.via_lateral); }},
      {"shift", [&](Key* k) { more(k->set.prototype.shape.shift); }},
      {"delay", [&](Key* k) { more(k->set.prototype.shape.foot_delay); }},
      {"bump", [&](Key* k) { k->set.prototype.shape.bump_ramp = 0.2; }},
      {"foot ramp", [&](Key* k) { more(k->set.prototype.shape.foot_ramp); }},
      {"lift share", [&](Key* k) { more(k->set.prototype.shape.lift_share); }},
      {"support offset", [&](Key* k) { more(k->set.prototype.shape.support_point); }},
      {"x", [&](Key* k) { more(k->set.placements[1].x); }},
      {"y", [&](Key* k) { more(k->set.placements[1].y); }},
      {"yaw", [&](Key* k) { more(k->set.placements[1].yaw); }},
      {"order", [&](Key* k) { std::swap(k->set.placements[0], k->set.placements[1]); }},
      {"cell", [&](Key* k) { more(k->options.cell); }},
      {"displacement", [&](Key* k) { more(k->options.displacement); }},
      {"clearance", [&](Key* k) { more(k->options.clearance); }},
      {"shortest interval", [&](Key* k) { more(k->options.shortest_interval); }},
      {"axis", [&](Key* k) { more(k->robot.legs[1].joints[4].axis_B.y()); }},
      {"point", [&](Key* k) { more(k->robot.legs[1].joints[4].point_B.z()); }},
      {"link", [&](Key* k) { more(k->robot.legs[0].joints[5].X_BLink(2, 3)); }},
      {"hip", [&](Key* k) { more(k->robot.legs[0].hip_B.x()); }},
      {"ankle", [&](Key* k) { more(k->robot.legs[0].ankle_B.x()); }},
      {"sole", [&](Key* k) { more(k->robot.legs[0].X_BSole(0, 3)); }},
      {"knee", [&](Key* k) { k->robot.legs[0].branch.knee ^= 1; }},
      {"ankle branch", [&](Key* k) { k->robot.legs[0].branch.ankle ^= 1; }},
      {"hip branch", [&](Key* k) { k->robot.legs[0].branch.hip ^= 1; }},
      {"waist", [&](Key* k) { more(k->robot.waist_height); }},
      {"com", [&](Key* k) { more(k->robot.com_x_B); }},
      {"body's leg", [&](Key* k) { k->robot.bodies[0].leg ^= 1; }},
      {"body's link", [&](Key* k) { --k->robot.bodies[0].link; }},
      {"vertex", [&](Key* k) { more(k->robot.bodies[0].shape.vertices(1, 2)); }},
      {"normal", [&](Key* k) { more(k->robot.bodies[0].shape.normals(1, 2)); }},
      {"disc", [&](Key* k) { more(k->robot.bodies[0].shape.disc_radius); }},
      {"ball", [&](Key* k) { more(k->robot.bodies[0].shape.ball_radius); }},
  };
  const std::string text = Key().Text();
  for (const auto& [what, change] : changes) {
    Key key;
    change(&key);
    EXPECT_NE(key.Text(), text) << what;
  }
}

}  // namespace
}  // namespace halfstep
