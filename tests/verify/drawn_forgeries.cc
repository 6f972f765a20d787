#include "tests/verify/drawn_forgeries.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/verify/verify_mutation.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Table = TamperedRun::Table;

// "/methods/0/message" as "methods.message".
std::string NameOfPointer(const std::string& pointer) {
  std::string name, part;
  const auto add = [&] {
    const bool index = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (!part.empty() && !index) name += (name.empty() ? "" : ".") + part;
    part.clear();
  };
  for (const char c : pointer) c == '/' ? add() : part.push_back(c);
  add();
  return name;
}

bool IsNumber(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

// Another value of the same kind.
std::string Other(const std::string& cell, std::mt19937* random) {
  static const std::vector<std::pair<std::string, std::string>> kPairs = {
      {"true", "false"},      {"left", "right"}, {"up", "down"},
      {"up_down", "down_up"}, {"both", "left"},  {"inf", "0.5"}};
  for (const auto& [a, b] : kPairs) {
    if (cell == a) return b;
    if (cell == b) return a;
  }
  if (cell.empty()) return "1";
  if (!IsNumber(cell)) return cell.starts_with('"') ? "\"x" + cell.substr(1) : cell + "x";
  const double x = std::stod(cell);
  if (cell.find_first_of(".en") == std::string::npos) {
    return std::to_string(std::lround(x) + ((*random)() % 2 == 0 ? 1 : -1));
  }
  switch ((*random)() % 4) {
    case 0:
      return ShortestText(x + 1e-3);
    case 1:
      return ShortestText(x - 1e-3);
    case 2:
      return ShortestText(x == 0 ? 0.01 : -x);
    default:
      return ShortestText(x == 0 ? 0.1 : 1.1 * x);
  }
}

}  // namespace

std::vector<NamedValue> ValuesOf(const fs::path& folder, const std::string& method) {
  std::vector<NamedValue> values;
  for (const std::string& file : FilesBelow(folder)) {
    const size_t slash = file.find('/');
    const bool of_other =
        !method.empty() && slash != std::string::npos && file.substr(0, slash) != method;
    if (of_other || file.ends_with(".schema.json") || file.starts_with("inputs/")) continue;
    if (file.ends_with(".csv")) {
      const Table table = TamperedRun::Cells(ReadText(folder / file));
      for (const std::string& column : table.front()) values.push_back({file, column});
    } else if (file.ends_with("manifest.json") || file.ends_with("certificate.json")) {
      const Json flat = Json::parse(ReadText(folder / file)).flatten();
      for (const auto& [pointer, value] : flat.items()) {
        if (pointer.find("sha256") != std::string::npos || pointer.starts_with("/files/") ||
            pointer.starts_with("/inputs/")) {
          continue;
        }
        values.push_back({file, NameOfPointer(pointer), true, pointer});
      }
    }
  }
  return values;
}

std::string Forge(const fs::path& folder, const NamedValue& value, std::mt19937* random) {
  const fs::path path = folder / value.file;
  if (value.json) {
    Json document = Json::parse(ReadText(path));
    Json& member = document[Json::json_pointer(value.pointer)];
    const std::string before = member.dump();
    if (member.is_string()) {
      member = member.get<std::string>() + "x";
    } else if (member.is_boolean()) {
      member = !member.get<bool>();
    } else if (member.is_number_integer()) {
      member = member.get<long>() + 1;
    } else if (member.is_number()) {
      member = member.get<double>() * 1.1 + 1e-3;
    } else {
      member = 0.5;
    }
    WriteText(path, document.dump(2) + "\n");
    return before + " becomes " + member.dump();
  }
  std::string what;
  TamperedRun::EditCsv(path, [&](Table& table) {
    if (table.size() < 2) return;
    const auto& header = table.front();
    const auto column =
        static_cast<size_t>(std::find(header.begin(), header.end(), value.name) - header.begin());
    const size_t row = 1 + (*random)() % (table.size() - 1);
    std::string& cell = table[row][column];
    const std::string before = cell;
    cell = Other(cell, random);
    what = "row " + std::to_string(row) + ": " + before + " becomes " + cell;
  });
  return what;
}

}  // namespace halfstep
