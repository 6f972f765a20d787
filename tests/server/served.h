#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "experiments/report/report_page.h"
#include "experiments/run/exit_status.h"
#include "experiments/server/server.h"
#include "tests/experiments/child_process.h"
#include "tests/live/small_files.h"
#include "tests/patterns.h"
#include "tests/replaced.h"
#include "tests/server/test_client.h"
#include "tests/temporary_folder.h"

namespace halfstep {

inline std::string TextOf(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// An episode of the small world with a bar beside the way, in a process that serves it by a port
/// and a socket.
class Served {
 public:
  explicit Served(double goal_x = 1.2, const std::vector<std::string>& more = {}) {
    WriteSmallWorld(place_.path(), "");
    const std::filesystem::path config = place_ / "small.yaml";
    WriteText(config, Replaced(ReadText(config), "x_m: 1.2", "x_m: " + std::to_string(goal_x)));
    const std::filesystem::path screen = place_ / "screen.txt";
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
  std::filesystem::path folder() const { return place_ / "one"; }
  const std::filesystem::path place() const { return place_.path(); }

  Outcome Wait() { return child_->Wait(); }
  void Signal(int signal) { child_->Signal(signal); }

  // Ends the episode when the robot has come to the end of its walk, and checks its record.
  void EndInTheGoal(Connection* client) {
    client->SendLine({{"type", "subscribe"}, {"state_period_s", 0.05}, {"motion_s", 0}});
    client->ReadUntil(
        "state", [&](const nlohmann::json& one) { return one["t_s"] > client->walk_duration(); });
    client->SendLine({{"type", "end"}});
    const nlohmann::json end = client->ReadUntil("end");
    EXPECT_EQ(end["ending"], "arrived");
    EXPECT_EQ(Wait().status, kSuccess);
    ExpectItVerifies();
  }
  void ExpectItVerifies() const {
    const Outcome verified = Halfstep(place_.path(), {"verify", "one"});
    EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
    EXPECT_FALSE(std::filesystem::exists(place_ / "walk.sock"));
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

}  // namespace halfstep
