#include "experiments/verify/certificate_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/verify/csv_text.h"
#include "experiments/verify/findings.h"
#include "wpg/input/input_error.h"
#include "wpg/input/nesting.h"
#include "wpg/input/number_text.h"
#include "wpg/input/text.h"
#include "wpg/input/yaml_node.h"

namespace halfstep::verify {
namespace {

using nlohmann::json;

// Reads members of one object with complaints that name them.
class Member {
 public:
  Member(const std::string& path, const json& object, std::string name)
      : path_(path), object_(object), name_(std::move(name)) {
    if (!object.is_object()) Fail("is not an object");
  }

  Member Object(const char* key) const { return {path_, Of(key), Name(key)}; }
  std::string String(const char* key) const {
    const json& value = Of(key);
    if (!value.is_string()) Member(*this, key).Fail("is not a text");
    return value.get<std::string>();
  }
  double Number(const char* key) const {
    const json& value = Of(key);
    if (!value.is_number()) Member(*this, key).Fail("is not a number");
    return value.get<double>();
  }
  std::optional<double> NumberOrNull(const char* key) const {
    if (Of(key).is_null()) return std::nullopt;
    return Number(key);
  }
  long Whole(const char* key) const {
    const json& value = Of(key);
    if (!value.is_number_integer()) Member(*this, key).Fail("is not a whole number");
    return value.get<long>();
  }
  std::vector<Member> List(const char* key) const {
    const json& value = Of(key);
    if (!value.is_array()) Member(*this, key).Fail("is not a list");
    std::vector<Member> items;
    for (const json& item : value) {
      const std::string index = "[" + std::to_string(items.size()) + "]";
      items.emplace_back(path_, item, Name(key) + index);
    }
    return items;
  }
  /// Of a list of two texts.
  std::array<std::string, 2> TwoStrings(const char* key) const {
    const json& value = Of(key);
    if (!value.is_array() || value.size() != 2 || !value[0].is_string() || !value[1].is_string()) {
      Member(*this, key).Fail("is not a list of two texts");
    }
    return {value[0].get<std::string>(), value[1].get<std::string>()};
  }
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError({path_ + ": " + (name_.empty() ? "the document" : name_) + ": " + what});
  }

 private:
  Member(const Member& parent, const char* key)
      : path_(parent.path_), object_(parent.object_), name_(parent.Name(key)) {}
  std::string Name(const char* key) const { return name_.empty() ? key : name_ + "." + key; }
  const json& Of(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) Member(*this, key).Fail("is missing");
    return *found;
  }

  const std::string& path_;
  const json& object_;
  std::string name_;
};

}  // namespace

CertificateText ReadCertificateJson(const std::string& path, const std::string& text) {
  if (JsonDepth(text) > kMostJsonLevels) {
    throw InputError({path + ": nests too deeply (valid: at most " +
                      std::to_string(kMostJsonLevels) + " levels)"});
  }
  json document;
  try {
    document = json::parse(text);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<long>(std::min(error.byte, text.size()));
    const long line = 1 + std::count(text.begin(), end, '\n');
    throw InputError({path + ":" + std::to_string(line) + ": is not JSON"});
  } catch (const json::exception&) {
    throw InputError({path + ": a number is out of range"});
  }
  const Member root(path, document, "");
  if (root.Whole("format") != 2) root.Fail("format: only 2 is known");
  CertificateText c;
  c.verdict = root.String("verdict");
  c.message = root.String("message");
  c.statement = root.String("statement");
  c.duration = root.Number("duration_s");
  const Member demanded = root.Object("demanded"), statements = root.Object("statements");
  for (size_t f = 0; f < kNumFamilies; ++f) {
    c.demanded[f] = demanded.Number(kFamilyNames[f]);
    c.statements[f] = statements.Whole(kFamilyNames[f]);
  }
  for (const Member& pair : root.List("not_watched")) {
    const auto [first, second] = pair.TwoStrings("bodies");
    c.not_watched.push_back({first, second, pair.String("why")});
  }
  const Member limits = root.Object("limits");
  c.foot_speed = limits.NumberOrNull("foot_speed_m_s");
  c.foot_yaw_rate = limits.NumberOrNull("foot_yaw_rate_rad_s");
  c.joint_speed_scale = limits.Number("joint_speed_scale");
  c.robot = root.String("robot");
  c.scene = root.String("scene");
  const Member hashes = root.Object("sha256");
  c.trajectory_hash = hashes.String("trajectory.csv");
  c.certificate_hash = hashes.String("certificate.csv");
  c.robot_hash = hashes.String("robot");
  c.scene_hash = hashes.String("scene");
  return c;
}

std::vector<ClaimRow> ReadCertificateCsv(const std::string& path, const std::string& text) {
  const CsvText csv(
      path, text,
      {"begin_s", "end_s", "family", "statements", "subject", "margin", "bound", "demanded"});
  std::vector<ClaimRow> rows;
  rows.reserve(csv.size());
  for (size_t i = 0; i < csv.size(); ++i) {
    const auto family = std::find(kFamilyNames.begin(), kFamilyNames.end(), csv.Cell(i, 2));
    if (family == kFamilyNames.end()) csv.Refuse(i, 2, "is no family");
    rows.push_back({.line = static_cast<int>(i) + 2,
                    .begin = csv.Number(i, 0),
                    .end = csv.Number(i, 1),
                    .family = static_cast<Family>(family - kFamilyNames.begin()),
                    .statements = csv.Positive(i, 3),
                    .subject = csv.Cell(i, 4),
                    .margin = csv.Number(i, 5),
                    .bound = csv.Number(i, 6),
                    .demanded = csv.Number(i, 7)});
  }
  return rows;
}

ConfigDemands ReadConfigDemands(const std::string& path, const std::string& text) {
  YamlComplaints complaints(path);
  const YamlNode root = ParseYaml(text, "", &complaints);
  complaints.ThrowIfAny();
  ConfigDemands config;
  const YamlNode* const smoothing = root.Find("smoothing");
  const auto find = [&](const char* group, const char* key) -> const YamlNode* {
    const YamlNode* const map = smoothing == nullptr ? nullptr : smoothing->Find(group);
    return map == nullptr ? nullptr : map->Find(key);
  };
  const auto number = [&](const char* group, const char* key) -> std::optional<double> {
    const YamlNode* const node = find(group, key);
    if (node == nullptr || node->text == "none") return std::nullopt;
    const NumberText read = ParseNumber(node->text);
    if (read.kind != NumberText::Kind::kNumber) {
      throw InputError({Text("%s:%d:%d: smoothing.%s.%s: is not a number", path.c_str(),
                             node->place.line, node->place.column, group, key)});
    }
    return read.value;
  };
  for (size_t f = 0; f < kNumFamilies; ++f) config.demanded[f] = number("margins", kMarginKeys[f]);
  config.foot_speed = number("limits", "foot_speed_m_s");
  config.foot_yaw_rate = number("limits", "foot_yaw_rate_rad_s");
  config.joint_speed_scale = number("limits", "joint_speed_scale");
  return config;
}

}  // namespace halfstep::verify
