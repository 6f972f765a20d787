#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace halfstep {

/// A JSON file of a run: manifest, plan, certificate. Throws InputError, with the path, for what is
/// no regular file, exceeds 64 MiB, nests deeper than kMostJsonLevels or is no object.
nlohmann::json ReadJsonObject(const std::filesystem::path& path);

/// The text of such a file, not parsed. Throws InputError for what cannot be read, as before.
std::string ReadJsonText(const std::filesystem::path& path);
/// The same for its bytes; `path` stands for the file in complaints.
nlohmann::json ParseJsonObject(const std::string& text, const std::filesystem::path& path);

}  // namespace halfstep
