#include "experiments/server/client_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "experiments/server/message_fields.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

Scene TwoBars() {
  Scene scene;
  for (const char* name : {"bar", "board"}) {
    Obstacle bar{.name = name, .shape = Box{{0.1, 0.2, 0.3}}};
    bar.X_WO.translation().x() = 2.0;
    scene.obstacles.push_back(bar);
  }
  scene.no_step.resize(2);
  return scene;
}

ClientMessageReader ReaderOf(const std::string& source) {
  LiveOptions options;
  options.sensing.source = source;
  return {TwoBars(), options};
}

std::string WhyRefused(const std::string& source, const std::string& text) {
  try {
    ReaderOf(source).Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ClientMessage, IsReadAsItIsMeant) {
  const ClientMessageReader reader = ReaderOf("stand_in");
  const auto subscribe = std::get<Subscribe>(
      reader.Read(R"({"type":"subscribe","state_period_s":0.02,"motion_s":2})"));
  EXPECT_EQ(subscribe.state_period, 0.02);
  EXPECT_EQ(subscribe.motion, 2.0);
  const auto carry = std::get<Carry>(
      std::get<Edit>(reader.Read(R"({"type":"carry","obstacle":"board","xyz_m":[1,-2,0.5]})")));
  EXPECT_EQ(carry.obstacle, 1U);
  EXPECT_EQ(carry.to, Eigen::Vector3d(1, -2, 0.5));
  EXPECT_EQ(carry.turn, 0.0);
  EXPECT_FALSE(std::get<Hold>(reader.Read(R"({"type":"release"})")).held);
  EXPECT_TRUE(std::holds_alternative<TellVolumes>(reader.Read(R"({"type":"volumes"})")));
  EXPECT_TRUE(std::holds_alternative<End>(reader.Read(R"({"type":"end"})")));
  EXPECT_TRUE(std::holds_alternative<Again>(reader.Read(R"({"type":"again"})")));
}

TEST(ClientMessage, CommandsAreEventsOfAScript) {
  for (const char* source : {"stand_in", "client"}) {
    const ClientMessageReader reader = ReaderOf(source);
    const auto event = [&](const char* text) {
      return std::get<Command>(std::get<Edit>(reader.Read(text))).event;
    };
    const ScriptEvent walk =
        event(R"({"type":"walk","vx_m_s":0.1,"vy_m_s":-0.05,"yaw_rad_s":0.2})");
    EXPECT_EQ(walk.what, "walk");
    EXPECT_EQ(walk.velocity, (std::vector<double>{0.1, -0.05, 0.2}));
    const ScriptEvent follow =
        event(R"({"type":"follow","path_m":[[0,0],[1,0.5]],"speed_m_s":0.1})");
    EXPECT_EQ(follow.path.col(1), Eigen::Vector2d(1, 0.5));
    EXPECT_EQ(follow.speed, 0.1);
    const ScriptEvent listed = event(
        R"({"type":"footsteps","footsteps":[{"foot":"right","x_m":0.2,"y_m":-0.1,"yaw_deg":90}]})");
    ASSERT_EQ(listed.footsteps.size(), 1U);
    EXPECT_EQ(listed.footsteps[0].side, Side::kRight);
    EXPECT_NEAR(listed.footsteps[0].X_WF.yaw, M_PI / 2, 1e-15);
  }
}

// Other policies know no courses.
TEST(ClientMessage, CommandsAreOfThePolicyReplan) {
  LiveOptions options;
  options.policy = "paper";
  const ClientMessageReader reader(TwoBars(), options);
  EXPECT_THROW(reader.Read(R"({"type":"walk","vx_m_s":0,"vy_m_s":0,"yaw_rad_s":0})"), InputError);
}

TEST(ClientMessage, AMeasurementTellsEverythingThatIsThere) {
  const auto frame = std::get<MeasuredFrame>(
      ReaderOf("client").Read(R"({"type":"measured","age_s":0.01,"obstacles":[
        {"name":"board","xyz_m":[1,2,3],"quaternion_wxyz":[0,0,0,1]}, {"name":"bar","xyz_m":[0,0,0]}
        ],"goal":{"x_m":1,"y_m":2},"areas":[2]})"));
  ASSERT_EQ(frame.seen.size(), 2U);
  EXPECT_EQ(frame.seen[0].obstacle, 0U);
  EXPECT_EQ(frame.seen[0].X_WO.linear(), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_EQ(frame.seen[0].X_WO.translation(), Eigen::Vector3d::Zero());
  EXPECT_EQ(frame.seen[1].X_WO.linear()(0, 0), -1.0);
  EXPECT_EQ(frame.goal, Eigen::Vector2d(1, 2));
  EXPECT_EQ(frame.areas, std::vector<size_t>{1});
}

struct Refused {
  const char* source;
  const char* text;
  const char* why;
};

class BadMessage : public testing::TestWithParam<Refused> {};
TEST_P(BadMessage, IsRefusedWithASentence) {
  EXPECT_THAT(WhyRefused(GetParam().source, GetParam().text), HasSubstr(GetParam().why));
}
INSTANTIATE_TEST_SUITE_P(
    Messages, BadMessage,
    testing::Values(
        Refused{"stand_in", "", "is not JSON"}, Refused{"stand_in", "{", "is not JSON"},
        Refused{"stand_in", "[]", "is no object"}, Refused{"stand_in", "{}", "type: is missing"},
        Refused{"stand_in", "\xff", "is not JSON"},
        Refused{"stand_in", "{\"type\":\"\xff\"}", "is not JSON"},
        Refused{"stand_in", R"({"type":1})", "type: is no text"},
        Refused{"stand_in", R"({"type":"measured"})", "'measured' is not taken here"},
        Refused{"client", R"({"type":"carry"})", "'carry' is not taken here"},
        Refused{"stand_in", R"({"type":"end","type":"end"})", "'type' stands twice"},
        Refused{"stand_in", R"({"type":"end","now":1})", "end.now: unknown key"},
        Refused{"stand_in", R"({"type":"volumes","of":1})", "volumes.of: unknown key"},
        Refused{"stand_in", R"({"type":"goal","x_m":1,"y":2})", "goal.y_m: is missing"},
        Refused{"stand_in", R"({"type":"goal","x_m":NaN,"y_m":2})", "is not JSON"},
        Refused{"stand_in", R"({"type":"goal","x_m":1e999,"y_m":2})", "too large"},
        Refused{"stand_in", R"({"type":"goal","x_m":1e308,"y_m":2})", "goal.x_m: is not a number"},
        Refused{"stand_in", R"({"type":"goal","x_m":"1","y_m":2})", "goal.x_m: is not a number"},
        Refused{"stand_in", R"({"type":"walk","vx_m_s":0.1,"vy_m_s":0})",
                "walk.yaw_rad_s: is missing"},
        Refused{"stand_in", R"({"type":"walk","vx_m_s":3,"vy_m_s":0,"yaw_rad_s":0})",
                "walk.vx_m_s: is not a number in its range (valid: from -2 to 2)"},
        Refused{"stand_in", R"({"type":"follow","path_m":[[0,0]],"speed_m_s":0.1})",
                "follow.path_m: is no list of 2 to 1000 lists"},
        Refused{"stand_in", R"({"type":"follow","path_m":[[0,0],[0,0]],"speed_m_s":0.1})",
                "follow.path_m: has a point twice in a row"},
        Refused{"stand_in", R"({"type":"follow","path_m":[[0,0],[1]],"speed_m_s":0.1})",
                "follow.path_m: item 2 is no list of 2"},
        Refused{"stand_in", R"({"type":"footsteps","footsteps":[]})", "from 1 to 100"},
        Refused{"stand_in", R"({"type":"footsteps","footsteps":[{"foot":"middle"}]})",
                "footsteps[0].foot: 'middle' (valid: left, right)"},
        Refused{"stand_in", R"({"type":"carry","obstacle":"bat","xyz_m":[0,0,0]})",
                "'bat' is not in the scene"},
        Refused{"stand_in", R"({"type":"carry","obstacle":"bar","xyz_m":[0,0]})",
                "xyz_m: is no list of 3"},
        Refused{"stand_in", R"({"type":"add","xyz_m":[0,null,0]})", "xyz_m: item 2"},
        Refused{"stand_in", R"({"type":"subscribe","state_period_s":0.001,"motion_s":0})",
                "shorter than the control period"},
        Refused{"stand_in", R"({"type":"subscribe","state_period_s":0,"motion_s":11})",
                "from 0 to 10"},
        Refused{"client", R"({"type":"measured","age_s":-1,"obstacles":[]})", "measured.age_s"},
        Refused{"client", R"({"type":"measured","age_s":0,"obstacles":{}})", "is no list"},
        Refused{"client", R"({"type":"measured","age_s":0,"obstacles":[1]})", "obstacles[0]"},
        Refused{"client",
                R"({"type":"measured","age_s":0,"obstacles":[{"name":"bar","xyz_m":[0,0,0]},
                {"name":"bar","xyz_m":[0,0,0]}]})",
                "obstacles[1].name: stands there twice"},
        Refused{"client",
                R"({"type":"measured","age_s":0,"obstacles":[{"name":"bar","xyz_m":[0,0,0],
                "quaternion_wxyz":[0,0,0,0]}]})",
                "has the length 0"},
        Refused{"client", R"({"type":"measured","age_s":0,"obstacles":[],"areas":[3]})", "areas"},
        Refused{"client", R"({"type":"measured","age_s":0,"obstacles":[],"areas":[1,1]})",
                "stands there twice"},
        Refused{"client", R"({"type":"measured","age_s":0,"obstacles":[],"areas":[1.5]})",
                "areas"}));

TEST(ClientMessage, IsRefusedWhenItIsTooDeepOrTooLong) {
  EXPECT_THAT(WhyRefused("stand_in", std::string(100'000, '[')), HasSubstr("nests too deeply"));
  const std::string nine = R"({"type":"end","a":[[[[[[[[]]]]]]]]})";
  EXPECT_THAT(WhyRefused("stand_in", nine), HasSubstr("nests too deeply"));
  EXPECT_THAT(WhyRefused("stand_in", std::string(kMostMessageBytes + 1, ' ')),
              HasSubstr("valid: at most 1048576"));
}

// Whatever is cut off, swapped or put in: it is read, or refused by an InputError.
TEST(ClientMessage, AnyTextIsReadOrRefused) {
  const std::string good =
      R"({"type":"measured","age_s":0.5,"obstacles":[{"name":"bar","xyz_m":[1,2e1,-3],)"
      R"("quaternion_wxyz":[1,0,0,0]}],"goal":{"x_m":1,"y_m":2},"areas":[1,2]})";
  const ClientMessageReader reader = ReaderOf("client");
  std::mt19937 random(1);
  const std::string bytes = "{}[]\",:0123456789eE+-.truefalsn\\u\n \xff\xc3";
  int read = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = good;
    for (int change = 0; change < 1 + i % 4; ++change) {
      const size_t at = random() % text.size();
      const char byte = bytes[random() % bytes.size()];
      if (random() % 3 == 0) {
        text.erase(at, 1 + random() % 8);
      } else if (random() % 2 == 0) {
        text.insert(at, 1, byte);
      } else {
        text[at] = byte;
      }
      if (text.empty()) text = " ";
    }
    try {
      reader.Read(text);
      ++read;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace halfstep
