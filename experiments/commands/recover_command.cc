#include <iostream>
#include <memory>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/live/episode_files.h"
#include "experiments/live/episode_journal.h"
#include "experiments/live/episode_reader.h"
#include "experiments/live/promise_words.h"
#include "experiments/live/spare_boxes.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {

ExitStatus Recover(const RecoverCommand& command) {
  const std::filesystem::path left = EpisodeJournal::FolderOf(command.episode);
  if (!std::filesystem::is_directory(left)) {
    throw InputError({left.string() +
                      ": no such folder (valid: the name of an episode whose process was killed)"});
  }
  const EpisodeJournalLock lock(left);
  const LiveConfig config = LoadLiveConfig((left / "config.yaml").string(), {}, command.tools);
  const Place place = LoadEpisodePlace(config);
  const Episode episode = ReadJournal(left, config, place);
  RunFolder folder(command.episode, command.overwrite);
  WriteEpisode(episode, config, place, &folder);
  folder.Publish();
  std::error_code ignored;
  std::filesystem::remove_all(left, ignored);
  if (!command.quiet) {
    std::cout << Formatted("recovered %.3f s, ", episode.end) << episode.begun.size()
              << " half-steps; " << PromiseSentence(episode.promise)
              << ", as far as measurements tell\n\nThe files are in " << folder.path().string()
              << "; `halfstep verify` checks them.\n";
  }
  return kSuccess;
}

CommandAction DeclareRecover(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<RecoverCommand>();
  command->tools = tools;
  app->add_option("EPISODE", command->episode, "the folder that the episode would have written")
      ->required();
  app->add_flag("--overwrite", command->overwrite, "replace an older episode of that name");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command] { return Recover(*command); };
}

}  // namespace halfstep
