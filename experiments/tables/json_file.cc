#include "experiments/tables/json_file.h"

#include "wpg/files/input_error.h"
#include "wpg/files/nesting.h"
#include "wpg/files/regular_file.h"

namespace halfstep {

using nlohmann::json;

json ReadJsonObject(const std::filesystem::path& path) {
  return ParseJsonObject(ReadJsonText(path), path);
}

std::string ReadJsonText(const std::filesystem::path& path) {
  return ReadRegularFile(path.string(), std::uint64_t{64} << 20);
}

json ParseJsonObject(const std::string& text, const std::filesystem::path& path) {
  if (JsonDepth(text) > kMostJsonLevels) {
    throw InputError({path.string() + ": nests too deeply (valid: at most " +
                      std::to_string(kMostJsonLevels) + " levels)"});
  }
  json value = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!value.is_object()) throw InputError({path.string() + ": is no JSON object"});
  return value;
}

}  // namespace halfstep
