#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace halfstep {

/// A file that is whole and says what it was made from:
///   "halfstep file 1\n", length of the header (8 bytes), header (text), body, SHA-256 of all
///   before.
/// Numbers are little-endian.

/// What a reader gets: the body, or a sentence why the file was refused.
struct CheckedFile {
  std::optional<std::string> body;  ///< none: refused, or there is no file
  std::string refused;              ///< "" when the file was read, or does not exist
};

/// Reads a file whose header must be `header`. Anything else is refused with a sentence, not an
/// exception: another header (the sentence names the first line that differs), a file that is cut
/// or changed in any bit, one above 4 GiB.
CheckedFile ReadCheckedFile(const std::string& path, std::string_view header);
/// The same for a file's bytes.
CheckedFile ParseCheckedFile(const std::string& path, std::string bytes, std::string_view header);

/// Writes the file as WriteWhole does. Throws std::runtime_error with the system's reason.
void WriteCheckedFile(const std::string& path, std::string_view header, std::string_view body);

}  // namespace halfstep
