#include "experiments/live/episode_journal.h"

#include <sys/file.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "experiments/live/episode_files.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr char kClock[] = "clock.csv";

[[noreturn]] void Fail(const fs::path& path) {
  throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(errno));
}

// Makes the folder, which nothing may have the name of.
fs::path Made(const fs::path& episode, bool overwrite) {
  const fs::path folder = EpisodeJournal::FolderOf(episode);
  if (fs::exists(fs::symlink_status(folder))) {
    const EpisodeJournalLock lock(folder);
    if (!overwrite) {
      throw std::runtime_error(folder.string() +
                               ": is the record of an episode that was killed (`halfstep recover` "
                               "keeps it, --overwrite removes it)");
    }
    fs::remove_all(folder);
  }
  fs::create_directories(folder.parent_path());
  if (!fs::create_directory(folder)) Fail(folder);
  return folder;
}

void WriteAll(int file, std::string_view text, const fs::path& shown) {
  while (!text.empty()) {
    const ssize_t written = write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) Fail(shown);
    text.remove_prefix(static_cast<size_t>(written));
  }
}

void WriteNew(const fs::path& path, std::string_view text) {
  fs::create_directories(path.parent_path());
  const Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL);
  if (file.get() < 0) Fail(path);
  WriteAll(file.get(), text, path);
}

}  // namespace

EpisodeJournalLock::EpisodeJournalLock(const fs::path& folder)
    : folder_(folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW) {
  if (folder_.get() < 0) Fail(folder);
  if (flock(folder_.get(), LOCK_EX | LOCK_NB) != 0) {
    throw std::runtime_error(folder.string() + ": another process writes it");
  }
}

fs::path EpisodeJournal::FolderOf(const fs::path& episode) {
  fs::path name = fs::absolute(episode).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();  // a trailing slash
  return name += ".unfinished";
}

EpisodeJournal::EpisodeJournal(const fs::path& episode, const LiveConfig& config, bool overwrite)
    : folder_(Made(episode, overwrite)),
      lock_(folder_),
      clock_(folder_ / kClock, O_WRONLY | O_CREAT | O_EXCL) {
  if (clock_.get() < 0) Fail(folder_ / kClock);
  WriteNew(folder_ / "config.yaml", ResolvedFor(folder_, config));
}

void EpisodeJournal::Append(const EpisodeTable& table) {
  const fs::path path = folder_ / (table.name + ".csv");
  const auto [file, is_new] = files_.try_emplace(table.name, path, O_WRONLY | O_CREAT | O_APPEND);
  if (file->second.get() < 0) Fail(path);
  std::string_view text = table.file.text;
  if (!is_new) text.remove_prefix(text.find('\n') + 1);  // the header
  WriteAll(file->second.get(), text, path);
}

void EpisodeJournal::Write(const EpisodeTick& tick) {
  if (!failure_.empty()) return;
  try {
    AppendNew(tick);
  } catch (const std::exception& error) {
    failure_ = error.what();
  }
}

void EpisodeJournal::AppendNew(const EpisodeTick& tick) {
  const EpisodeProgress now = EpisodeProgress::Of(tick.record);
  if (now != written_) {
    for (size_t walk = written_.walks; walk < now.walks; ++walk) {
      for (const EpisodeTable& table : WalkTables(tick.record, walk)) {
        WriteNew(folder_ / (table.name + ".csv"), table.file.text);
      }
    }
    for (const EpisodeTable& table : EpisodeTables(tick.record, written_)) Append(table);
    written_ = now;
  }
  // Of one length always, so that the file is never cut.
  const std::string time =
      Formatted("waited_s,now_s\n%024.17g,%024.17g\n", tick.record.waited, tick.now);
  if (pwrite(clock_.get(), time.data(), time.size(), 0) != static_cast<ssize_t>(time.size())) {
    Fail(folder_ / kClock);
  }
}

void EpisodeJournal::Remove() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace halfstep
