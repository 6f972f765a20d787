#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace halfstep {

/// A column of a table, or a key of a JSON document, of a run's or an episode's folder.
struct NamedValue {
  std::string file;  ///< relative to the folder
  std::string name;  ///< column, or key without indices: "methods.message"
  bool json = false;
  std::string pointer = {};  ///< of a key: "/methods/0/message"
};

/// Every column and key of a folder, but those that name hashes, which follow. Of the methods of a
/// run only `method`'s folder; "": all folders.
std::vector<NamedValue> ValuesOf(const std::filesystem::path& folder, const std::string& method);

/// Changes one of them: of a table in a row that is drawn. What it did, in words; "": nothing was
/// changed, as the table has no rows.
std::string Forge(const std::filesystem::path& folder, const NamedValue& value,
                  std::mt19937* random);

}  // namespace halfstep
