#pragma once

#include <cstdint>
#include <string>

namespace halfstep {

/// What came of reading a file: its bytes, or a sentence why there are none.
struct FileBytes {
  std::string bytes;
  std::string refused;   ///< "" when the file was read
  bool missing = false;  ///< refused because nothing has the name
};

/// Reads a regular file of at most `most` bytes to its end. What is anything else (a folder, a pipe
/// or a device, which might never end or never open) and what is larger is refused before a byte is
/// read, never waited for.
FileBytes TryReadRegularFile(const std::string& path, std::uint64_t most);

/// The same; throws InputError "path: refused".
std::string ReadRegularFile(const std::string& path, std::uint64_t most);

/// "4 MiB", "1 GiB": the largest binary unit that divides the bytes.
std::string BinarySize(std::uint64_t bytes);

}  // namespace halfstep
