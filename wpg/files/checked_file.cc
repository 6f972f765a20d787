#include "wpg/files/checked_file.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "wpg/files/regular_file.h"
#include "wpg/files/sha256.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

static_assert(std::endian::native == std::endian::little, "files are written as memory holds them");

constexpr std::string_view kMagic = "halfstep file 1\n";
constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;
constexpr size_t kDigest = 32;  // bytes of SHA-256

std::string LengthBytes(uint64_t length) {
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  return bytes;
}

// "line 3 is `a`, not `b`".
std::string FirstDifference(std::string_view found, std::string_view wanted) {
  for (int line = 1;; ++line) {
    const std::string_view a = found.substr(0, found.find('\n'));
    const std::string_view b = wanted.substr(0, wanted.find('\n'));
    if (a != b) {
      return "line " + std::to_string(line) + " of its header is `" +
             std::string(a.substr(0, 120)) + "`, not `" + std::string(b.substr(0, 120)) + "`";
    }
    if (a.size() == found.size() || b.size() == wanted.size())
      return "its header has another length";
    found.remove_prefix(a.size() + 1);
    wanted.remove_prefix(b.size() + 1);
  }
}

}  // namespace

CheckedFile ReadCheckedFile(const std::string& path, std::string_view header) {
  const auto refuse = [&](const std::string& why) {
    return CheckedFile{std::nullopt, path + ": refused: " + why};
  };
  FileBytes file = TryReadRegularFile(path, kMostBytes);
  if (file.missing) return {};
  if (!file.refused.empty()) return refuse(file.refused);
  return ParseCheckedFile(path, std::move(file.bytes), header);
}

CheckedFile ParseCheckedFile(const std::string& path, std::string bytes, std::string_view header) {
  const auto refuse = [&](const std::string& why) {
    return CheckedFile{std::nullopt, path + ": refused: " + why};
  };
  const size_t before_header = kMagic.size() + sizeof(uint64_t);
  const std::string_view all = bytes;
  if (all.size() < before_header + kDigest) return refuse("it is cut short");
  if (all.substr(0, kMagic.size()) != kMagic)
    return refuse("it is damaged, or no file of this kind");
  Sha256Hash hash;
  hash.Add(all.substr(0, all.size() - kDigest));
  if (hash.Finish() != all.substr(all.size() - kDigest)) {
    return refuse("it is damaged: its checksum does not fit");
  }
  uint64_t length = 0;
  std::memcpy(&length, bytes.data() + kMagic.size(), sizeof length);
  if (length > all.size() - before_header - kDigest) return refuse("its header is too long");
  const std::string_view found = all.substr(before_header, length);
  if (found != header) return refuse("it is stale: " + FirstDifference(found, header));
  bytes.erase(bytes.size() - kDigest);
  bytes.erase(0, before_header + length);
  return {std::move(bytes), ""};
}

void WriteCheckedFile(const std::string& path, std::string_view header, std::string_view body) {
  const std::string length = LengthBytes(header.size());
  std::vector<std::string_view> parts = {kMagic, length, header, body};
  Sha256Hash hash;
  for (const std::string_view part : parts) hash.Add(part);
  const std::string digest = hash.Finish();
  parts.push_back(digest);
  WriteWhole(path, parts);
}

}  // namespace halfstep
