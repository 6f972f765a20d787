#include "experiments/checker/check_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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
constexpr KindText kTexts[] = {{Kind::kContact, "one foot in the air", "s", 1.0},
                               {Kind::kDoubleSupport, "double support", "s", 1.0},
                               {Kind::kFloor, "floor", "mm", 1e3},
                               {Kind::kFootSpeed, "foot speed", "m/s", 1.0},
                               {Kind::kFootYawRate, "foot yaw rate", "rad/s", 1.0},
                               {Kind::kLandingSpeed, "landing speed", "m/s", 1.0},
                               {Kind::kZmp, "zmp", "mm", 1e3},
                               {Kind::kReach, "reach", "mm", 1e3},
                               {Kind::kLimits, "joint limits", "rad", 1.0},
                               {Kind::kSpeed, "joint speeds", "rad/s", 1.0},
                               {Kind::kAcceleration, "joint accelerations", "rad/s²", 1.0},
                               {Kind::kSelfClearance, "self clearance", "mm", 1e3},
                               {Kind::kClearance, "clearance", "mm", 1e3},
                               {Kind::kGround, "ground", "mm", 1e3},
                               {Kind::kNoStep, "no-step areas", "mm", 1e3},
                               {Kind::kFoothold, "footholds", "mm", 1e3},
                               {Kind::kZmpRobot, "zmp of the robot", "mm", 1e3},
                               {Kind::kFriction, "friction", "", 1.0},
                               {Kind::kTorque, "torque", "N m", 1.0},
                               {Kind::kStill, "contact, distance", "mm", 1e3},
                               {Kind::kTilt, "contact, angle", "rad", 1.0}};

// `slides`: of a sliding joint.
std::string Valued(double x, const KindText& text, bool slides = false) {
  std::string unit = text.unit;
  if (slides) unit = unit == "N m" ? "N" : "m" + unit.substr(3);
  return Formatted("%.4g", text.scale * x) + (unit.empty() ? "" : " ") + unit;
}

std::string MissedText(const TrajectoryFinding& finding, const KindText& text) {
  if (text.kind == Kind::kAcceleration && std::isinf(finding.least)) {
    return Formatted("%s at %.4f s: its velocity jumps there (linear pieces have no accelerations)",
                     finding.subject.c_str(), finding.at);
  }
  if (std::isinf(finding.least)) {  // of the ZMP and friction
    return Formatted("%s at %.4f s: the floor does not push there, or not inside of the soles",
                     finding.subject.c_str(), finding.at);
  }
  if (std::isnan(finding.least)) {
    return Formatted("%s at %.4f s: nothing is known there: out of reach, or singular",
                     finding.subject.c_str(), finding.at);
  }
  if (finding.hint_missing) {
    return Formatted("%s at %.4f s: hint missing: no direction is told that separates them there",
                     finding.subject.c_str(), finding.at);
  }
  std::string said = Formatted("%s at %.4f s: ", finding.subject.c_str(), finding.at) +
                     Valued(finding.least, text, finding.slides) +
                     Formatted(", %.4g demanded", text.scale * finding.demanded);
  if (finding.at_knots && *finding.at_knots >= finding.demanded) {
    said += "; no knot shows it (" + Valued(*finding.at_knots, text, finding.slides) + " there)";
  }
  if (finding.holds) said += "; proved is " + Valued(*finding.holds, text) + " as the limit";
  return said;
}

// "A#2 - B" as an option: the links that the bodies are of.
std::string IgnoreOf(const std::string& subject) {
  const auto link = [](const std::string& body) { return body.substr(0, body.rfind('#')); };
  const size_t at = subject.find(" - ");
  return " --ignore " + link(subject.substr(0, at)) + "=" + link(subject.substr(at + 3));
}

std::string KindScreen(const TrajectoryCheck& check, const KindText& text) {
  int subjects = 0, missed = 0;
  std::vector<std::string> ignore;  // what is missed at knots, too
  const TrajectoryFinding* nearest = nullptr;
  std::string lines;
  for (const TrajectoryFinding& finding : check.findings) {
    if (finding.kind != text.kind) continue;
    ++subjects;
    if (!finding.proved) {
      ++missed;
      if (missed <= 10) lines += "  " + MissedText(finding, text) + "\n";
      if (text.kind != Kind::kSelfClearance || !finding.at_knots) continue;
      const std::string option = IgnoreOf(finding.subject);
      if (*finding.at_knots < finding.demanded && std::ranges::count(ignore, option) == 0) {
        ignore.push_back(option);
      }
    } else if (nearest == nullptr || finding.least < nearest->least) {
      nearest = &finding;
    }
  }
  if (subjects == 0) return "";
  std::string head = Formatted("%-20s ", text.name);
  if (missed == 0) {
    head += Formatted("proved for all t: %d", subjects);
    if (!std::isinf(nearest->least)) {
      head += ", each by " + Valued(nearest->least, text, nearest->slides) + " or more (" +
              nearest->subject + ")";
      if (nearest->demanded != 0.0) {
        head += Formatted("; %.4g demanded", text.scale * nearest->demanded);
      }
    }
  } else {
    head += Formatted("not proved: %d of %d", missed, subjects);
    if (missed > 10) lines += Formatted("  and %d more (--json)\n", missed - 10);
    if (!ignore.empty() && ignore.size() <= 40) {
      lines += "  if these links meet by design:";
      for (const std::string& option : ignore) lines += option;
      lines += "\n";
    }
  }
  return head + "\n" + lines;
}

Json JsonOf(Json json, const TrajectoryCheck& check) {
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
      if (finding.holds) findings.back()["holds"] = number(*finding.holds);
      if (finding.hint_missing) findings.back()["hint_missing"] = true;
    }
  }
  json.update({{"proved", check.proved()},
               {"stopped", check.stopped},
               {"intervals", check.intervals},
               {"findings", findings},
               {"not_covered", check.not_covered}});
  return json;
}

}  // namespace

std::string TitleOf(const Trajectory& trajectory) {
  return Formatted("%s: %zu joints%s, %zu knots, %.4g s, %s between knots", trajectory.file.c_str(),
                   trajectory.joints.size(), trajectory.base.size() > 0 ? " and the root" : "",
                   trajectory.times.size(), trajectory.times.back() - trajectory.times.front(),
                   Name(trajectory.interpolation)) +
         (trajectory.base_v.size() > 0 ? ", the root cubic" : "");
}

std::string CheckScreen(const std::string& title, const TrajectoryCheck& check) {
  std::string screen = title + "\n\n";
  for (const KindText& text : kTexts) screen += KindScreen(check, text);
  if (check.stopped) screen += "stopped before all was looked at\n";
  screen += "\nnot looked at:\n";
  for (const std::string& line : check.not_covered) screen += "  " + line + "\n";
  return screen;
}

std::string CheckJson(const Trajectory& trajectory, const TrajectoryCheck& check) {
  return JsonOf({{"trajectory", trajectory.file},
                 {"knots", trajectory.times.size()},
                 {"duration_s", trajectory.times.back() - trajectory.times.front()},
                 {"interpolation", Name(trajectory.interpolation)}},
                check)
             .dump(2) +
         "\n";
}

std::string CheckJson(const std::string& run,
                      const std::vector<std::pair<std::string, TrajectoryCheck>>& methods) {
  Json json = {{"run", run}, {"methods", Json::array()}};
  for (const auto& [method, check] : methods) {
    json["methods"].push_back(JsonOf({{"method", method}}, check));
  }
  return json.dump(2) + "\n";
}

}  // namespace halfstep::checker
