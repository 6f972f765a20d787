#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "wpg/files/input_file.h"
#include "wpg/files/partial_sibling.h"

namespace halfstep {

/// A folder of results that appears under its name whole or not at all: files are written and
/// synced in a PartialSibling, which Publish() renames. Anything that ends earlier (an exception, a
/// full disk, SIGKILL) leaves nothing under the final name; an ordinary end also removes the
/// sibling, and the next run of the same name removes one that a killed run left behind. A name
/// that is a link is refused: what it leads to is neither written nor replaced.
class RunFolder {
 public:
  /// Throws std::runtime_error when `path` exists and `overwrite` is false, when it exists and is
  /// not a run folder (a folder with a manifest.json), or when its parent cannot be made. Removes
  /// what a killed run of this name left behind unless `tidy` is false, for which it has to look at
  /// every name beside it.
  RunFolder(std::filesystem::path path, bool overwrite, bool tidy = true);

  /// The final one; while it is written the files lie beside it.
  const std::filesystem::path& path() const { return path_; }

  /// Where the files are until Publish(): a sibling of path(), so relative paths lead to the same.
  const std::filesystem::path& staging() const { return staging_->path(); }

  /// Writes a file, "dichotomy/overlaps.csv", with its folders, in place of one that is there.
  /// Throws std::runtime_error that names the file and the system's reason, e.g. "No space left on
  /// device".
  void Write(const std::string& relative, std::string_view content);

  /// What takes the parts of a text, one after the other.
  using TextSink = std::function<void(std::string_view part)>;
  /// The same of a content that is too long for memory: `write` hands on its parts.
  void WriteParts(const std::string& relative, const std::function<void(const TextSink&)>& write);

  /// What Write() wrote, by relative path; the last content of each.
  const std::map<std::string, InputFile>& written() const { return written_; }

  /// Begins with a copy of what stands under the final name, so that Publish() replaces only what
  /// is written after. Throws std::runtime_error for a run that holds links, pipes or devices.
  void CopyOlder();

  /// Moves everything to its final name, in place of an older run when overwriting. On a file
  /// system that cannot exchange two folders (NFS) the name is absent for a moment. Throws
  /// std::runtime_error when something else took the name meanwhile.
  void Publish();

 private:
  void CheckReplaceable() const;

  std::filesystem::path path_;
  bool overwrite_;
  std::optional<PartialSibling> staging_;
  std::map<std::string, InputFile> written_;
};

}  // namespace halfstep
