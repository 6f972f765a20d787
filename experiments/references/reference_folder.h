#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/references/reference_maker.h"

namespace halfstep {

/// The folder of a set of references: manifest.json (what the set is), FORMAT/REFERENCE.* and
/// walks/REFERENCE.yaml, each file whole or not there; while it is not finished, `unfinished` with
/// the row of each reference whose files are there; and index.csv with its schema once all are.
class ReferenceFolder {
 public:
  /// Makes the folder, or continues one that the same program began for the same `manifest`. Throws
  /// InputError when something else is there or it is finished already; std::runtime_error when it
  /// cannot be written.
  ReferenceFolder(const std::filesystem::path& path, const std::string& manifest);

  /// Whether a reference was written.
  bool IsDone(const std::string& name) const;
  /// Writes a reference's files, and then that it is done. Threads may write different ones.
  void Write(const std::string& name, const MadeReference& made) const;
  /// Writes index.csv from the rows of all references in their order, and removes `unfinished`.
  /// Precondition: all are done. Returns the bytes of all files of the set.
  std::uintmax_t Finish(const CsvColumns& columns, const std::vector<std::string>& names) const;

  const std::filesystem::path& path() const { return path_; }  ///< of the folder

 private:
  std::filesystem::path RowPath(const std::string& name) const;

  std::filesystem::path path_;
};

/// Text of a set's manifest.json: the request, program and libraries, what certificates demand and
/// do not cover. `folder` is that of the set; robot files are known by their hash.
std::string ReferenceManifest(const ReferenceRequest& request, const ReferenceMaker& maker);

}  // namespace halfstep
