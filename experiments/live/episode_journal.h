#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "experiments/live/episode.h"
#include "experiments/live/episode_tables.h"
#include "experiments/live/live_config.h"
#include "wpg/files/descriptor.h"

namespace halfstep {

/// Holds the journal of an episode as long as it lives, so that no other process does.
class EpisodeJournalLock {
 public:
  /// Throws std::runtime_error when another process holds it, or when there is no such folder.
  explicit EpisodeJournalLock(const std::filesystem::path& folder);

 private:
  Descriptor folder_;
};

/// The folder "NAME.unfinished" beside an episode's folder NAME, in which its record is written
/// while it goes on, so that a process that is killed leaves what happened until then: the tables
/// of the episode, config.yaml, and clock.csv with the time of the latest tick. Rows are appended
/// after each tick, in the order in which they refer to each other, and not synced: the record
/// outlives the process, not the machine. `halfstep recover` makes the folder of it.
class EpisodeJournal {
 public:
  /// Where the journal of an episode lies that will be written into the folder `episode`.
  static std::filesystem::path FolderOf(const std::filesystem::path& episode);

  /// `episode` is the path NAME. With `overwrite` an older journal that no process writes is
  /// removed. Throws std::runtime_error when there is one otherwise, or when files cannot be
  /// written.
  EpisodeJournal(const std::filesystem::path& episode, const LiveConfig& config, bool overwrite);

  /// Appends what is new since the last tick. A robot that walks does not stop for a full disk:
  /// when something cannot be written, nothing more is, and failure() says so.
  void Write(const EpisodeTick& tick);
  /// Why nothing is written any more; "" while all is well.
  const std::string& failure() const { return failure_; }

  /// Removes it: to be called when the folder of the episode is there.
  void Remove();

 private:
  void AppendNew(const EpisodeTick& tick);
  void Append(const EpisodeTable& table);

  std::filesystem::path folder_;
  EpisodeJournalLock lock_;
  std::map<std::string, Descriptor> files_;
  Descriptor clock_;
  EpisodeProgress written_;
  std::string failure_;
};

}  // namespace halfstep
