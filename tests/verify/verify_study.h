#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/verify/verify_mutation.h"

namespace halfstep {

/// One forgery of a run, all hashes recomputed after it.
struct StudyMutation {
  std::string kind, name;
  std::function<void(TamperedRun&)> forge;
  /// Why the certificate's statement would still be true; "": it might not, so it must be refused.
  std::string harmless = "";
};

/// Every kind of forgery: each file, column, field of a certificate's row by family, key of the
/// config and member of the manifest changed, files and folders swapped, removed and replaced.
std::vector<StudyMutation> StudyMutations();

}  // namespace halfstep
