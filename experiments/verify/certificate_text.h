#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "smoothing/margins/tube.h"

namespace halfstep::verify {

class JsonMember;

/// The families of a certificate, in the order of the program's own list.
enum Family : int {
  kFloor,
  kFootSpeed,
  kFootYawRate,
  kZmp,
  kReach,
  kJoint,
  kJointSpeed,
  kSelfClearance,
  kClearance,
  kGround,
  kNoStep,
  kZmpRobot,
  kTorque,
  kFriction,
  kJointAcceleration,
  kDoubleSupport,
  kLandingSpeed,
  kFoothold,
  kOwn  ///< what the program that made the run registered; its formula is not known here
};
constexpr int kNumFamilies = kOwn + 1;  ///< how many families a certificate has
/// Their names in certificate.csv and certificate.json, and their units.
constexpr std::array<const char*, kNumFamilies> kFamilyNames = {
    "floor",          "foot_speed",    "foot_yaw_rate",  "zmp",       "reach",
    "joint",          "joint_speed",   "self_clearance", "clearance", "ground",
    "no_step",        "zmp_robot",     "torque",         "friction",  "joint_acceleration",
    "double_support", "landing_speed", "foothold",       "own"};
/// Of the families' margins.
constexpr std::array<const char*, kNumFamilies> kUnits = {
    "m", "m/s", "rad/s", "m", "m",      "rad", "rad/s", "m", "m", "m",
    "m", "m",   "N m",   "1", "rad/s²", "s",   "m/s",   "m", "1"};
static_assert(std::string_view(kFamilyNames.back()) == "own" && kUnits.back() != nullptr,
              "a family lacks its name or its unit");

/// What is demanded of a family of which nothing is demanded: `null` in certificate.json.
inline constexpr double kNotDemanded = -std::numeric_limits<double>::infinity();

/// Whether a family rests on the whole robot's dynamics.
constexpr bool IsOfDynamics(Family family) {
  return family == kZmpRobot || family == kTorque || family == kFriction;
}
/// Whether only certificates of some robots or programs have a family.
constexpr bool MayBeAbsent(Family family) {
  return family == kJointAcceleration || family == kDoubleSupport || family == kLandingSpeed ||
         family == kFoothold || family == kOwn;
}
/// Whether nothing may be demanded of a family.
constexpr bool MayBeLeftOut(Family family) {
  return IsOfDynamics(family) || family == kJointAcceleration || family == kDoubleSupport;
}
/// Whether a family is about the foot in the air, and about none while both stand.
constexpr bool IsOfSwingFoot(Family family) {
  return family <= kFootYawRate || family == kLandingSpeed;
}

/// A row of certificate.csv.
struct ClaimRow {
  int line = 0;                                ///< in its file.
  double begin = 0, end = 0;                   ///< [s]
  Family family = kFloor;                      ///< of which the row speaks
  int statements = 0;                          ///< how many it speaks for
  std::string subject;                         ///< whose margin is the least of them
  double margin = 0, bound = 0, demanded = 0;  ///< [unit of the family]
};

/// One thing that a certificate or a manifest says it does not cover, as it is written there.
struct NotCoveredItem {
  std::string kind, subject, sentence;  ///< as in wpg/robot/not_covered.h
  friend bool operator==(const NotCoveredItem&, const NotCoveredItem&) = default;
};

/// How far motions may be from the walk that a certificate speaks of, and what it says that this
/// adds to its demands and takes from its margins.
struct TubeText {
  Tube tube;                                           ///< [m], [rad], [rad/s]
  std::vector<std::pair<std::string, double>> raised;  ///< by family
  double of_body = 0, of_pair = 0;                     ///< taken at most from a clearance [m]
};

/// What certificate.json and certificate.csv claim; nothing of it is believed.
struct CertificateText {
  /// For the whole walk: "certified", and two texts for people.
  std::string verdict, message, statement;
  double duration = 0;  ///< [s]
  std::string unknown;  ///< the first key that is not known here; "": none is
  /// kNotDemanded where nothing is, which only families that may be left out have.
  std::array<double, kNumFamilies> demanded{};
  std::array<long, kNumFamilies> statements{};      ///< how many each family has at every instant
  std::vector<NotCoveredItem> not_covered;          ///< of which nothing is claimed
  std::optional<double> foot_speed, foot_yaw_rate;  ///< [m/s], [rad/s]; none: no limit.
  double joint_speed_scale = 1;                     ///< fraction of the robot's limits
  std::optional<double> landing_speed;              ///< [m/s]; none: no limit
  std::optional<double> joint_acceleration;         ///< assumed [rad/s²]; none: nothing is
  std::optional<TubeText> tube;                     ///< none: of the walk alone
  std::string robot, scene;  ///< paths relative to the run folder; scene: or "none".
  /// SHA-256 as hexadecimal text.
  std::string trajectory_hash, certificate_hash, robot_hash, scene_hash;
};

/// The list `not_covered` of an object. Throws InputError for what is no such list.
std::vector<NotCoveredItem> NotCoveredItems(const JsonMember& root);

/// Throws InputError for what is not such a file.
CertificateText ReadCertificateJson(const std::string& path, const std::string& text);
/// The rows, in file order.
std::vector<ClaimRow> ReadCertificateCsv(const std::string& path, const std::string& text);

}  // namespace halfstep::verify
