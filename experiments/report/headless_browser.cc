#include "experiments/report/headless_browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "wpg/files/leftovers.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Chromium reads its commands from one and writes its answers to the other.
constexpr int kCommands = 3, kAnswers = 4;
constexpr std::chrono::seconds kPatience(180);  // for one answer, on a slow machine

[[noreturn]] void FailBySystem(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

std::vector<std::string> WordsOf(const fs::path& program, const fs::path& folder, int width,
                                 int height) {
  std::vector<std::string> words = {
      program.string(), "--headless=new", "--remote-debugging-pipe", "--no-first-run",
      // WebGL in software where there is no graphics card.
      "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--force-device-scale-factor=1", "--hide-scrollbars", "--disable-dev-shm-usage",
      "--disable-extensions", "--mute-audio",
      "--window-size=" + std::to_string(width) + "," + std::to_string(height),
      "--user-data-dir=" + (folder / "profile").string()};
  // Chromium's sandbox does not start for root.
  if (geteuid() == 0) words.push_back("--no-sandbox");
  words.push_back("about:blank");
  return words;
}

// This process's variables, but with the folders for what else a browser leaves behind.
std::vector<std::string> VariablesOf(const fs::path& folder) {
  constexpr std::array<const char*, 3> kFolders = {
      "TMPDIR=", "XDG_CONFIG_HOME=", "XDG_CACHE_HOME="};
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (std::ranges::none_of(kFolders, [&](const char* name) { return text.starts_with(name); })) {
      variables.emplace_back(text);
    }
  }
  for (const char* name : kFolders) variables.push_back(name + folder.string());
  return variables;
}

std::vector<char*> PointersTo(std::vector<std::string>* texts) {
  std::vector<char*> pointers;
  for (std::string& text : *texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// In the new process: only what is safe between fork and exec.
[[noreturn]] void BecomeBrowser(char* const* argv, char* const* variables, int commands,
                                int answers, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, fd);
  // Both may have the other's number.
  const int safe_commands = fcntl(commands, F_DUPFD, 10);
  const int safe_answers = fcntl(answers, F_DUPFD, 10);
  dup2(safe_commands, kCommands);
  dup2(safe_answers, kAnswers);
  for (const int fd : {safe_commands, safe_answers}) close(fd);
  execve(argv[0], argv, variables);
  _exit(127);
}

}  // namespace

std::optional<fs::path> FindBrowser(std::string_view path) {
  for (const char* name :
       {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"}) {
    for (size_t from = 0; from <= path.size();) {
      const size_t to = std::min(path.find(':', from), path.size());
      const fs::path program = fs::path(path.substr(from, to - from)) / name;
      if (program.is_absolute() && fs::is_regular_file(program) &&
          access(program.c_str(), X_OK) == 0) {
        return program;
      }
      from = to + 1;
    }
  }
  return std::nullopt;
}

HeadlessBrowser::HeadlessBrowser(const fs::path& program, const fs::path& folder, int width,
                                 int height, std::stop_token stop)
    : stop_(std::move(stop)) {
  std::array<int, 2> commands, answers;
  if (pipe2(commands.data(), O_CLOEXEC) != 0) FailBySystem("no pipe");
  if (pipe2(answers.data(), O_CLOEXEC) != 0) FailBySystem("no pipe");
  std::vector<std::string> words = WordsOf(program, folder, width, height);
  std::vector<std::string> variables = VariablesOf(folder);
  const std::vector<char*> argv = PointersTo(&words), envp = PointersTo(&variables);
  signal(SIGPIPE, SIG_IGN);  // a browser that has ended is told by its answers
  const pid_t parent = getpid();
  process_.pid = fork();
  if (process_.pid == 0) BecomeBrowser(argv.data(), envp.data(), commands[0], answers[1], parent);
  for (const int fd : {commands[0], answers[1]}) close(fd);
  process_.to = commands[1];
  process_.from = answers[0];
  if (process_.pid < 0) FailBySystem("no process for " + program.string());
  AddLeftoverGroup(process_.pid);
  const json target = Send("Target.createTarget", {{"url", "about:blank"}});
  session_ = Send("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
                 .at("sessionId")
                 .get<std::string>();
  Send("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

HeadlessBrowser::Process::~Process() {
  for (const int fd : {to, from}) {
    if (fd >= 0) close(fd);
  }
  if (pid <= 0) return;
  ForgetLeftoverGroup(pid);
  kill(-pid, SIGKILL);
  waitpid(pid, nullptr, 0);
  // Its helpers may still write into the profile until they are gone.
  for (int i = 0; i < 100 && kill(-pid, 0) == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void HeadlessBrowser::Load(const fs::path& file, std::string_view query) {
  Send("Page.navigate", {{"url", "file://" + fs::absolute(file).string() + std::string(query)}});
  Evaluate(
      "document.readyState === 'complete' || new Promise((done) => "
      "window.addEventListener('load', () => done(true)))");
}

json HeadlessBrowser::Evaluate(const std::string& expression) {
  const json answer =
      Send("Runtime.evaluate",
           {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) {
    const json& details = answer["exceptionDetails"];
    std::string text = details.value(json::json_pointer("/exception/description"),
                                     details.value("text", "an exception"));
    if (text.starts_with("Error: ")) text.erase(0, 7);
    throw std::runtime_error(text.substr(0, text.find('\n')));
  }
  return answer.value(json::json_pointer("/result/value"), json());
}

json HeadlessBrowser::Send(const std::string& method, json parameters) {
  json message = {{"id", ++last_id_}, {"method", method}, {"params", std::move(parameters)}};
  if (!session_.empty()) message["sessionId"] = session_;
  const std::string text = message.dump() + '\0';
  for (size_t sent = 0; sent < text.size();) {
    const ssize_t some = write(process_.to, text.data() + sent, text.size() - sent);
    if (some < 0 && errno == EINTR) continue;
    if (some < 0) throw std::runtime_error("the browser does not start, or has ended");
    sent += static_cast<size_t>(some);
  }
  while (true) {
    json answer = Receive();
    if (answer.value("id", 0) != last_id_) continue;  // an event
    if (answer.contains("error")) {
      throw std::runtime_error("the browser refuses " + method + ": " +
                               answer["error"].value("message", ""));
    }
    return answer.value("result", json::object());
  }
}

json HeadlessBrowser::Receive() {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  std::vector<char> part(1 << 16);
  while (true) {
    const size_t zero = received_.find('\0');
    if (zero != std::string::npos) {
      json message = json::parse(received_.substr(0, zero));
      received_.erase(0, zero + 1);
      return message;
    }
    if (stop_.stop_requested()) throw Stopped();
    if (std::chrono::steady_clock::now() > end) {
      throw std::runtime_error("the browser does not answer");
    }
    pollfd ready = {.fd = process_.from, .events = POLLIN, .revents = 0};
    if (poll(&ready, 1, 100) <= 0) continue;
    const ssize_t some = read(process_.from, part.data(), part.size());
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) throw std::runtime_error("the browser does not start, or has ended");
    received_.append(part.data(), static_cast<size_t>(some));
  }
}

}  // namespace halfstep
