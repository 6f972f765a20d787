// What HALFSTEP_HARDEN promises of a Release build, read from the headers of the program itself.

#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <string>

#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

template <typename T>
T At(const std::string& bytes, size_t offset) {
  T value;
  if (offset + sizeof value > bytes.size()) throw std::out_of_range("beyond the file's end");
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

// The program's headers of a 64-bit ELF file.
struct ElfHeaders {
  explicit ElfHeaders(const std::string& bytes) : file(At<Elf64_Ehdr>(bytes, 0)) {
    for (size_t i = 0; i < file.e_phnum; ++i) {
      const auto segment = At<Elf64_Phdr>(bytes, file.e_phoff + i * sizeof(Elf64_Phdr));
      segments[segment.p_type] = segment;
    }
    const Elf64_Phdr& place = segments.at(PT_DYNAMIC);
    for (size_t at = place.p_offset;; at += sizeof(Elf64_Dyn)) {
      const auto entry = At<Elf64_Dyn>(bytes, at);
      if (entry.d_tag == DT_NULL) break;
      dynamic[entry.d_tag] = entry.d_un.d_val;
    }
  }

  Elf64_Ehdr file;
  std::map<Elf64_Word, Elf64_Phdr> segments;  // the last of each type
  std::map<Elf64_Sxword, Elf64_Xword> dynamic;
};

TEST(HardenedBinary, IsAsHALFSTEP_HARDENPromises) {
  const std::string bytes = ReadText(CommandFile());
  if (!HALFSTEP_IS_HARDENED) GTEST_SKIP() << "not a Release build with HALFSTEP_HARDEN";
  if (bytes.compare(0, SELFMAG, ELFMAG) != 0 || bytes[EI_CLASS] != ELFCLASS64) {
    GTEST_SKIP() << "no 64-bit ELF file";
  }
  const ElfHeaders elf(bytes);
  EXPECT_EQ(elf.file.e_type, ET_DYN) << "position independent";
  ASSERT_TRUE(elf.dynamic.contains(DT_FLAGS_1));
  EXPECT_TRUE(elf.dynamic.at(DT_FLAGS_1) & DF_1_PIE);
  EXPECT_TRUE(elf.dynamic.at(DT_FLAGS_1) & DF_1_NOW) << "all symbols are bound at the start …";
  EXPECT_TRUE(elf.segments.contains(PT_GNU_RELRO)) << "… and cannot be changed after";
  ASSERT_TRUE(elf.segments.contains(PT_GNU_STACK));
  EXPECT_FALSE(elf.segments.at(PT_GNU_STACK).p_flags & PF_X) << "the stack holds no code";
  const auto has_symbol = [&bytes](const std::string& name) {
    return bytes.find('\0' + name + '\0') != std::string::npos;
  };
  EXPECT_TRUE(has_symbol("__stack_chk_fail"));
  EXPECT_TRUE(has_symbol("__memcpy_chk") || has_symbol("__snprintf_chk")) << "fortified";
}

}  // namespace
}  // namespace halfstep
