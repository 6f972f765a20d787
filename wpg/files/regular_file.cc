#include "wpg/files/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

#include "wpg/files/descriptor.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

std::string Reason() { return std::generic_category().message(errno); }

// Appends the rest of a file; "" or a sentence. A file may grow while it is read.
std::string ReadRest(int fd, std::uint64_t most, std::string* bytes) {
  std::array<char, 1 << 16> buffer;
  while (true) {
    const ssize_t n = read(fd, buffer.data(), buffer.size());
    if (n == 0) return "";
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return "cannot be read: " + Reason();
    bytes->append(buffer.data(), static_cast<size_t>(n));
    if (bytes->size() > most) return "too large (valid: at most " + BinarySize(most) + ")";
  }
}

}  // namespace

FileBytes TryReadRegularFile(const std::string& path, std::uint64_t most) {
  FileBytes result;
  // Without O_NONBLOCK a pipe that nobody writes to would not even open.
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);
  if (file.get() < 0) {
    result.missing = errno == ENOENT;
    result.refused = "cannot be opened: " + Reason();
    return result;
  }
  struct stat status {};
  if (fstat(file.get(), &status) != 0) {
    result.refused = "cannot be read: " + Reason();
  } else if (S_ISDIR(status.st_mode)) {
    result.refused = "is a folder, not a file";
  } else if (!S_ISREG(status.st_mode)) {
    result.refused = "is a pipe or a device (valid: a regular file)";
  } else if (const auto size = static_cast<std::uint64_t>(status.st_size); size > most) {
    result.refused =
        "too large: " + std::to_string(size) + " bytes (valid: at most " + BinarySize(most) + ")";
  } else {
    try {
      result.bytes.reserve(size);
      result.refused = ReadRest(file.get(), most, &result.bytes);
    } catch (const std::bad_alloc&) {
      result.refused = "no memory for its " + std::to_string(size) + " bytes";
    }
  }
  if (!result.refused.empty()) result.bytes.clear();
  return result;
}

std::string ReadRegularFile(const std::string& path, std::uint64_t most) {
  FileBytes file = TryReadRegularFile(path, most);
  if (!file.refused.empty()) throw InputError({path + ": " + file.refused});
  return std::move(file.bytes);
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
