#include "wpg/files/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <new>
#include <system_error>
#include <utility>

#include "wpg/files/descriptor.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

std::string Reason() { return std::generic_category().message(errno); }

// Hands on the rest of a file; "" or a sentence. A file may grow while it is read.
std::string ReadRest(int fd, const std::function<bool(std::string_view)>& take) {
  std::array<char, 1 << 16> buffer;
  while (true) {
    const ssize_t n = read(fd, buffer.data(), buffer.size());
    if (n == 0) return "";
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return "cannot be read: " + Reason();
    if (!take({buffer.data(), static_cast<size_t>(n)})) return "";
  }
}

// Why an open file is not read, "": it is. Without O_NONBLOCK a pipe that nobody writes to would
// not even open.
std::string RefusalOf(const Descriptor& file, std::uint64_t most, std::uint64_t* size) {
  struct stat status {};
  if (file.get() < 0) return "cannot be opened: " + Reason();
  if (fstat(file.get(), &status) != 0) return "cannot be read: " + Reason();
  if (S_ISDIR(status.st_mode)) return "is a folder, not a file";
  if (!S_ISREG(status.st_mode)) return "is a pipe or a device (valid: a regular file)";
  *size = static_cast<std::uint64_t>(status.st_size);
  if (*size <= most) return "";
  return "too large: " + std::to_string(*size) + " bytes (valid: at most " + BinarySize(most) + ")";
}

}  // namespace

FileBytes TryReadRegularFile(const std::string& path, std::uint64_t most) {
  FileBytes result;
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);
  result.missing = file.get() < 0 && errno == ENOENT;
  std::uint64_t size = 0;
  result.refused = RefusalOf(file, most, &size);
  if (!result.refused.empty()) return result;
  std::string& bytes = result.bytes;
  try {
    bytes.reserve(size);
    result.refused = ReadRest(file.get(), [&](std::string_view part) {
      bytes.append(part);
      return bytes.size() <= most;
    });
    if (bytes.size() > most) {
      result.refused = "too large (valid: at most " + BinarySize(most) + ")";
    }
  } catch (const std::bad_alloc&) {
    result.refused = "no memory for its " + std::to_string(size) + " bytes";
  }
  if (!result.refused.empty()) bytes.clear();
  return result;
}

std::string ReadRegularFile(const std::string& path, std::uint64_t most) {
  FileBytes file = TryReadRegularFile(path, most);
  if (!file.refused.empty()) throw InputError({path + ": " + file.refused});
  return std::move(file.bytes);
}

void ReadRegularFileParts(const std::string& path,
                          const std::function<bool(std::string_view part)>& take) {
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);
  std::uint64_t size = 0;
  std::string refused = RefusalOf(file, std::numeric_limits<std::uint64_t>::max(), &size);
  if (refused.empty()) refused = ReadRest(file.get(), take);
  if (!refused.empty()) throw InputError({path + ": " + refused});
}

std::string BinarySize(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> kUnits = {" bytes", " KiB", " MiB", " GiB"};
  size_t unit = 0;
  while (unit + 1 < kUnits.size() && bytes > 0 && bytes % 1024 == 0) {
    bytes /= 1024;
    ++unit;
  }
  return std::to_string(bytes) + kUnits[unit];
}

}  // namespace halfstep
