#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

namespace halfstep {

/// The first of chromium, chromium-browser, google-chrome, google-chrome-stable that a folder of
/// `path` (as the variable PATH) has as an executable file.
std::optional<std::filesystem::path> FindBrowser(std::string_view path);

/// A Chromium without a screen that shows one page from a file; driven by the DevTools protocol
/// over two pipes, without a port. It ends with this object, and with this process however that
/// ends. Its profile is in `folder`, which must be there and outlive it.
class HeadlessBrowser {
 public:
  /// Opens a page of `width` times `height` pixels. Throws std::runtime_error with a sentence when
  /// the browser does not start or does not answer.
  HeadlessBrowser(const std::filesystem::path& program, const std::filesystem::path& folder,
                  int width, int height, std::stop_token stop);
  HeadlessBrowser(const HeadlessBrowser&) = delete;
  HeadlessBrowser& operator=(const HeadlessBrowser&) = delete;

  /// Shows a file, and returns when it is loaded. `query`: what its address ends in, "?…", which
  /// the page may read. Throws as the constructor.
  void Load(const std::filesystem::path& file, std::string_view query = "");

  /// What an expression of JavaScript is in the page, once it is settled if it is a promise. Throws
  /// as the constructor, and for what the page throws; Stopped when a stop was requested.
  nlohmann::json Evaluate(const std::string& expression);

  /// Thrown at a stop request.
  struct Stopped {};

 private:
  nlohmann::json Send(const std::string& method, nlohmann::json parameters);
  nlohmann::json Receive();

  // The browser and what it is driven by; ends it.
  struct Process {
    ~Process();
    pid_t pid = -1;
    int to = -1, from = -1;  // pipes
  };

  std::stop_token stop_;
  Process process_;
  std::string received_, session_;
  int last_id_ = 0;
};

}  // namespace halfstep
