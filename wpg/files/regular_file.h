#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace halfstep {

/// The result of reading a file: its bytes, or a sentence that says why there are none.
struct FileBytes {
  std::string bytes;     ///< of the whole file
  std::string refused;   ///< "" when the file was read
  bool missing = false;  ///< refused because there is no such file
};

/// Reads a regular file of at most `most` bytes to its end. Refuses larger files, and anything else
/// (a folder; a pipe or a device, which might never open or never end), before a byte is read and
/// without waiting.
FileBytes TryReadRegularFile(const std::string& path, std::uint64_t most);

/// The same; throws InputError "path: refused".
std::string ReadRegularFile(const std::string& path, std::uint64_t most);

/// The same of a file of any size, whose parts are handed on until `take` returns false.
void ReadRegularFileParts(const std::string& path,
                          const std::function<bool(std::string_view part)>& take);

/// "4 MiB", "1 GiB": the largest binary unit that divides the bytes.
std::string BinarySize(std::uint64_t bytes);

}  // namespace halfstep
