#include "experiments/verify/certificate_text.h"

#include <algorithm>

#include "experiments/verify/csv_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/json_text.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

// The first key of an object that is not one of those, with `prefix` before it; "": all are.
std::string UnknownKey(const JsonMember& member, const std::string& prefix,
                       const std::vector<std::string>& known) {
  for (const auto& [key, value] : member.object().items()) {
    if (std::ranges::find(known, key) == known.end()) return prefix + key;
  }
  return "";
}

// Whatever stood beside what is verified could pass for verified, too.
std::string UnknownKeyOf(const JsonMember& root) {
  std::vector<std::string> families(kFamilyNames.begin(), kFamilyNames.end());
  families.push_back("own");  // of a program that registered margins: told elsewhere
  for (const std::string& unknown :
       {UnknownKey(
            root, "",
            {"format", "verdict", "message", "statement", "duration_s", "resolution_s", "demanded",
             "limits", "statements", "not_covered", "robot", "scene", "sha256", "tube"}),
        UnknownKey(root.Object("demanded"), "demanded.", families),
        UnknownKey(root.Object("statements"), "statements.", families),
        UnknownKey(root.Object("limits"), "limits.",
                   {"foot_speed_m_s", "foot_yaw_rate_rad_s", "joint_speed_scale",
                    "joint_acceleration_rad_s2", "landing_speed_m_s"}),
        UnknownKey(root.Object("sha256"), "sha256.",
                   {"trajectory.csv", "certificate.csv", "robot", "scene"})}) {
    if (!unknown.empty()) return unknown;
  }
  for (const JsonMember& item : root.Items("not_covered")) {
    const std::string unknown = UnknownKey(item, "not_covered.", {"kind", "subject", "sentence"});
    if (!unknown.empty()) return unknown;
  }
  return "";
}

TubeText TubeOf(const JsonMember& member) {
  TubeText text;
  text.tube = {.foot = member.Number("foot_m"),
               .foot_turn = member.Number("foot_rad"),
               .waist = member.Number("waist_m"),
               .waist_turn = member.Number("waist_rad"),
               .joint = member.Number("joint_rad"),
               .joint_speed = member.Number("joint_speed_rad_s"),
               .zmp = member.Number("zmp_m")};
  const JsonMember raised = member.Object("raised");
  for (const auto& [name, value] : raised.object().items()) {
    text.raised.emplace_back(name, raised.Number(name.c_str()));
  }
  const JsonMember taken = member.Object("taken");
  text.of_body = taken.Number("clearance");
  text.of_pair = taken.Number("self_clearance");
  return text;
}

}  // namespace

std::vector<NotCoveredItem> NotCoveredItems(const JsonMember& root) {
  std::vector<NotCoveredItem> items;
  for (const JsonMember& item : root.Items("not_covered")) {
    items.push_back({item.String("kind"), item.String("subject"), item.String("sentence")});
  }
  return items;
}

CertificateText ReadCertificateJson(const std::string& path, const std::string& text) {
  const nlohmann::json document = ParseJson(path, text);
  const JsonMember root(path, document, "");
  if (root.Whole("format") != 2) root.Fail("format: only 2 is known");
  CertificateText c;
  c.verdict = root.String("verdict");
  c.message = root.String("message");
  c.statement = root.String("statement");
  c.duration = root.Number("duration_s");
  c.unknown = UnknownKeyOf(root);
  const JsonMember demanded = root.Object("demanded"), statements = root.Object("statements");
  for (size_t f = 0; f < kNumFamilies; ++f) {
    if (MayBeAbsent(static_cast<Family>(f)) && !statements.object().contains(kFamilyNames[f])) {
      c.demanded[f] = kNotDemanded;
      continue;
    }
    c.demanded[f] = MayBeLeftOut(static_cast<Family>(f))
                        ? demanded.NumberOrNull(kFamilyNames[f]).value_or(kNotDemanded)
                        : demanded.Number(kFamilyNames[f]);
    c.statements[f] = statements.Whole(kFamilyNames[f]);
  }
  c.not_covered = NotCoveredItems(root);
  const JsonMember limits = root.Object("limits");
  c.foot_speed = limits.NumberOrNull("foot_speed_m_s");
  c.foot_yaw_rate = limits.NumberOrNull("foot_yaw_rate_rad_s");
  c.joint_speed_scale = limits.Number("joint_speed_scale");
  const auto if_there = [&limits](const char* key) {
    return limits.object().contains(key) ? limits.NumberOrNull(key) : std::nullopt;
  };
  c.joint_acceleration = if_there("joint_acceleration_rad_s2");
  c.landing_speed = if_there("landing_speed_m_s");
  if (root.object().contains("tube")) c.tube = TubeOf(root.Object("tube"));
  c.robot = root.String("robot");
  c.scene = root.String("scene");
  const JsonMember hashes = root.Object("sha256");
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

}  // namespace halfstep::verify
