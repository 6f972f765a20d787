#include "experiments/verify/check_certificate.h"

#include <algorithm>
#include <cmath>

#include "experiments/config/known_names.h"
#include "experiments/tables/certificate_statement.h"
#include "experiments/verify/robot_numbers.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

// What a certificate says of a walk that it is about.
constexpr char kCertified[] = "every demanded margin is kept at all times";

long CountOf(Family family, const RobotModel& robot, const Ground& ground) {
  switch (family) {
    case kReach:
    case kNoStep:
      return std::ssize(robot.legs);
    case kJoint:
    case kJointSpeed:
    case kTorque:
      return std::ssize(robot.legs[0].joints) + std::ssize(robot.legs[1].joints);
    case kJointAcceleration:
      return LimitsAccelerations(robot) ? CountOf(kJoint, robot, ground) : 0;
    case kSelfClearance:
      return std::ssize(robot.self_pairs);
    case kClearance:
    case kGround:
      return std::ssize(robot.bodies);
    case kFoothold:
      return ground.OnlyLevel() ? 0 : std::ssize(robot.legs);
    case kFloor:  // the floor, and what stands out of it
      return ground.Solids().empty() ? 1 : 2;
    case kFootSpeed:
    case kFootYawRate:
    case kZmp:
    case kZmpRobot:
    case kFriction:
      return 1;
    case kDoubleSupport:
    case kLandingSpeed:
    case kOwn:
      break;
  }
  return 0;
}

// Of families that are there on request; of one that is not known here what the certificate says.
long CountOf(Family family, const RobotModel& robot, const Ground& ground,
             const CertificateText& certificate) {
  if (family == kDoubleSupport) return certificate.demanded[kDoubleSupport] != kNotDemanded;
  if (family == kLandingSpeed) return certificate.landing_speed.has_value();
  return family == kOwn ? certificate.statements[kOwn] : CountOf(family, robot, ground);
}

// What is wrong with a row by itself; "": nothing.
std::string Fault(const ClaimRow& row, const CertificateText& certificate) {
  const bool may_watch_nothing =
      IsOfSwingFoot(row.family) || row.family == kDoubleSupport || row.family == kGround ||
      row.family == kNoStep ||  // a foot's bodies; a foot in the air
      row.family == kOwn || certificate.demanded[row.family] == kNotDemanded;
  if (!std::isfinite(row.begin) || !std::isfinite(row.end) || !std::isfinite(row.bound) ||
      std::isnan(row.demanded) || std::isnan(row.margin)) {
    return "a number is not finite";
  }
  if (std::isinf(row.margin) && !may_watch_nothing) return "the margin is not finite";
  if (!(row.begin < row.end)) return "the interval is empty";
  if (!(row.begin >= 0) || !(row.end <= certificate.duration)) return "outside [0, D]";
  if (!(row.bound >= 0)) return "the bound is negative";
  if (row.demanded != certificate.demanded[row.family]) {
    return Formatted("demanded %.9g, certificate.json %.9g", row.demanded,
                     certificate.demanded[row.family]);
  }
  if (!(row.margin - row.bound >= row.demanded)) {
    return Formatted("margin − bound = %.9g < demanded %.9g", row.margin - row.bound, row.demanded);
  }
  return "";
}

// Whether the statements of one family's rows add up to `count` at every instant of [0, end].
// Returns where they do not; "": nowhere.
std::string GapIn(const std::vector<const ClaimRow*>& rows, long count, double end) {
  std::vector<std::pair<double, long>> changes = {{0.0, 0}, {end, 0}};
  for (const ClaimRow* row : rows) {
    changes.emplace_back(row->begin, row->statements);
    changes.emplace_back(row->end, -long{row->statements});
  }
  std::sort(changes.begin(), changes.end());
  long covered = 0;
  for (size_t i = 0; i + 1 < changes.size(); ++i) {
    covered += changes[i].second;
    const double from = changes[i].first, to = changes[i + 1].first;
    if (from < to && covered != count) {
      return Formatted("%ld statements instead of %ld on [%.9g, %.9g] s", covered, count, from, to);
    }
  }
  return "";
}

// What certificate.json says of the whole walk: verdict, statement, duration, limits and demands.
void CheckHead(const CertificateText& certificate, const RobotModel& robot, const Scene& scene,
               double end, Findings* findings) {
  if (certificate.verdict != "certified") {
    findings->Disagree("the certificate's verdict is " + Quote(certificate.verdict) + ": " +
                       Quote(certificate.message));
  }
  if (certificate.verdict == "certified" && certificate.message != kCertified) {
    findings->Disagree("the certificate's message is " + Quote(certificate.message));
  }
  if (!certificate.unknown.empty()) {
    findings->Disagree("certificate.json: " + Quote(certificate.unknown) +
                       " is no key that is known here, so nothing can be said of it");
  }
  const StatedOnRequest stated{
      .double_support = certificate.demanded[kDoubleSupport] != kNotDemanded,
      .landing_speed = certificate.landing_speed.has_value(),
      .tube = certificate.tube.has_value(),
      .levels = !scene.ground->OnlyLevel()};
  if (certificate.statement != CertificateStatement(robot, stated)) {
    findings->Disagree("the certificate's statement is not the one that is verified");
  }
  if (certificate.duration != end) {
    findings->Disagree(Formatted("the certificate ends at %.17g s, the trajectory at %.17g s",
                                 certificate.duration, end));
  }
  const double scale = certificate.joint_speed_scale;
  if (!(scale > 0 && scale <= 1)) {
    findings->Disagree(Formatted("joint_speed_scale is %.9g (valid: above 0, at most 1)", scale));
  }
  for (const auto& limit :
       {certificate.foot_speed, certificate.foot_yaw_rate, certificate.landing_speed}) {
    if (limit && !(*limit > 0)) findings->Disagree(Formatted("a foot's limit is %.9g", *limit));
  }
  for (const double demanded : certificate.demanded) {
    if (!(demanded >= 0 || demanded == kNotDemanded)) {
      findings->Disagree(Formatted("a demanded margin is %.9g", demanded));
    }
  }
}

}  // namespace

std::optional<Family> FamilyNamed(const std::string& name, Findings* findings) {
  const auto found = std::ranges::find(kFamilyNames, name);
  if (found != kFamilyNames.end()) return static_cast<Family>(found - kFamilyNames.begin());
  findings->Disagree("the family " + Quote(name) + " is not known here");
  return std::nullopt;
}

void CheckArithmetic(const CertificateText& certificate, const std::vector<ClaimRow>& rows,
                     const RobotModel& robot, const Scene& scene, double end, Findings* findings) {
  CheckHead(certificate, robot, scene, end, findings);
  double smallest = std::numeric_limits<double>::infinity();
  std::string where;
  std::array<std::vector<const ClaimRow*>, kNumFamilies> by_family;
  for (const ClaimRow& row : rows) {
    const std::string fault = Fault(row, certificate);
    if (!fault.empty()) findings->Disagree(Formatted("certificate.csv:%d: ", row.line) + fault);
    if (row.margin - row.bound - row.demanded < smallest) {
      smallest = row.margin - row.bound - row.demanded;
      where = Formatted("line %d, %s", row.line, kFamilyNames[row.family]);
    }
    by_family[row.family].push_back(&row);
  }
  findings->Say(
      "certificate: " + Count(std::ssize(rows)) + " rows" +
      (rows.empty() ? "" : Formatted(", least to spare %.3g (%s)", smallest, where.c_str())));
  std::string counts;
  for (size_t f = 0; f < kNumFamilies; ++f) {
    const long count = CountOf(static_cast<Family>(f), robot, *scene.ground, certificate);
    if (!MayBeAbsent(static_cast<Family>(f)) || count > 0) {
      counts += std::string(f == 0 ? "" : ", ") + kFamilyNames[f] + " " + std::to_string(count);
    }
    if (certificate.statements[f] != count) {
      findings->Disagree(Formatted("%s: certificate.json has %ld statements, the robot %ld",
                                   kFamilyNames[f], certificate.statements[f], count));
    }
    const std::string gap = GapIn(by_family[f], count, end);
    if (!gap.empty()) findings->Disagree(std::string(kFamilyNames[f]) + ": " + gap);
  }
  findings->Say("statements at every instant: " + counts);
  if (certificate.statements[kOwn] > 0) {
    findings->NotExamined(
        Formatted("whether the family `own` holds (%ld statements): the program that made this run "
                  "registered it, and its formula is not known here",
                  certificate.statements[kOwn]));
  }
}

void CheckAgainstConfig(const CertificateText& certificate, const RobotModel& robot,
                        const SmoothingConfig& smoothing, Findings* findings) {
  const MarginLimits& config = smoothing.limits;
  for (const NamedDemand& of_config : NamedDemands(config)) {
    const std::optional<Family> family = FamilyNamed(of_config.family, findings);
    if (!family || (family == kJointAcceleration && !LimitsAccelerations(robot))) continue;
    if (family == kLandingSpeed && !config.landing_speed) continue;
    // Whether it has to be there is asked of the scene (CheckArithmetic).
    if (family == kFoothold && certificate.statements[kFoothold] == 0) continue;
    const double claimed = certificate.demanded[*family];
    if (claimed < of_config.demanded) {
      findings->Disagree(Formatted("%s: the certificate demands %.9g, config.yaml %.9g",
                                   kFamilyNames[*family], claimed, of_config.demanded));
    }
  }
  const auto looser = [&](const char* name, const std::optional<double>& claimed,
                          const std::optional<double>& of_config) {
    if (of_config && (!claimed || *claimed > *of_config)) {
      findings->Disagree(std::string(name) + ": the certificate's limit is looser than " +
                         Formatted("config.yaml's, %.9g", *of_config));
    }
  };
  looser("foot_speed_m_s", certificate.foot_speed, config.foot_speed);
  looser("foot_yaw_rate_rad_s", certificate.foot_yaw_rate, config.foot_yaw_rate);
  looser("landing_speed_m_s", certificate.landing_speed, config.landing_speed);
  looser("joint_acceleration_rad_s2", certificate.joint_acceleration,
         robot.assumed_acceleration ? smoothing.assumed_acceleration : std::nullopt);
  looser("joint_speed_scale", certificate.joint_speed_scale, config.joint_speed_scale);
  findings->Say("config.yaml: demands no more and allows no less than the certificate");
}

}  // namespace halfstep::verify
