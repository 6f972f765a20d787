#include "wpg/files/regular_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

TEST(RegularFile, IsReadToItsLastByte) {
  const TemporaryFolder place;
  std::string text(200'000, 'x');
  text += '\0';
  const std::string path = WriteText(place / "f", text);
  EXPECT_EQ(ReadRegularFile(path, text.size()), text);
  EXPECT_EQ(ReadRegularFile(WriteText(place / "empty", ""), 0), "");
}

// Opening a pipe to read would wait until somebody writes.
TEST(RegularFile, AFifoIsRefusedAndNotWaitedFor) {
  const TemporaryFolder place;
  const std::string fifo = place / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  const FileBytes file = TryReadRegularFile(fifo, 100);
  EXPECT_EQ(file.refused, "is a pipe or a device (valid: a regular file)");
  EXPECT_FALSE(file.missing);
  EXPECT_THAT(TryReadRegularFile("/dev/zero", 100).refused, HasSubstr("a device"));
  EXPECT_EQ(TryReadRegularFile(place.path(), 100).refused, "is a folder, not a file");
}

TEST(RegularFile, SizeIsCheckedBeforeAnythingIsRead) {
  const TemporaryFolder place;
  const std::string path = WriteText(place / "sparse", "");
  ASSERT_EQ(truncate(path.c_str(), off_t{1} << 40), 0);
  const FileBytes file = TryReadRegularFile(path, std::uint64_t{4} << 30);
  EXPECT_EQ(file.refused, "too large: 1099511627776 bytes (valid: at most 4 GiB)");
  EXPECT_EQ(file.bytes, "");
}

TEST(RegularFile, WhatIsMissingIsSaid) {
  const TemporaryFolder place;
  EXPECT_TRUE(TryReadRegularFile(place / "none", 1).missing);
  try {
    ReadRegularFile(place / "none", 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(),
              (place / "none").string() + ": cannot be opened: No such file or directory");
  }
}

TEST(RegularFile, SizesAreShownInTheLargestUnitThatDividesThem) {
  EXPECT_EQ(BinarySize(0), "0 bytes");
  EXPECT_EQ(BinarySize(1000), "1000 bytes");
  EXPECT_EQ(BinarySize(4 << 20), "4 MiB");
  EXPECT_EQ(BinarySize(std::uint64_t{1} << 40), "1024 GiB");
}

}  // namespace
}  // namespace halfstep
