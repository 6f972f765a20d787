#include "experiments/report/walk_video.h"

#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "experiments/report/headless_browser.h"
#include "wpg/check.h"
#include "wpg/files/input_error.h"
#include "wpg/files/leftovers.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A folder of its own for the page and the browser's profile, gone with this object, and when a
// signal ends the process. Its name is short: Chromium does not start where the paths of its
// sockets, below it, have more than 107 characters.
class VideoFolder {
 public:
  VideoFolder() {
    std::string name = (fs::temp_directory_path() / "halfstep_video_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), name);
    }
    path_ = name;
    AddLeftover(path_);
  }
  ~VideoFolder() {
    // Again where the browser's last process has made a file meanwhile.
    std::error_code failed;
    for (int i = 0; i < 20; ++i) {
      fs::remove_all(path_, failed);
      if (!failed) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ForgetLeftover(path_);
  }
  VideoFolder(const VideoFolder&) = delete;
  VideoFolder& operator=(const VideoFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

int Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  HALFSTEP_CHECK(c == '+' || c == '/', "no digit of base64: " << c);
  return c == '+' ? 62 : 63;
}

}  // namespace

std::string FromBase64(std::string_view text) {
  std::string bytes;
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<uint32_t>(Digit(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

std::optional<std::string> WalkVideo(std::string_view page, const VideoOptions& options,
                                     const VideoProgress& progress, std::stop_token stop) {
  const char* path = std::getenv("PATH");
  const std::optional<fs::path> program = FindBrowser(path == nullptr ? "" : path);
  if (!program) {
    throw std::runtime_error(
        "--video: PATH has no browser that can draw it (install chromium: chromium, "
        "chromium-browser, google-chrome or google-chrome-stable is looked for)");
  }
  const VideoFolder folder;
  const fs::path file = folder.path() / "report.html";
  WriteSynced(file, {page}, file);
  try {
    HeadlessBrowser browser(*program, folder.path(), options.width, options.height,
                            std::move(stop));
    browser.Load(file, "?film");
    const json asked = {{"seconds", options.seconds ? json(*options.seconds) : json(nullptr)},
                        {"show", options.show},
                        {"rate", options.rate}};
    const json begun = browser.Evaluate("halfstepFilm.begin(" + asked.dump() + ")");
    if (begun.contains("unknown")) {
      throw InputError({"--show: " + begun["unknown"].get<std::string>()});
    }
    const int frames = begun.at("frames");
    std::string video;
    for (int done = 0; done < frames;) {
      const json part =
          browser.Evaluate("halfstepFilm.next(" + std::to_string(kFramesAtOnce) + ")");
      video += FromBase64(part.at("bytes").get<std::string>());
      done = part.at("done");
      if (progress) progress(done, frames);
    }
    return video;
  } catch (const HeadlessBrowser::Stopped&) {
    return std::nullopt;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error("--video: " + program->string() + ": " + error.what());
  }
}

}  // namespace halfstep
