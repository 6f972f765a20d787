#include "experiments/verify/found_inputs.h"

#include <algorithm>
#include <utility>

#include "wpg/files/input_error.h"
#include "wpg/files/sha256.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

namespace fs = std::filesystem;

fs::path Real(const fs::path& path) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(path), ignored);
}

bool IsThere(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool LiesIn(const fs::path& path, const fs::path& folder) {
  const fs::path relative = Real(path).lexically_relative(Real(folder));
  return !relative.empty() && *relative.begin() != "..";
}

template <typename Input>
Found<Input> Find(const InputSearch& search, const std::function<Input(const std::string&)>& load) {
  std::vector<fs::path> seen;
  std::string passed;
  for (const fs::path& place : search.places) {
    if (!IsThere(place) || std::ranges::find(seen, Real(place)) != seen.end()) continue;
    seen.push_back(Real(place));
    const bool of_run = LiesIn(place, search.run);
    try {
      Input input = load(place.lexically_normal().string());
      if (of_run || CombinedSha256(input.files) == search.sha256) return {std::move(input), passed};
    } catch (const InputError&) {
      // What lies elsewhere may have become anything.
      if (of_run) throw;
    }
    if (passed.empty()) passed = place.lexically_normal().string();
  }
  throw InputError({NotFound(search)});
}

}  // namespace

std::string NotFound(const InputSearch& search) {
  std::string places;
  for (const fs::path& place : search.places) {
    const std::string quoted = Quote(place.lexically_normal().string());
    if (places.find(quoted) == std::string::npos) places += (places.empty() ? "" : ", ") + quoted;
  }
  return search.run.string() + ": " + search.what +
         ": not found: its files are not in the folder, and those with the SHA-256 of "
         "manifest.json, " +
         Quote(search.sha256.substr(0, 12)) + "…, are not at " + places + " either (valid: --" +
         search.what + " FILE names where they are now)";
}

Found<RobotModel> FindRobot(const InputSearch& search) {
  return Find<RobotModel>(search, LoadRobot);
}

Found<Scene> FindScene(const InputSearch& search) { return Find<Scene>(search, LoadScene); }

}  // namespace halfstep::verify
