#include "experiments/tables/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/experiments/child_process.h"
#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

// A run of two files.
void WriteRun(RunFolder* folder, const std::string& text) {
  folder->Write("dichotomy/overlaps.csv", text);
  folder->Write("manifest.json", text);
}

void MakeRun(const fs::path& path, const std::string& text, bool overwrite = false) {
  RunFolder folder(path, overwrite);
  WriteRun(&folder, text);
  folder.Publish();
}

TEST(RunFolder, AppearsWholeAndOnlyWhenPublished) {
  const TemporaryFolder place;
  RunFolder folder(place / "runs/here/a", false);
  WriteRun(&folder, "one");
  EXPECT_FALSE(fs::exists(place / "runs/here/a"));
  folder.Publish();
  EXPECT_THAT(FilesBelow(place.path()),
              ElementsAre("runs/here/a/dichotomy/overlaps.csv", "runs/here/a/manifest.json"));
  EXPECT_EQ(ReadText(place / "runs/here/a/manifest.json"), "one");
  EXPECT_EQ(folder.path(), place / "runs/here/a");
}

TEST(RunFolder, LeavesNothingWhenNotPublished) {
  const TemporaryFolder place;
  {
    RunFolder folder(place / "a", false);
    WriteRun(&folder, "one");
    EXPECT_EQ(NamesIn(place.path()).size(), 1u);
  }
  EXPECT_THAT(NamesIn(place.path()), IsEmpty());
}

TEST(RunFolder, ATrailingSlashIsNoName) {
  const TemporaryFolder place;
  MakeRun(place.path() / "a/", "one");
  MakeRun(place.path() / "b/../b/.", "two");
  EXPECT_THAT(NamesIn(place.path()), ElementsAre("a", "b"));
}

TEST(RunFolder, WritesAllOfALargeFile) {
  const TemporaryFolder place;
  std::string large;
  while (large.size() < 5'000'000) large += std::to_string(large.size()) + "\n";
  MakeRun(place / "a", large);
  EXPECT_TRUE(ReadText(place / "a/manifest.json") == large);
}

TEST(RunFolder, WritesContentThatComesInParts) {
  const TemporaryFolder place;
  RunFolder folder(place / "a", false);
  std::string whole;
  folder.WriteParts("x/parts.csv", [&](const RunFolder::TextSink& add) {
    for (int i = 0; i < 1000; ++i) {
      add(std::to_string(i) + "\n");
      whole += std::to_string(i) + "\n";
    }
  });
  folder.Write("whole.csv", whole);
  const InputFile &parts = folder.written().at("x/parts.csv"),
                  &at_once = folder.written().at("whole.csv");
  EXPECT_EQ(parts.bytes, at_once.bytes);
  EXPECT_EQ(parts.sha256, at_once.sha256);
  EXPECT_EQ(ReadText(folder.staging() / "x/parts.csv"), whole);
}

TEST(RunFolder, RefusesAnExistingFolderAndLeavesItAlone) {
  const TemporaryFolder place;
  MakeRun(place / "a", "old");
  EXPECT_THAT(RefusalOf([&] { RunFolder(place / "a", false); }),
              HasSubstr("a: is there already (--overwrite replaces it)"));
  EXPECT_EQ(ReadText(place / "a/manifest.json"), "old");
  EXPECT_THAT(NamesIn(place.path()), ElementsAre("a"));
}

TEST(RunFolder, OverwritingLeavesNothingOfTheOlderRun) {
  const TemporaryFolder place;
  MakeRun(place / "a", "old");
  WriteText(place / "a/more/left.csv", "old");
  MakeRun(place / "a", "new", true);
  EXPECT_THAT(FilesBelow(place.path()), ElementsAre("a/dichotomy/overlaps.csv", "a/manifest.json"));
  EXPECT_EQ(ReadText(place / "a/manifest.json"), "new");
}

TEST(RunFolder, OverwritingWhatIsNotThereIsFine) {
  const TemporaryFolder place;
  MakeRun(place / "a", "new", true);
  EXPECT_EQ(ReadText(place / "a/manifest.json"), "new");
}

TEST(RunFolder, NeverOverwritesWhatIsNoRun) {
  const TemporaryFolder place;
  WriteText(place / "thesis/chapter.tex", "years of work");
  WriteText(place / "file", "text");
  for (const std::string name : {"thesis", "file"}) {
    EXPECT_THAT(RefusalOf([&] { RunFolder(place / name, true); }),
                HasSubstr(name + ": is not a run folder"));
  }
  EXPECT_THAT(NamesIn(place.path()), ElementsAre("file", "thesis"));
  EXPECT_EQ(ReadText(place / "thesis/chapter.tex"), "years of work");
}

TEST(RunFolder, NeverReplacesARunThatAppearedMeanwhile) {
  const TemporaryFolder place;
  {
    RunFolder folder(place / "a", false);
    WriteRun(&folder, "late");
    WriteText(place / "a/manifest.json", "early");
    EXPECT_THAT(RefusalOf([&] { folder.Publish(); }), HasSubstr("is there already"));
  }
  {
    RunFolder folder(place / "b", true);
    WriteRun(&folder, "late");
    WriteText(place / "b/notes.txt", "no run");
    EXPECT_THAT(RefusalOf([&] { folder.Publish(); }), HasSubstr("is not a run folder"));
  }
  EXPECT_THAT(FilesBelow(place.path()), ElementsAre("a/manifest.json", "b/notes.txt"));
  EXPECT_EQ(ReadText(place / "a/manifest.json"), "early");
}

TEST(RunFolder, RemovesWhatKilledRunsOfTheSameNameLeft) {
  const TemporaryFolder place;
  const std::string digits = "0123456789abcdef";
  const std::string kept[] = {".a.partial-123", ".b.partial-" + digits, ".a.partial-x"};
  WriteText(place / (".a.partial-" + digits) / "raw/trajectory.csv", "half a li");
  for (const std::string& name : kept) WriteText(place / name / "f", "");
  MakeRun(place / "a", "one");
  EXPECT_THAT(NamesIn(place.path()), testing::UnorderedElementsAre("a", kept[0], kept[1], kept[2]));
}

TEST(RunFolder, NeitherFollowsNorReplacesALink) {
  const TemporaryFolder place;
  MakeRun(place / "precious", "old");
  fs::create_directory_symlink("precious", place / "link");
  fs::create_symlink("nowhere", place / "dangling");
  for (const std::string name : {"link", "dangling"}) {
    for (const bool overwrite : {false, true}) {
      EXPECT_THAT(RefusalOf([&] { RunFolder(place / name, overwrite); }),
                  HasSubstr(name + ": is a link, which is not followed"));
    }
    EXPECT_TRUE(fs::is_symlink(place / name));
  }
  {
    RunFolder folder(place / "late", true);
    WriteRun(&folder, "new");
    fs::create_directory_symlink("precious", place / "late");
    EXPECT_THAT(RefusalOf([&] { folder.Publish(); }), HasSubstr("is a link"));
  }
  EXPECT_EQ(ReadText(place / "precious/manifest.json"), "old");
}

TEST(RunFolder, ARunThatHoldsALinkIsNotRewritten) {
  const TemporaryFolder place;
  MakeRun(place / "a", "old");
  WriteText(place / "precious", "years of work");
  fs::create_symlink("../../precious", place / "a/dichotomy/certificate.csv");
  RunFolder folder(place / "a", true);
  EXPECT_THAT(RefusalOf([&] { folder.CopyOlder(); }), HasSubstr("certificate.csv: is a link"));
  EXPECT_EQ(ReadText(place / "precious"), "years of work");
}

// Runs `action` as process 1 of a PID namespace of its own; ends with 77 when that is not allowed.
pid_t InPidNamespace(const std::function<void()>& action) {
  const pid_t outer = fork();
  if (outer == 0) {
    if (unshare(CLONE_NEWPID) != 0) _exit(77);
    const pid_t first = fork();
    if (first == 0) {
      try {
        action();
      } catch (const std::exception&) {
        _exit(1);
      }
      _exit(0);
    }
    int status = 0;
    waitpid(first, &status, 0);
    _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 99);
  }
  return outer;
}

int StatusOf(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 99;
}

// In containers, or on hosts that share a folder, two processes may have the same number.
TEST(RunFolder, RunsOfTwoPidNamespacesNeverMix) {
  const TemporaryFolder place;
  int to_a[2], to_b[2];
  ASSERT_EQ(pipe(to_a) + pipe(to_b), 0);
  const auto tell = [](const int* end) { (void)!write(end[1], "x", 1); };
  const auto await = [](const int* end) {
    char one = 0;
    (void)!read(end[0], &one, 1);
  };
  const auto a = InPidNamespace([&] {
    RunFolder folder(place / "run", true);
    tell(to_b);
    await(to_a);  // b has begun
    WriteRun(&folder, "a");
    tell(to_b);
    await(to_a);  // b is there
    folder.Publish();
  });
  const auto b = InPidNamespace([&] {
    await(to_b);
    RunFolder folder(place / "run", true);
    folder.Write("only_b.csv", "b");
    tell(to_a);
    await(to_b);
    WriteRun(&folder, "b");
    folder.Publish();
    tell(to_a);
  });
  const int status_a = StatusOf(a), status_b = StatusOf(b);
  if (status_a == 77) GTEST_SKIP() << "needs the right to make PID namespaces";
  EXPECT_EQ(status_a, 0);
  EXPECT_EQ(status_b, 0);
  EXPECT_THAT(FilesBelow(place.path()),
              ElementsAre("run/dichotomy/overlaps.csv", "run/manifest.json"));
  EXPECT_EQ(ReadText(place / "run/manifest.json"), "a");
  EXPECT_EQ(ReadText(place / "run/dichotomy/overlaps.csv"), "a");
}

TEST(RunFolder, SaysWhatCannotBeWritten) {
  const TemporaryFolder place;
  RunFolder folder(place / "a", false);
  folder.Write("raw", "a file where a folder should be");
  EXPECT_THAT(RefusalOf([&] { folder.Write("raw/trajectory.csv", "x"); }),
              testing::AllOf(HasSubstr((place / "a/raw/trajectory.csv").string()),
                             HasSubstr("Not a directory")));
  WriteText(place / "file", "");
  EXPECT_THAT(RefusalOf([&] { RunFolder(place / "file/a", false); }), HasSubstr("Not a directory"));
}

// While runs replace one another, the name is never absent.
TEST(RunFolder, ReplacesInOneStep) {
  const TemporaryFolder place;
  const fs::path path = place / "a";
  MakeRun(path, "0");
  std::atomic<bool> done = false;
  std::atomic<long> looks = 0, absences = 0;
  std::thread watcher([&] {
    struct stat unused {};
    while (!done) {
      ++looks;
      if (stat(path.c_str(), &unused) != 0) ++absences;
    }
  });
  while (looks == 0) std::this_thread::yield();
  for (int i = 1; i <= 25; ++i) MakeRun(path, std::to_string(i), true);
  done = true;
  watcher.join();
  EXPECT_EQ(absences, 0) << "of " << looks << " looks";
  EXPECT_EQ(ReadText(path / "manifest.json"), "25");
}

}  // namespace
}  // namespace halfstep
