// `halfstep live` with clients: well behaved ones, and hostile ones. No test asserts seconds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "experiments/live/messages.h"
#include "experiments/report/report_page.h"
#include "experiments/run/exit_status.h"
#include "experiments/server/server.h"
#include "tests/experiments/child_process.h"
#include "tests/live/small_files.h"
#include "tests/patterns.h"
#include "tests/places.h"
#include "tests/server/test_client.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

std::string TextOf(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// An episode of the small world with a bar beside the way, in a process that serves it by a port
// and a socket.
class Served {
 public:
  explicit Served(double goal_x = 1.2, const std::vector<std::string>& more = {}) {
    WriteSmallWorld(place_.path(), "");
    const fs::path config = place_ / "small.yaml";
    WriteText(config, Replaced(ReadText(config), "x_m: 1.2", "x_m: " + std::to_string(goal_x)));
    const fs::path screen = place_ / "screen.txt";
    const int out = open(screen.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    std::vector<std::string> arguments = {"live",   "small.yaml", "--out",    "one",
                                          "--view", "--serve",    "walk.sock"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    child_ = std::make_unique<Child>(
        arguments, Child::Options{.working_directory = place_.path(), .standard_output = out});
    close(out);
    PatternMatch match;
    for (int tries = 0; tries < 30'000; ++tries) {
      const std::string shown = TextOf(screen);
      match = FirstMatch(shown, "http://(127\\.0\\.0\\.1:([0-9]+))/([0-9a-f]{32})/\n");
      if (match && HasEnded(shown)) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (!match) throw std::runtime_error("no address");
    host_ = match[1];
    port_ = std::stoi(match[2]);
    token_ = match[3];
  }

  Connection Socket() const { return Connection::ToSocket(place_ / "walk.sock"); }
  // Of the episode that begins anew, as soon as it is there.
  Connection SocketOfTheNext() const {
    for (int tries = 0; tries < 6'000; ++tries) {
      try {
        return Socket();
      } catch (const std::runtime_error&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
    throw std::runtime_error("no episode began anew");
  }
  Connection Port() const { return Connection::ToPort(port_); }
  const std::string& host() const { return host_; }
  const std::string& token() const { return token_; }
  fs::path folder() const { return place_ / "one"; }
  const fs::path place() const { return place_.path(); }

  Outcome Wait() { return child_->Wait(); }
  void Signal(int signal) { child_->Signal(signal); }

  // Ends the episode when the robot has come to the end of its walk, and checks its record.
  void EndInTheGoal(Connection* client) {
    client->SendLine({{"type", "subscribe"}, {"state_period_s", 0.05}, {"motion_s", 0}});
    client->ReadUntil("state",
                      [&](const json& one) { return one["t_s"] > client->walk_duration(); });
    client->SendLine({{"type", "end"}});
    const json end = client->ReadUntil("end");
    EXPECT_EQ(end["ending"], "arrived");
    EXPECT_EQ(Wait().status, kSuccess);
    ExpectItVerifies();
  }
  void ExpectItVerifies() const {
    const Outcome verified = Halfstep(place_.path(), {"verify", "one"});
    EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
    EXPECT_FALSE(fs::exists(place_ / "walk.sock"));
  }

 private:
  // Everything that is printed at the beginning is there.
  static bool HasEnded(const std::string& shown) {
    return shown.find("clock") != std::string::npos;
  }

  TemporaryFolder place_;
  std::unique_ptr<Child> child_;
  std::string host_, token_;
  int port_ = 0;
};

#define SKIP_WITHOUT_SERVER()                                \
  if (!WhyNoServer().empty()) GTEST_SKIP() << WhyNoServer(); \
  if (!HasReport()) GTEST_SKIP() << "this build has no page"

TEST(ServedEpisode, WaitsForItsFirstClientWhereItIsAskedTo) {
  SKIP_WITHOUT_SERVER();
  Served served(0.3, {"--wait", "--overwrite"});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  Connection client = served.Socket();
  // Before that half-steps are prepared, which a busy machine may still do.
  client.ReadUntil("waiting",
                   [](const json& one) { return one["reason"] == "for its first client"; });
  client.ReadUntil("walk");
  served.EndInTheGoal(&client);
}

// Each of the two is written in a folder of its own.
TEST(ServedEpisode, BeginsAnewAtTheSameAddressWhereAClientAsksForIt) {
  SKIP_WITHOUT_SERVER();
  Served served(0.35);
  Connection client = served.Socket();
  client.ReadUntil("walk");
  client.SendLine({{"type", "again"}});
  EXPECT_EQ(client.ReadUntil("end")["again"], true);
  EXPECT_TRUE(client.ReadLine().is_null());
  Connection next = served.SocketOfTheNext();
  EXPECT_EQ(next.ReadUntil("walk")["walk"], 0);
  Connection web = served.Port();
  web.Send(Get("/" + served.token() + "/", served.host()) + "\r\n");
  EXPECT_THAT(web.ReadAll(), HasSubstr("HTTP/1.1 200 OK"));
  served.EndInTheGoal(&next);
  EXPECT_EQ(Halfstep(served.place(), {"verify", "one_2"}).status, kSuccess);
}

TEST(ServedEpisode, TellsTheSweptVolumesOfEachWalk) {
  SKIP_WITHOUT_SERVER();
  Served served;
  Connection client = served.Socket();
  client.SendLine({{"type", "volumes"}});
  json walk;
  std::set<int> told;
  // Each volume once, and before a walk that has it.
  const auto next = [&] {
    for (;;) {
      json one = client.ReadLine();
      if (one.is_null() || one["type"] == "volumes") return one;
      if (one["type"] == "walk") {
        MakeWhole(std::move(walk), &one);
        walk = one;
      }
      if (one["type"] != "volume") continue;
      EXPECT_TRUE(told.insert(one["volume"].get<int>()).second);
      EXPECT_EQ(one["baked_cell_m"], 0.03);
      EXPECT_LE(one["runs"].size(), 8000U);
      std::int64_t cells = 1, sum = 0;
      for (const json& size : one["size"]) cells *= size.get<int>();
      for (const json& run : one["runs"]) sum += run.get<int>();
      EXPECT_EQ(sum, cells);
    }
  };
  json volumes = next();
  ASSERT_FALSE(volumes.is_null());
  const json& half_steps = volumes["half_steps"];
  EXPECT_EQ(half_steps.size(), walk["half_steps"].size());
  EXPECT_TRUE(half_steps[0].is_null()) << "the start is in no set";
  for (size_t i = 1; i < half_steps.size(); ++i) {
    // On the latest footstep of the other foot.
    const json& swings = walk["footsteps"][i / 2 + 2];
    json stands = walk["footsteps"][i / 2 + 1];
    if (stands["foot"] == swings["foot"]) stands = walk["footsteps"][0];
    EXPECT_NEAR(half_steps[i]["X_WS"][0], stands["x_m"].get<double>(), 1e-9);
    EXPECT_NEAR(half_steps[i]["X_WS"][1], stands["y_m"].get<double>(), 1e-9);
    EXPECT_EQ(half_steps[i]["mirrored"], stands["foot"] == "right");
    EXPECT_EQ(told.count(half_steps[i]["volume"]), 1U);
  }
  EXPECT_EQ(volumes["first_half_step"], 1);
  // A later client is told the walk whole.
  Connection late = served.Socket();
  const json whole = late.ReadUntil("walk");
  EXPECT_EQ(whole["same"], 0);
  EXPECT_EQ(whole["footsteps"].size(), whole["half_steps"].size() / 2 + 2);
  client.SendLine({{"type", "carry"}, {"obstacle", "bar"}, {"xyz_m", {0.75, 0.1, 0.02}}});
  const json before = volumes;
  while (!volumes.is_null() && (walk["walk"] == 0 || walk["kind"] != "changed")) volumes = next();
  EXPECT_NE(volumes["half_steps"], before["half_steps"]);
  client.SendLine({{"type", "end"}});
  client.ReadUntil("end");
  EXPECT_NE(served.Wait().status, kBadInput);
}

TEST(ServedEpisode, ABarThatIsCarriedIntoTheWayIsWalkedAround) {
  SKIP_WITHOUT_SERVER();
  Served served;
  Connection client = served.Socket();
  const json hello = client.ReadLine();
  EXPECT_EQ(hello["type"], "hello");
  EXPECT_EQ(hello["protocol"], 3);
  EXPECT_EQ(hello["source"], "stand_in");
  EXPECT_EQ(hello["spare"].size(), 8U);
  EXPECT_EQ(hello["obstacles"][0]["name"], "bar");
  client.SendLine({{"type", "subscribe"}, {"state_period_s", 0.05}, {"motion_s", 1}});
  client.SendLine({{"type", "draw"}});
  EXPECT_GT(client.ReadUntil("draw")["robot"].size(), 0U);
  const json state =
      client.ReadUntil("state", [](const json& one) { return one["half_step"] == 1; });
  EXPECT_EQ(state["row"].size(), hello["columns"].size());
  client.SendLine({{"type", "carry"}, {"obstacle", "bar"}, {"xyz_m", {0.75, 0.1, 0.02}}});
  client.ReadUntil("event", [](const json& one) { return one["event"] == "contradicted"; });
  const json walk =
      client.ReadUntil("walk", [](const json& one) { return one["kind"] == "changed"; });
  EXPECT_GT(walk["walk"], 0);
  const json motion =
      client.ReadUntil("motion", [&](const json& one) { return one["walk"] >= walk["walk"]; });
  EXPECT_EQ(motion["rows"][0].size(), hello["columns"].size());
  served.EndInTheGoal(&client);
  EXPECT_THAT(TextOf(served.folder() / "config.yaml"), HasSubstr("do: jump"));

  // The same world again, by another clock and another policy.
  const Outcome again =
      Halfstep(served.place(), {"live", "one/config.yaml", "--out", "two", "--set",
                                "live.clock=lockstep", "--set", "live.policy=stop_and_replan"});
  EXPECT_EQ(again.status, kSuccess) << again.out << again.err;
}

TEST(ServedEpisode, HeldTheRobotRestsAndReleasedItWalksOn) {
  SKIP_WITHOUT_SERVER();
  Served served(0.35);
  Connection client = served.Socket();
  client.SendLine({{"type", "subscribe"}, {"state_period_s", 0.05}, {"motion_s", 0}});
  client.ReadUntil("state");
  client.SendLine({{"type", "hold"}});
  client.ReadUntil("state", [](const json& one) { return one["held"] && one["stopped"]; });
  client.SendLine({{"type", "release"}});
  client.ReadUntil("walk", [](const json& one) { return one["walk"] > 0; });
  served.EndInTheGoal(&client);
}

TEST(ServedEpisode, ThePageAndItsMessagesAreWhereTheAddressSays) {
  SKIP_WITHOUT_SERVER();
  Served served(0.35);
  const std::string base = "/" + served.token() + "/", end = "\r\n";
  const std::string origin = "Origin: http://" + served.host() + "\r\n";
  const auto answer = [&](const std::string& request) {
    Connection connection = served.Port();
    connection.Send(request + end);
    return connection.ReadAll();
  };
  const std::string page = answer(Get(base, served.host()));
  EXPECT_THAT(page, HasSubstr("HTTP/1.1 200 OK"));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy: default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("html"));

  const std::string other(32, '0');
  EXPECT_THAT(answer(Get("/", served.host())), HasSubstr("404"));
  EXPECT_THAT(answer(Get("/" + other + "/", served.host())), HasSubstr("404"));
  EXPECT_THAT(answer(Get(base + "../etc", served.host())), HasSubstr("404"));
  EXPECT_THAT(answer(Get("/" + other + "/socket", served.host()) + kUpgrade), HasSubstr("404"));
  EXPECT_THAT(answer(Get(base, "evil.example")), HasSubstr("403"));
  EXPECT_THAT(answer(Get(base, "localhost")), HasSubstr("403"));
  EXPECT_THAT(answer("GET " + base + " HTTP/1.1\r\n"), HasSubstr("403"));
  EXPECT_THAT(answer(Get(base + "socket", served.host()) + kUpgrade + "Origin: http://evil\r\n"),
              HasSubstr("403"));
  EXPECT_THAT(answer(Get(base + "socket", served.host()) + kUpgrade + "Origin: null\r\n"),
              HasSubstr("403"));
  EXPECT_THAT(answer(Get(base + "socket", served.host()) + kUpgrade + origin + origin),
              HasSubstr("403"));
  EXPECT_THAT(answer("POST " + base + " HTTP/1.1\r\nHost: " + served.host() + "\r\n"),
              HasSubstr("405"));

  Connection web = served.Port();
  web.Send(Get(base + "socket", served.host()) + kUpgrade + origin + end);
  EXPECT_THAT(web.ReadPast("\r\n\r\n"), HasSubstr("101"));
  EXPECT_EQ(json::parse(ReadFrame(&web))["type"], "hello");
  web.Send(MaskedFrame(R"({"type":"sing"})"));
  std::string text;
  while ((text = ReadFrame(&web)).find("\"error\"") == std::string::npos) ASSERT_NE(text, "");
  EXPECT_THAT(text, HasSubstr("'sing' is not taken here"));
  Connection client = served.Socket();
  served.EndInTheGoal(&client);
}

// All at once, while the robot walks and a bar is put into its way.
TEST(ServedEpisode, HostileClientsDoNotStopIt) {
  SKIP_WITHOUT_SERVER();
  Served served;
  Connection good = served.Socket();
  good.SendLine({{"type", "subscribe"}, {"state_period_s", 0.05}, {"motion_s", 0}});
  good.ReadUntil("state");
  good.SendLine({{"type", "carry"}, {"obstacle", "bar"}, {"xyz_m", {0.75, 0.1, 0.02}}});
  const std::string socket = Get("/" + served.token() + "/socket", served.host()) + kUpgrade;

  std::vector<Connection> open;
  const auto dropped = [](Connection* one) { one->ReadAll(); };
  {  // malformed, deep, not finite: an answer, and the line stays
    Connection one = served.Socket();
    for (const std::string& text :
         {std::string("\x00\xff garbage", 10), std::string("{\"type\":"), std::string(50'000, '['),
          std::string(R"({"type":"goal","x_m":NaN,"y_m":0})"),
          std::string(R"({"type":"goal","x_m":1e308,"y_m":0})"),
          std::string(R"({"type":"carry","obstacle":"bar","xyz_m":[1e308,-1e308,1e999]})"),
          std::string(R"({"type":"measured","age_s":0,"obstacles":[]})")}) {
      one.Send(text + "\n");
      EXPECT_NE(one.ReadUntil("error")["text"], "");
    }
  }
  {  // a message without end
    Connection one = served.Socket();
    const std::string much(1 << 16, ' ');
    for (int i = 0; i < 64 && one.Send(much); ++i) {
    }
    dropped(&one);
    Connection web = served.Port();
    web.Send(socket + "\r\n");
    web.ReadPast("\r\n\r\n");
    web.Send(std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14));
    dropped(&web);
  }
  {  // frames that no WebSocket has
    Connection web = served.Port();
    web.Send(socket + "\r\n");
    web.ReadPast("\r\n\r\n");
    web.Send(std::string("\xff\x00\x00\x00 garbage", 12));
    dropped(&web);
    Connection header = served.Port();
    header.Send("GET / HTTP/1.1\r\n");
    while (header.Send("X-More: " + std::string(1000, 'x') + "\r\n")) {
    }
  }
  {  // a flood
    Connection one = served.Socket();
    std::string lines;
    for (int i = 0; i < 5000; ++i) lines += "{\"type\":\"sing\"}\n";
    for (int i = 0; i < 20 && one.Send(lines); ++i) {
    }
    dropped(&one);
  }
  {  // one that asks for much and reads nothing
    Connection slow = served.Socket();
    std::string lines;
    for (int i = 0; i < 900; ++i) lines += "{\"type\":\"draw\"}\n";
    slow.Send(lines);
    EXPECT_TRUE(slow.IsDropped());
  }
  for (int i = 0; i < 40; ++i) {  // half a handshake
    open.push_back(served.Port());
    open.back().Send("GET /");
  }
  for (int i = 0; i < 40; ++i) open.push_back(served.Socket());  // too many

  good.SendLine({{"type", "add"}, {"xyz_m", {0.6, 1.5, 0.05}}});
  good.ReadUntil("world", [](const json& one) { return one["obstacles"].size() == 2; });
  served.EndInTheGoal(&good);
}

TEST(ServedEpisode, ClientsMayMeasureInPlaceOfTheStandIn) {
  SKIP_WITHOUT_SERVER();
  if (std::system("command -v python3 > /dev/null") != 0) GTEST_SKIP() << "python3 is absent";
  Served served(0.35, {"--set", "live.sensing.source=client"});
  {
    Connection client = served.Socket();
    EXPECT_EQ(client.ReadLine()["source"], "client");
    EXPECT_THAT(std::string(client.ReadUntil("waiting")["reason"]), testing::Not(""));
    client.SendLine({{"type", "carry"}, {"obstacle", "bar"}, {"xyz_m", {0, 0, 0}}});
    EXPECT_THAT(std::string(client.ReadUntil("error")["text"]), HasSubstr("not taken here"));
    // Measured long before the robot began to wait, as by a client that came while half-steps were
    // prepared.
    const json bar = {{"name", "bar"}, {"xyz_m", {0.75, 2.0, 0.02}}};
    client.SendLine({{"type", "measured"}, {"age_s", 600.0}, {"obstacles", {bar}}});
    EXPECT_LT(client.ReadUntil("world")["measured_s"], -500.0);
  }
  const std::string command = "python3 " + InSources("experiments/server/client.py ") +
                              (served.place() / "walk.sock").string() + " bar=0.75,2,0.02 > " +
                              (served.place() / "python.txt").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(served.Wait().status, kSuccess);
  const std::string shown = TextOf(served.place() / "python.txt");
  // Which walk is the first that it sees hangs on when it comes: planning has begun.
  EXPECT_THAT(shown, testing::ContainsRegex("walk [0-9]+: [0-9]+ rows from "));
  EXPECT_THAT(shown, HasSubstr("arrived; the record is in "));
  served.ExpectItVerifies();
  EXPECT_THAT(TextOf(served.place() / "screen.txt"), testing::Not(HasSubstr("nearest")));
  const Outcome replayed = Halfstep(served.place(), {"replay", "one"});
  EXPECT_NE(replayed.status, kSuccess);
}

// On the way, with the robot far from the goal.
TEST(ServedEpisode, AClientThatEndsItEndsItAsItWasMeant) {
  SKIP_WITHOUT_SERVER();
  Served served;
  Connection client = served.Socket();
  client.SendLine({{"type", "subscribe"}, {"state_period_s", 0.05}, {"motion_s", 0}});
  client.ReadUntil("state");
  client.SendLine({{"type", "end"}});
  const json end = client.ReadUntil("end");
  EXPECT_EQ(end["ending"], "ended");
  EXPECT_THAT(std::string(end["message"]), HasSubstr("a client ended it"));
  EXPECT_EQ(end["promise"], "the promise held");
  EXPECT_EQ(end["promise_status"], "kept");
  const Outcome outcome = served.Wait();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
  served.ExpectItVerifies();
}

TEST(ServedEpisode, CtrlCEndsItAndTellsClients) {
  SKIP_WITHOUT_SERVER();
  Served served;
  Connection client = served.Socket();
  client.SendLine({{"type", "subscribe"}, {"state_period_s", 0.05}, {"motion_s", 0}});
  client.ReadUntil("state");
  served.Signal(SIGINT);
  EXPECT_EQ(client.ReadUntil("end")["ending"], "interrupted");
  EXPECT_EQ(served.Wait().status, kInterrupted);
  served.ExpectItVerifies();
}

TEST(ServedEpisode, WithoutAClientToComeItIsRefused) {
  SmallWorld::Get();
  const TemporaryFolder place;
  std::ofstream(place / "small.yaml") << kSmallConfig;
  const Outcome outcome = Halfstep(
      place.path(), {"live", "small.yaml", "--out", "one", "--set", "live.sensing.source=client"});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("live.sensing.source"));
  EXPECT_FALSE(fs::exists(place / "one"));
}

TEST(ServedEpisode, ASocketThatCannotBeMadeIsRefused) {
  SKIP_WITHOUT_SERVER();
  SmallWorld::Get();
  const TemporaryFolder place;
  std::ofstream(place / "small.yaml") << kSmallConfig;
  std::ofstream(place / "file") << "mine";
  for (const std::string& path :
       {std::string("file"), std::string("no/such/folder"), std::string(200, 'x')}) {
    const Outcome outcome =
        Halfstep(place.path(), {"live", "small.yaml", "--out", "one", "--serve", path});
    EXPECT_EQ(outcome.status, kBadInput) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("--serve: "));
  }
  EXPECT_EQ(TextOf(place / "file"), "mine");
  EXPECT_FALSE(fs::exists(place / "one"));
}

}  // namespace
}  // namespace halfstep
