#include "experiments/checker/trajectory_report.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "wpg/files/text.h"

namespace halfstep::checker {
namespace {

using Kind = TrajectoryFinding::Kind;
using Json = nlohmann::ordered_json;

struct KindText {
  Kind kind;
  const char* name;
  const char* unit;
  double scale;  // of `unit` per SI unit
};
constexpr KindText kTexts[] = {{Kind::kLimits, "joint limits", "rad", 1.0},
                               {Kind::kSpeed, "joint speeds", "rad/s", 1.0},
                               {Kind::kAcceleration, "joint accelerations", "rad/s²", 1.0},
                               {Kind::kSelfClearance, "self clearance", "mm", 1e3},
                               {Kind::kClearance, "clearance", "mm", 1e3}};

std::string MissedText(const TrajectoryFinding& finding, const KindText& text) {
  if (text.kind == Kind::kAcceleration && std::isinf(finding.least)) {
    return Formatted("%s at %.4f s: its velocity jumps there (linear pieces have no accelerations)",
                     finding.subject.c_str(), finding.at);
  }
  std::string said =
      Formatted("%s at %.4f s: %.4g %s, %.4g demanded", finding.subject.c_str(), finding.at,
                text.scale * finding.least, text.unit, text.scale * finding.demanded);
  if (finding.at_knots && *finding.at_knots >= finding.demanded) {
    said +=
        Formatted("; no knot shows it (%.4g %s there)", text.scale * *finding.at_knots, text.unit);
  }
  return said;
}

std::string KindScreen(const TrajectoryCheck& check, const KindText& text) {
  int subjects = 0, missed = 0;
  const TrajectoryFinding* nearest = nullptr;
  std::string lines;
  for (const TrajectoryFinding& finding : check.findings) {
    if (finding.kind != text.kind) continue;
    ++subjects;
    if (!finding.proved) {
      ++missed;
      if (missed <= 10) lines += "  " + MissedText(finding, text) + "\n";
    } else if (nearest == nullptr || finding.least < nearest->least) {
      nearest = &finding;
    }
  }
  if (subjects == 0) return "";
  std::string head = Formatted("%-20s ", text.name);
  if (missed == 0) {
    head += Formatted("proved for all t: %d", subjects);
    if (!std::isinf(nearest->least)) {
      head += Formatted(", each by %.4g %s or more (%s)", text.scale * nearest->least, text.unit,
                        nearest->subject.c_str());
    }
  } else {
    head += Formatted("not proved: %d of %d", missed, subjects);
    if (missed > 10) lines += Formatted("  and %d more (--json)\n", missed - 10);
  }
  return head + "\n" + lines;
}

}  // namespace

std::string CheckScreen(const Trajectory& trajectory, const TrajectoryCheck& check) {
  std::string screen =
      Formatted("%s: %zu joints, %zu knots, %.4g s, %s between knots\n\n", trajectory.file.c_str(),
                trajectory.joints.size(), trajectory.times.size(),
                trajectory.times.back() - trajectory.times.front(), Name(trajectory.interpolation));
  for (const KindText& text : kTexts) screen += KindScreen(check, text);
  if (check.stopped) screen += "stopped before all pairs of bodies were looked at\n";
  screen += "\nnot looked at:\n";
  for (const std::string& line : check.not_covered) screen += "  " + line + "\n";
  return screen;
}

std::string CheckJson(const Trajectory& trajectory, const TrajectoryCheck& check) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  Json findings = Json::array();
  for (const TrajectoryFinding& finding : check.findings) {
    for (const KindText& text : kTexts) {
      if (text.kind != finding.kind) continue;
      findings.push_back({{"kind", text.name},
                          {"subject", finding.subject},
                          {"proved", finding.proved},
                          {"demanded", number(finding.demanded)},
                          {"least", number(finding.least)},
                          {"at_s", finding.at}});
      if (finding.at_knots) findings.back()["at_knots"] = number(*finding.at_knots);
    }
  }
  const Json json = {{"trajectory", trajectory.file},
                     {"knots", trajectory.times.size()},
                     {"duration_s", trajectory.times.back() - trajectory.times.front()},
                     {"interpolation", Name(trajectory.interpolation)},
                     {"proved", check.proved()},
                     {"stopped", check.stopped},
                     {"intervals", check.intervals},
                     {"findings", findings},
                     {"not_covered", check.not_covered}};
  return json.dump(2) + "\n";
}

}  // namespace halfstep::checker
