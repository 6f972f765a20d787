// A client that controls the simulated robot of an episode. No test asserts seconds.
#include "experiments/server/client_control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <thread>

#include "experiments/commands/commands.h"
#include "experiments/control/controller_lost.h"
#include "experiments/replay/simulation.h"
#include "experiments/run/exit_status.h"
#include "experiments/server/server.h"
#include "tests/experiments/child_process.h"
#include "tests/live/small_files.h"
#include "tests/places.h"
#include "tests/server/test_client.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using control::ControllerLost;
using control::JointCommand;
using control::MeasuredState;
using control::PlannedState;
using nlohmann::json;
using testing::HasSubstr;

Commanded AnswerTo(long number) {
  return {.number = number,
          .q = {Vector6d::Constant(0.1), Vector6d::Zero()},
          .speeds = {Vector6d::Zero(), Vector6d::Zero()}};
}

// Asks for 0.25 s.
JointCommand AskOnce(ClientControl* control) {
  const std::array<Vector6d, 2> zero = {Vector6d::Zero(), Vector6d::Zero()};
  MeasuredState measured;
  measured.q = measured.speeds = zero;
  PlannedState next;
  next.t = 0.25;
  next.q = next.speeds = next.torques = zero;
  next.ankle_moments = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  next.X_WB.setIdentity();
  next.X_WSole = {next.X_WB, next.X_WB};
  return control->Ask(measured, next, next);
}

// Why there is no command when the client does something.
template <typename Does>
std::string WhyLost(const ClientControl::Options& options, const Does& does) {
  ClientControl control(options, {.wake = [] {}, .wait = [](const std::string&) {}});
  does(&control);
  try {
    AskOnce(&control);
  } catch (const ControllerLost& lost) {
    return lost.what();
  }
  return "";
}

TEST(ClientControl, AnswersAreThoseOfTheirQuestions) {
  std::string waited;
  ClientControl control(
      {}, {.wake = [] {}, .wait = [&waited](const std::string& reason) { waited = reason; }});
  auto command = std::async(std::launch::async, [&] { return AskOnce(&control); });
  while (!control.asks()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  control.Begin();
  const auto messages = control.TakeMessages();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(json::parse(*messages[0])["n"], 1);
  EXPECT_EQ(json::parse(*messages[0])["next"]["t_s"], 0.25);
  EXPECT_THROW(control.Answer(AnswerTo(2)), InputError);
  control.Answer(AnswerTo(1));
  EXPECT_EQ(command.get().q[0], Vector6d::Constant(0.1));
  EXPECT_EQ(waited, "no client controls the robot yet");
  EXPECT_FALSE(control.asks());
  EXPECT_THROW(control.Answer(AnswerTo(1)), InputError);
  control.Answer(AnswerTo(2));  // early, and taken when it is asked for
  EXPECT_EQ(AskOnce(&control).q[0], Vector6d::Constant(0.1));
}

TEST(ClientControl, NoAnswerIsTold) {
  EXPECT_EQ(WhyLost({}, [](ClientControl* control) { control->Lose("it has gone"); }),
            "it has gone");
  EXPECT_EQ(WhyLost({.patience = 0.01}, [](ClientControl*) {}),
            "no client controlled the robot within 0.01 s");
  EXPECT_EQ(WhyLost({.patience = 0.01}, [](ClientControl* control) { control->Begin(); }),
            "the client that controls the robot did not answer within 0.01 s, asked for 0.250 s");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(WhyLost({.stop = stop.get_token()}, [](ClientControl*) {}),
            "no client controlled the robot");
}

/// An episode of three steps in a process whose robot a client of the socket controls.
class ControlledEpisode : public testing::Test {
 protected:
  void SetUp() override {
    if (!WhyNoServer().empty()) GTEST_SKIP() << WhyNoServer();
    if (!replay::WhyNoSimulation().empty()) GTEST_SKIP() << replay::WhyNoSimulation();
    WriteSmallWorld(place_.path(), "");
    const std::filesystem::path config = place_ / "small.yaml";
    WriteText(config, Replaced(ReadText(config), "x_m: 1.2", "x_m: 0.45"));
  }

  std::vector<std::string> Words(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"live", "small.yaml", "--out", "one", "--overwrite"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  void Begin(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = Words({"--in-physics", "--controller", "client", "--serve",
                                            "walk.sock", "--servos", "10000,300"});
    words.insert(words.end(), more.begin(), more.end());
    child_ = std::make_unique<Child>(words, Child::Options{.working_directory = place_.path()});
  }
  Connection Connected() const {
    for (int tries = 0;; ++tries) {
      try {
        return Connection::ToSocket(place_ / "walk.sock");
      } catch (const std::runtime_error&) {
        if (tries > 30'000) throw;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
  }
  // What the episode tells when the client answers the first question so.
  Outcome AnsweredBy(const std::string& answer, const std::vector<std::string>& more = {}) {
    Begin(more);
    Connection client = Connected();
    client.SendLine({{"type", "control"}});
    client.ReadUntil("control");
    if (!answer.empty()) client.Send(answer + "\n");
    const json end = client.ReadUntil("end");
    EXPECT_EQ(end["ending"], "uncontrolled");
    Outcome outcome = child_->Wait();
    EXPECT_THAT(outcome.out, HasSubstr(std::string(end["message"])));
    EXPECT_EQ(outcome.status, kFailed);
    return outcome;
  }

  const TemporaryFolder place_;
  std::unique_ptr<Child> child_;
};

/// The plan itself, a controller in the simulating process.
class PlanAsItIs final : public control::TrackingController {
 public:
  JointCommand Command(const MeasuredState&, const PlannedState&,
                       const PlannedState& next) override {
    return {next.q, next.speeds};
  }
  std::unique_ptr<TrackingController> Clone() const override {
    return std::make_unique<PlanAsItIs>(*this);
  }
};

TEST_F(ControlledEpisode, AnEchoOfThePlanIsThePlanToTheByte) {
  Begin();
  Connection client = Connected();
  client.SendLine({{"type", "control"}});
  const json robot = client.ReadUntil("controlled");
  EXPECT_EQ(robot["servos"], json({10000.0, 300.0}));
  EXPECT_EQ(robot["ankle"], nullptr);
  EXPECT_EQ(robot["joints"][1].size(), 6U);
  double first = 0.0;
  for (;;) {
    const json asked = client.ReadLine();
    ASSERT_FALSE(asked.is_null());
    if (asked["type"] == "end") break;
    if (asked["type"] != "control") continue;
    const json& next = asked["next"];
    if (asked["n"] == 1) first = next["t_s"];
    EXPECT_EQ(asked["measured"]["t_s"], asked["then"]["t_s"]);
    client.SendLine({{"type", "command"},
                     {"n", asked["n"]},
                     {"q_rad", next["q_rad"]},
                     {"speeds_rad_s", next["speeds_rad_s"]}});
  }
  EXPECT_LT(first, 0.0) << "while the robot settles";
  const Outcome outcome = child_->Wait();
  ASSERT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("controller client: off the plan"));
  EXPECT_EQ(Halfstep(place_.path(), {"verify", "one", "--quiet"}).status, kSuccess);

  LiveCommand same;
  same.run = {.config = (place_ / "small.yaml").string(),
              .methods = {},
              .overrides = {},
              .out = (place_ / "two").string(),
              .quiet = true};
  same.in_physics = true;
  same.simulated.robot.servos = {10000.0, 300.0};
  same.simulated.controllers.Add(
      "plan", [](const control::ControlledRobot&) { return std::make_unique<PlanAsItIs>(); });
  same.simulated.controller = "plan";
  ASSERT_EQ(Live(same), kSuccess);
  for (const char* file : {"physics.csv", "events.csv", "trajectory.csv", "worlds.csv"}) {
    EXPECT_EQ(ReadText(place_ / "one" / file), ReadText(place_ / "two" / file)) << file;
  }
}

TEST_F(ControlledEpisode, TheClientThatIsShippedPullsJointsToTheirPlan) {
  if (std::system("command -v python3 > /dev/null") != 0) GTEST_SKIP() << "python3 is absent";
  const auto joints_off = [this](const std::string& gain) {
    Begin({"--json"});
    Connected();
    const std::string command = "python3 " + InSources("experiments/server/controller.py ") +
                                (place_ / "walk.sock").string() + " " + gain + " > " +
                                (place_ / "python.txt").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_THAT(ReadText(place_ / "python.txt"), HasSubstr("controls hrp2 on servos of 10000.0"));
    EXPECT_THAT(ReadText(place_ / "python.txt"), HasSubstr("arrived; the record is in "));
    const Outcome outcome = child_->Wait();
    EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
    return json::parse(outcome.out)["physics"]["tracking"]["most"]["joint_rad"].get<double>();
  };
  EXPECT_LT(joints_off("1"), 0.7 * joints_off("0"));
}

TEST_F(ControlledEpisode, BadAnswersEndItWithASentence) {
  const std::string zeros = "[0,0,0,0,0,0]", both = "[" + zeros + "," + zeros + "]";
  const auto answer = [](const std::string& q, const std::string& speeds) {
    return R"({"type":"command","n":1,"q_rad":)" + q + R"(,"speeds_rad_s":)" + speeds + "}";
  };
  const auto told = [this](const std::string& text) { return AnsweredBy(text).out; };
  EXPECT_THAT(told(answer("[" + zeros + ",[0,0,0,0,0]]", both)),
              HasSubstr("the client that controls the robot answered badly: command.q_rad: item 2 "
                        "is no list of 6 (valid: 2 lists of 6 numbers"));
  EXPECT_THAT(told(answer(both, "[[0,0,null,0,0,0]," + zeros + "]")),
              HasSubstr("command.speeds_rad_s: item 3 of list 1 is not such a number"));
  EXPECT_THAT(told(answer("NaN", both)), HasSubstr("answered badly: message: "));
  EXPECT_EQ(Halfstep(place_.path(), {"verify", "one", "--quiet"}).status, kSuccess);
  EXPECT_THAT(AnsweredBy("", {"--answer-within", "0.1"}).out,
              HasSubstr("did not answer within 0.1 s, asked for -0.5"));
}

TEST_F(ControlledEpisode, AClientThatGoesEndsItAndOneThatDoesNotControlIsRefused) {
  Begin();
  {
    Connection client = Connected(), other = Connected();
    other.SendLine({{"type", "command"}, {"n", 1}, {"q_rad", 0}, {"speeds_rad_s", 0}});
    EXPECT_THAT(std::string(other.ReadUntil("error")["text"]), HasSubstr("command.q_rad: "));
    other.SendLine({{"type", "remove"}, {"obstacle", "bar"}});
    EXPECT_THAT(std::string(other.ReadUntil("error")["text"]),
                HasSubstr("is not taken here, where a client controls a simulated robot (valid: "
                          "command, control, draw, end, hold, release, subscribe, volumes)"));
    client.SendLine({{"type", "control"}});
    client.ReadUntil("control");
    other.SendLine({{"type", "control"}});
    EXPECT_THAT(std::string(other.ReadUntil("error")["text"]),
                HasSubstr("a client controls the robot already"));
  }
  const Outcome outcome = child_->Wait();
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.out, HasSubstr("the client that controls the robot has gone"));
  EXPECT_TRUE(std::filesystem::exists(place_ / "one/physics.csv"));
}

TEST_F(ControlledEpisode, WithoutASocketItIsRefused) {
  const auto refused = [this](const std::vector<std::string>& more) {
    const Outcome outcome = Halfstep(place_.path(), Words(more));
    EXPECT_EQ(outcome.status, kBadInput);
    return outcome.err;
  };
  EXPECT_THAT(refused({"--in-physics", "--controller", "client"}),
              HasSubstr("--controller client: no client can come (valid: with --in-physics and "
                        "--serve)"));
  EXPECT_THAT(refused({"--in-physics", "--serve", "walk.sock"}),
              HasSubstr("--serve: in physics a client controls the robot (valid: with --controller "
                        "client)"));
  EXPECT_THAT(refused({"--serve", "walk.sock", "--answer-within", "1"}),
              HasSubstr("--answer-within: no client is asked (valid: with --controller client)"));
  EXPECT_THAT(refused({"--in-physics", "--controller", "client", "--serve", "walk.sock", "--set",
                       "live.sensing.source=client"}),
              HasSubstr("the world of a simulated robot is measured from it (valid: stand_in)"));
}

}  // namespace
}  // namespace halfstep
