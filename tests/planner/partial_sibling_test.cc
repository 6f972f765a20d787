#include "wpg/files/partial_sibling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A process that makes a sibling and keeps it until it is killed.
class Holder {
 public:
  Holder(const fs::path& path, PartialSibling::Kind kind) {
    int ready[2];
    if (pipe(ready) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      auto* held = new PartialSibling(path, kind);
      (void)!write(ready[1], held->path().c_str(), held->path().native().size());
      close(ready[1]);
      while (true) pause();
    }
    close(ready[1]);
    char name[4096];
    const ssize_t n = read(ready[0], name, sizeof name);
    held_ = std::string(name, n > 0 ? static_cast<size_t>(n) : 0);
    close(ready[0]);
  }
  ~Holder() { Kill(); }
  void Kill() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  const fs::path& held() const { return held_; }

 private:
  pid_t pid_ = -1;
  fs::path held_;
};

class PartialSiblingOfKind : public testing::TestWithParam<PartialSibling::Kind> {};

TEST_P(PartialSiblingOfKind, IsItsOwnersAloneAndGoesWithIt) {
  const TemporaryFolder place;
  {
    const PartialSibling a(place / "run", GetParam()), b(place / "run", GetParam());
    EXPECT_NE(a.path(), b.path());
    EXPECT_THAT(a.path().filename().string(), testing::MatchesRegex("\\.run\\.partial-[0-9a-f]+"));
    EXPECT_EQ(NamesIn(place.path()).size(), 2u);
  }
  EXPECT_TRUE(NamesIn(place.path()).empty());
}

TEST_P(PartialSiblingOfKind, StaysWhileItsProcessLives) {
  const TemporaryFolder place;
  Holder holder(place / "run", GetParam());
  ASSERT_TRUE(fs::exists(holder.held()));
  RemoveAbandonedSiblings(place.path(), "run");
  EXPECT_TRUE(fs::exists(holder.held()));
  holder.Kill();
  RemoveAbandonedSiblings(place.path(), "walk");
  EXPECT_TRUE(fs::exists(holder.held())) << "of another name";
  RemoveAbandonedSiblings(place.path(), "run");
  EXPECT_TRUE(NamesIn(place.path()).empty());
}

INSTANTIATE_TEST_SUITE_P(AFileAndAFolder, PartialSiblingOfKind,
                         testing::Values(PartialSibling::Kind::kFile,
                                         PartialSibling::Kind::kFolder));

TEST(RemoveAbandonedSiblings, TakesNothingElse) {
  const TemporaryFolder place;
  const std::set<std::string> others = {".run.partial-123", ".run.partial-x123456789abcdef",
                                        "run.partial-0123456789abcdef", ".run.partial-",
                                        ".run.partial-0123456789abcdef-older"};
  for (const std::string& name : others) WriteText(place / name / "f", "");
  RemoveAbandonedSiblings(place.path(), "");
  EXPECT_EQ(NamesIn(place.path()), others);
  fs::create_directory(place / "run");  // so the older one is not the only copy
  RemoveAbandonedSiblings(place.path(), "");
  EXPECT_FALSE(fs::exists(place / ".run.partial-0123456789abcdef-older"));
}

TEST(RemoveAbandonedSiblings, FollowsNoLink) {
  const TemporaryFolder place;
  WriteText(place / "precious/thesis.tex", "years of work");
  fs::create_directory_symlink(place / "precious", place / ".run.partial-0123456789abcdef");
  RemoveAbandonedSiblings(place.path(), "run");
  EXPECT_TRUE(fs::exists(place / "precious/thesis.tex"));
}

TEST(WriteWhole, NeitherFollowsNorReplacesALink) {
  const TemporaryFolder place;
  WriteText(place / "precious", "years of work");
  fs::create_symlink("precious", place / "link");
  fs::create_symlink("nowhere", place / "dangling");
  for (const std::string name : {"link", "dangling"}) {
    EXPECT_THAT(RefusalOf([&] { WriteWhole(place / name, {"x"}); }),
                HasSubstr(name + ": is a link, which is not followed"));
    EXPECT_TRUE(fs::is_symlink(place / name));
  }
  EXPECT_EQ(ReadText(place / "precious"), "years of work");
  EXPECT_THAT(NamesIn(place.path()), ElementsAre("dangling", "link", "precious"));
}

TEST(WriteWhole, ReplacesRegularFilesOnly) {
  const TemporaryFolder place;
  ASSERT_EQ(mkfifo((place / "fifo").c_str(), 0600), 0);
  fs::create_directory(place / "folder");
  for (const std::string name : {"fifo", "folder"}) {
    EXPECT_THAT(RefusalOf([&] { WriteWhole(place / name, {"x"}); }),
                HasSubstr(name + ": is no regular file"));
  }
  WriteText(place / "file", "old");
  WriteWhole(place / "file", {"n", "", "ew"});
  EXPECT_EQ(ReadText(place / "file"), "new");
  EXPECT_THAT(NamesIn(place.path()), ElementsAre("fifo", "file", "folder"));
}

TEST(WriteSynced, TakesNoNameThatIsThere) {
  const TemporaryFolder place;
  WriteText(place / "precious", "years of work");
  fs::create_symlink("precious", place / "link");
  for (const std::string name : {"precious", "link"}) {
    EXPECT_THAT(RefusalOf([&] { WriteSynced(place / name, {"x"}, "shown"); }),
                HasSubstr("shown: cannot be written: File exists"));
  }
  EXPECT_EQ(ReadText(place / "precious"), "years of work");
}

}  // namespace
}  // namespace halfstep
