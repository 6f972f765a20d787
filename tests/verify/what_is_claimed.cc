#include "tests/verify/what_is_claimed.h"

#include <functional>

#include "tests/verify/verify_mutation.h"

namespace halfstep {
namespace {

using Json = nlohmann::ordered_json;
using Table = TamperedRun::Table;

std::string WithoutColumns(const std::string& text, const std::set<std::string>& columns) {
  const Table table = TamperedRun::Cells(text);
  std::string rest;
  for (const auto& row : table) {
    for (size_t i = 0; i < row.size(); ++i) {
      if (!columns.contains(table.front()[i])) rest += row[i] + ",";
    }
    rest += "\n";
  }
  return rest;
}

std::string WithoutMembers(const std::string& text,
                           const std::function<const char*(const std::string&)>& harmless) {
  std::string rest;
  const Json flat = Json::parse(text).flatten();
  for (const auto& [pointer, value] : flat.items()) {
    const bool recomputed = pointer.find("sha256") != std::string::npos ||
                            pointer.starts_with("/files/") || pointer.starts_with("/inputs/");
    if (!recomputed && *harmless(pointer) == '\0') rest += pointer + " " + value.dump() + "\n";
  }
  return rest;
}

}  // namespace

const char* HarmlessInManifest(const std::string& pointer) {
  for (const char* begin : {"/version", "/commit", "/build_type", "/compiler", "/written",
                            "/acceptance", "/host", "/wall_s", "/libraries"}) {
    if (pointer.starts_with(begin)) return kHow;
  }
  for (const char* part :
       {"/requested", "/message", "/judged_by", "/work", "/wall_s", "/processor_s"}) {
    if (pointer.starts_with("/methods/") && pointer.find(part) != std::string::npos) return kHow;
  }
  // Of raw, whose row verify is not asked about.
  if (pointer == "/methods/0/status" || pointer == "/methods/0/duration_s" ||
      pointer == "/methods/0/verdict") {
    return "verify is asked about the other method";
  }
  return "";
}

const char* HarmlessInCertificate(const std::string& pointer) {
  if (pointer == "/robot" || pointer == "/scene") return "its hash says which it is";
  return pointer == "/resolution_s" ? kHow : "";
}

std::string SaysTheSame(const std::string& name, const std::string& a, const std::string& b) {
  const auto same = [&](const auto& rest) { return rest(a) == rest(b) ? kHow : ""; };
  if (name.ends_with("overlaps.csv")) {
    return same([](const std::string& text) { return WithoutColumns(text, kFreeOfOverlaps); });
  }
  if (name == "summary.csv") {
    return same([](const std::string& text) { return WithoutColumns(text, kFreeOfSummary); });
  }
  if (name == "manifest.json") {
    return same([](const std::string& text) { return WithoutMembers(text, HarmlessInManifest); });
  }
  if (name.ends_with("certificate.json")) {
    return same(
        [](const std::string& text) { return WithoutMembers(text, HarmlessInCertificate); });
  }
  if (name == "config.yaml" && a.size() == b.size() &&
      a.find("clearance_m: 0.002") != std::string::npos) {
    return "the certificate demands more than the config does";
  }
  return "";
}

}  // namespace halfstep
