#pragma once

#include <span>
#include <string_view>
#include <utility>

namespace halfstep {

// What the running build is of, as manifests and --version tell it.
extern const std::string_view kVersion;    ///< "0.3.0"
extern const std::string_view kCommit;     ///< of git, "-dirty" where files differ; or "unknown"
extern const std::string_view kBuildType;  ///< "Release"
extern const std::string_view kCompiler;   ///< its name and version
/// Names and versions of the libraries that it was built with.
extern const std::span<const std::pair<std::string_view, std::string_view>> kLibraries;

}  // namespace halfstep
