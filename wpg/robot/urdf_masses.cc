#include "wpg/robot/urdf_masses.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/geometry/side.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Rounding of files: inertias have few digits, and thin bodies meet the limit.
constexpr double kMomentTolerance = 1e-3;
// A negative moment of inertia counts when it is more than this of those of the body that the link
// is part of, and than the link's mass has within a micrometre: point masses have rounded zeros.
constexpr double kNegligible = 1e-6;
constexpr double kMicrometre = 1e-6;                     // [m]
constexpr double kLightest = 10.0, kHeaviest = 20000.0;  // [kg/m³]

// Principal moments of inertia, ascending [kg m²].
Vector3d Moments(const UrdfLink& link) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(link.inertia, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

// More than files round.
bool Negative(const Vector3d& moments) {
  return !(moments[0] >= -kMomentTolerance * moments.cwiseAbs().maxCoeff());
}

// Inertia of a point mass about the origin.
Matrix3d OfPoint(double mass, const Vector3d& p) {
  return mass * (p.squaredNorm() * Matrix3d::Identity() - p * p.transpose());
}

void Add(const BodyMass& more, BodyMass* sum) {
  const double mass = sum->mass + more.mass;
  if (!(mass > 0.0)) return;
  const Vector3d com = (sum->mass * sum->com + more.mass * more.com) / mass;
  sum->inertia +=
      more.inertia + OfPoint(sum->mass, sum->com - com) + OfPoint(more.mass, more.com - com);
  sum->com = com;
  sum->mass = mass;
}

// A moment of inertia of mass m within r of its centre is at most m r². "" when it may be so.
std::string TooFarOut(const std::string& what, double mass, const Matrix3d& inertia,
                      double farthest) {
  const double most = inertia.diagonal().maxCoeff();
  if (!(most > mass * farthest * farthest)) return "";
  return what + Formatted(
                    " has %.3g kg and a moment of inertia of %.3g kg m², as if it reached %.1f m "
                    "far (are the URDF's inertias in kg m²?)",
                    mass, most, std::sqrt(most / mass));
}

// Volume of the boxes around a link's shapes [m³]; none when a shape is a mesh or there is none.
std::optional<double> BoxVolume(const UrdfLink& link) {
  double volume = 0.0;
  for (const UrdfCollision& shape : link.collisions) {
    switch (shape.kind) {
      case UrdfCollision::Kind::kBox:
        volume += shape.size.prod();
        break;
      case UrdfCollision::Kind::kSphere:
        volume += 8.0 * shape.size.x() * shape.size.x() * shape.size.x();
        break;
      case UrdfCollision::Kind::kCylinder:
        volume += 4.0 * shape.size.x() * shape.size.x() * shape.size.y();
        break;
      case UrdfCollision::Kind::kMesh:
        return std::nullopt;
    }
  }
  if (!(volume > 0.0)) return std::nullopt;
  return volume;
}

}  // namespace

RobotMasses AddUpMasses(const UrdfTree& urdf, const std::vector<LinkAnchor>& anchors,
                        double farthest) {
  RobotMasses masses;
  masses.fault.clear();
  const auto body_of = [&](const LinkAnchor& anchor) -> BodyMass& {
    if (anchor.leg < 0) return masses.waist;
    return Nth(Nth(masses.links, anchor.leg), anchor.link);
  };
  for (size_t i = 0; i < urdf.links.size(); ++i) {
    const UrdfLink& link = urdf.links[i];
    const LinkAnchor& anchor = anchors[i];
    const Matrix3d R = anchor.X_AnchorLink.linear();
    Add({link.mass, anchor.X_AnchorLink * link.com, R * link.inertia * R.transpose()},
        &body_of(anchor));
  }
  for (size_t i = 0; i < urdf.links.size(); ++i) {
    const Vector3d moments = Moments(urdf.links[i]);
    const double negligible = std::max(kNegligible * body_of(anchors[i]).inertia.trace(),
                                       urdf.links[i].mass * kMicrometre * kMicrometre);
    if (!Negative(moments) || -moments[0] <= negligible) continue;
    masses.fault = "link " + urdf.links[i].name + " has the negative moment of inertia " +
                   Formatted("%.4g", moments[0]) + " kg m²";
  }
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const std::string leg = "the " + std::string(Name(side)) + " leg";
    double mass = 0.0;
    Matrix3d inertia = Matrix3d::Zero();
    for (const BodyMass& link : Nth(masses.links, Index(side))) {
      mass += link.mass;
      inertia += link.inertia;
    }
    if (!(mass > 0.0)) masses.fault = leg + " has no mass";
    if (masses.fault.empty()) masses.fault = TooFarOut(leg, mass, inertia, farthest);
  }
  if (masses.fault.empty()) {
    masses.fault =
        TooFarOut("what the waist carries", masses.waist.mass, masses.waist.inertia, farthest);
  }
  if (!(masses.waist.mass > 0.0)) masses.fault = "nothing on the waist has a mass";
  return masses;
}

std::vector<std::string> MassWarnings(const UrdfTree& urdf) {
  Complaints told;
  for (const UrdfLink& link : urdf.links) {
    const auto tell = [&](const std::string& what) {
      told.Add(urdf.file, link.place.line, link.place.column, link.name, what);
    };
    const Vector3d moments = Moments(link);
    if (moments[2] > (1.0 + kMomentTolerance) * (moments[0] + moments[1])) {
      tell(
          Formatted("the moment of inertia %.4g kg m² exceeds the sum of the two others, %.4g: no "
                    "rigid body has such an inertia",
                    moments[2], moments[0] + moments[1]));
    }
    const auto volume = BoxVolume(link);
    if (!volume || !(link.mass > 0.0)) continue;
    const double density = link.mass / *volume;
    if (density < kLightest || density > kHeaviest) {
      tell(
          Formatted("the mass of %.4g kg in the boxes around its collision shapes is a density of "
                    "%.3g kg/m³ (usual: %.0f … %.0f)",
                    link.mass, density, kLightest, kHeaviest));
    }
  }
  return told.lines();
}

}  // namespace halfstep
