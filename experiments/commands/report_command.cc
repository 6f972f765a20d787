#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/live/episode_reader.h"
#include "experiments/live/episode_report.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/report/report.h"
#include "experiments/report/report_page.h"
#include "experiments/report/sweep_report.h"
#include "experiments/report/walk_video.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/run/interrupt.h"
#include "experiments/tables/json_file.h"
#include "experiments/tables/run_folder.h"
#include "experiments/tables/run_record.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/whole_file.h"

namespace halfstep {

namespace fs = std::filesystem;

namespace {

// Writes the page into the folder itself, and its hash into the manifest.
template <typename Write>
void WriteInto(const fs::path& folder_path, const Place& place, const Write& write) {
  RunFolder folder(folder_path, /*overwrite=*/true);
  folder.CopyOlder();
  write(&folder);
  CompleteManifest(place.robot, place.scene, &folder);
  folder.Publish();
}

void ReportOfRun(const ReportCommand& command, const fs::path& run) {
  const Place place = PlaceOfRun(run, command.tools);
  if (command.out) {
    WriteWhole(*command.out, {RunReport(place.robot, place.scene, run, command.tools)});
  } else {
    WriteInto(run, place,
              [&](RunFolder* f) { WriteReport(place.robot, place.scene, f, command.tools); });
  }
}

// Drawn with today's files, which must be those that the episode was about.
void CheckSame(const std::vector<InputFile>& files, const std::string& what,
               const fs::path& episode) {
  const fs::path path = episode / "manifest.json";
  if (ReadJsonObject(path).value(what + "_sha256", nlohmann::json()) == CombinedSha256(files)) {
    return;
  }
  throw InputError({path.string() + ": the files of the " + what +
                    " are not those of this episode (valid: as they were when it was made)"});
}

void ReportOfEpisode(const ReportCommand& command, const fs::path& folder) {
  const LiveConfig config = LoadLiveConfig((folder / "config.yaml").string(), {}, command.tools);
  const Place place = LoadEpisodePlace(config);
  CheckSame(place.robot.files, "robot", folder);
  CheckSame(place.scene.files, "scene", folder);
  const Episode episode = ReadEpisode(folder, config, place);
  if (command.out) {
    WriteWhole(*command.out, {EpisodeReport(episode, config, place, folder)});
  } else {
    WriteInto(folder, place, [&](RunFolder* f) { WriteEpisodeReport(episode, config, place, f); });
  }
}

// A line that the next one replaces, where it is a person who reads; in a log about ten lines.
void TellFrames(int done, int frames) {
  if (isatty(STDERR_FILENO) == 1) {
    std::cerr << "\rframe " << done << " of " << frames << (done == frames ? "\n" : "")
              << std::flush;
  } else if (done == frames || done * 10 / frames > (done - kFramesAtOnce) * 10 / frames) {
    std::cerr << "frame " << done << " of " << frames << '\n';
  }
}

// "1280x720" as the size of a video.
void ReadSize(const std::string& text, VideoOptions* options) {
  constexpr int kLeast = 160, kMost = 4096;
  int width = 0, height = 0;
  const char* const end = text.data() + text.size();
  const auto [cross, no_width] = std::from_chars(text.data(), end, width);
  const bool crossed = no_width == std::errc() && cross != end && *cross == 'x';
  const auto [rest, no_height] = std::from_chars(crossed ? cross + 1 : end, end, height);
  const auto fits = [](int edge) { return edge >= kLeast && edge <= kMost && edge % 2 == 0; };
  if (!crossed || no_height != std::errc() || rest != end || !fits(width) || !fits(height)) {
    throw InputError(
        {"--video-size: " + text +
         " (valid: WIDTHxHEIGHT, two even numbers from 160 to 4096, such as 1280x720)"});
  }
  options->width = width;
  options->height = height;
}

ExitStatus Video(const ReportCommand& command, const fs::path& run, const fs::path& out) {
  InterruptGuard interrupt;
  interrupt.Keep();  // a folder is to be removed
  const Place place = PlaceOfRun(run, command.tools);
  const std::optional<std::string> video =
      WalkVideo(RunReport(place.robot, place.scene, run, command.tools), command.options,
                command.quiet ? VideoProgress() : TellFrames, interrupt.token());
  if (!video) {
    std::cerr << "halfstep: stopped; nothing is written\n";
    return kInterrupted;
  }
  WriteWhole(out, {*video});
  return kSuccess;
}

// The mistakes that a command line may have.
void CheckOptions(const ReportCommand& command, const fs::path& run) {
  if (!command.video) {
    const VideoOptions none;
    const char* given =
        !command.options.show.empty() ? "--show"
        : command.options.seconds     ? "--seconds"
        : command.options.width != none.width || command.options.height != none.height
            ? "--video-size"
        : command.options.rate != none.rate ? "--video-rate"
                                            : nullptr;
    if (given != nullptr) {
      throw InputError({std::string(given) + ": there is no video (valid: with --video OUT.webm)"});
    }
    return;
  }
  if (command.out) throw InputError({"--video: not with --out (valid: one of them)"});
  if (fs::path(*command.video).extension() != ".webm") {
    throw InputError({"--video: " + *command.video + " (valid: a name that ends in .webm)"});
  }
  if (IsEpisode(run) || IsSweep(run)) {
    throw InputError(
        {"--video: " + command.run + " is an episode or a sweep (valid: a run folder)"});
  }
}

}  // namespace

ExitStatus Report(const ReportCommand& command) {
  const fs::path run(command.run);
  if (!fs::is_directory(run) || !fs::exists(run / "manifest.json")) {
    throw InputError({command.run + ": no such run folder (" + DidYouMeanRun(command.run) +
                      "valid: a folder that `halfstep run`, `live` or `sweep` wrote)"});
  }
  if (!HasReport()) {
    throw std::runtime_error(
        "this build has no report: npm was not there or could not fetch its packages when it was "
        "configured, or HALFSTEP_REPORT was OFF");
  }
  CheckOptions(command, run);
  const std::optional<std::string>& named = command.video ? command.video : command.out;
  const fs::path out = named ? fs::path(*named) : run / "report.html";
  if (out.empty()) throw InputError({"--out: no file is named (valid: a path)"});
  if (named && !command.overwrite && fs::exists(fs::symlink_status(out))) {
    throw std::runtime_error(out.string() + ": is there already (--overwrite replaces it)");
  }
  if (command.video) {
    if (const ExitStatus status = Video(command, run, out); status != kSuccess) return status;
  } else if (IsSweep(run)) {
    WriteWhole(out, {SweepReport(run, out)});
  } else if (IsEpisode(run)) {
    ReportOfEpisode(command, run);
  } else {
    ReportOfRun(command, run);
  }
  if (!command.quiet) std::cout << "written: " << out.string() << '\n';
  return kSuccess;
}

CommandAction DeclareReport(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<ReportCommand>();
  command->tools = tools;
  app->add_option("RUN", command->run, "folder of a run, an episode or a sweep")->required();
  app->add_option("--out", command->out, "the file (default: report.html in that folder)");
  app->add_option("--video", command->video,
                  "a WebM of the walk in place of the page; needs chromium");
  app->add_option("--seconds", command->options.seconds,
                  "how long the video lasts [s] (default: as long as the walk)")
      ->check(CLI::Range(0.1, 3600.0));
  const auto size = std::make_shared<std::string>();
  app->add_option("--video-size", *size, "its width and height [px] (default: 1280x720)");
  app->add_option("--video-rate", command->options.rate, "its frames a second (default: 30)")
      ->check(CLI::Range(1, 120));
  app->add_option("--show", command->options.show,
                  "what the video shows, as after # in the address that the page's \"copy link\" "
                  "copies: 'a=raw&b=none&camera=side' (default: as the page opens)");
  app->add_flag("--overwrite", command->overwrite, "replace --out or --video");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command, size] {
    if (!size->empty()) ReadSize(*size, &command->options);
    return Report(*command);
  };
}

}  // namespace halfstep
