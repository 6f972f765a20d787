#include "experiments/survey/robot_picture.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHeight = 760;  // of a view [px]
constexpr double kGap = 40;      // around views [px]

// A view along an axis of W: what is drawn to the right and up, and the axis towards the eye.
struct View {
  const char* title;
  Vector3d right, up;
};

class Drawing {
 public:
  Drawing(const View& view, double scale, Vector2d origin)
      : view_(view), scale_(scale), origin_(std::move(origin)) {}

  Vector2d At(const Vector3d& p_W) const {
    return origin_ + scale_ * Vector2d(view_.right.dot(p_W), -view_.up.dot(p_W));
  }

  // The outline of a body: of its points that are farthest in 72 directions of the view.
  void Body(const ConvexBody& body, const Isometry3d& X_WBody, const char* colour) {
    std::string points;
    for (int k = 0; k < 72; ++k) {
      const double angle = std::numbers::pi * k / 36;
      const Vector3d to = Cos(angle) * view_.right + Sin(angle) * view_.up;
      const Vector2d at = At(X_WBody * SupportPoint(body, X_WBody.linear().transpose() * to));
      points += Formatted("%.1f,%.1f ", at.x(), at.y());
    }
    text_ += "<polygon points='" + points + "' fill='" + colour + "' fill-opacity='0.25' stroke='" +
             colour + "' stroke-width='0.7'/>\n";
  }

  void Line(const Vector3d& a_W, const Vector3d& b_W, const char* colour, double width) {
    const Vector2d a = At(a_W), b = At(b_W);
    text_ += Formatted(
        "<line x1='%.1f' y1='%.1f' x2='%.1f' y2='%.1f' stroke='%s' "
        "stroke-width='%.1f' stroke-linecap='round'/>\n",
        a.x(), a.y(), b.x(), b.y(), colour, width);
  }

  void Dot(const Vector3d& p_W, const char* colour, const std::string& title) {
    const Vector2d at = At(p_W);
    text_ += Formatted("<circle cx='%.1f' cy='%.1f' r='4' fill='%s'><title>%s</title></circle>\n",
                       at.x(), at.y(), colour, title.c_str());
  }

  // x red, y green, z blue.
  void Frame(const Isometry3d& X_W, double length) {
    constexpr std::array<const char*, 3> kColours = {"#c1272d", "#1a7f37", "#0550ae"};
    for (int i = 0; i < 3; ++i) {
      Line(X_W.translation(), X_W * (length * Vector3d::Unit(i)), Nth(kColours, i), 2.5);
    }
  }

  void Title(const Vector2d& at, const std::string& text) {
    text_ += Formatted("<text x='%.0f' y='%.0f'>%s</text>\n", at.x(), at.y(), text.c_str());
  }

  const std::string& text() const { return text_; }

 private:
  const View view_;
  const double scale_;
  const Vector2d origin_;
  std::string text_;
};

// The robot in W, the floor at z = 0 and the waist above the origin.
struct Standing {
  Isometry3d X_WB = Isometry3d::Identity();
  std::array<LegFrames, 2> legs;
};

void Draw(const RobotModel& robot, const Standing& standing, Drawing* drawing) {
  constexpr std::array<const char*, 2> kLegs = {"#8250df", "#bc4c00"};
  for (const RobotBody& body : robot.bodies) {
    const Isometry3d X = body.leg < 0
                             ? standing.X_WB
                             : standing.X_WB * Nth(Nth(standing.legs, body.leg).X_BLink, body.link);
    drawing->Body(body.shape, X, body.leg < 0 ? "#57606a" : Nth(kLegs, body.leg));
  }
  const double size = 0.1 * std::max(robot.waist_height, 0.5 * robot.com_height);
  for (size_t leg = 0; leg < 2; ++leg) {
    const LegFrames& frames = standing.legs[leg];
    for (size_t i = 0; i < 6; ++i) {
      const Vector3d at = standing.X_WB * frames.point_B[i];
      const Vector3d along = 0.5 * size * (standing.X_WB.linear() * frames.axis_B[i]);
      drawing->Line(at - along, at + along, "#24292f", 1.2);
      drawing->Dot(at, "#24292f", robot.legs[leg].joints[i].name);
    }
    const Isometry3d X_WSole = standing.X_WB * frames.X_BLink[6];
    const Vector2d half = 0.5 * robot.sole_size;
    const std::array<Vector3d, 4> corners = {
        X_WSole * Vector3d(half.x(), half.y(), 0), X_WSole * Vector3d(-half.x(), half.y(), 0),
        X_WSole * Vector3d(-half.x(), -half.y(), 0), X_WSole * Vector3d(half.x(), -half.y(), 0)};
    for (size_t i = 0; i < 4; ++i) {
      drawing->Line(corners[i], corners[(i + 1) % 4], kLegs[leg], 3);
    }
    drawing->Frame(X_WSole, size);
  }
  drawing->Frame(standing.X_WB, 1.5 * size);
  drawing->Dot(Vector3d(robot.com_x_B, 0, robot.com_height), "#e3b341", "CoM");
}

}  // namespace

std::string RobotPicture(const RobotModel& robot) {
  Standing standing;
  standing.X_WB.translation().z() = robot.waist_height;
  for (size_t leg = 0; leg < 2; ++leg) {
    standing.legs[leg] = PlaceLeg(robot.legs[leg], robot.legs[leg].standing_q);
  }
  double top = std::max(robot.waist_height, 0.0), reach = 0.5 * robot.standing_width;
  for (const RobotBody& body : robot.bodies) {
    const Isometry3d X = body.leg < 0
                             ? standing.X_WB
                             : standing.X_WB * Nth(Nth(standing.legs, body.leg).X_BLink, body.link);
    const Vector3d centre = X * body.shape.center;
    top = std::max(top, centre.z() + body.shape.radius);
    reach = std::max(reach, centre.head<2>().cwiseAbs().maxCoeff() + body.shape.radius);
  }
  const double scale = kHeight / top, width = 2 * reach * scale;
  const std::array<View, 3> views = {
      View{"from the right: x →", Vector3d::UnitX(), Vector3d::UnitZ()},
      View{"from behind: y ←", -Vector3d::UnitY(), Vector3d::UnitZ()},
      View{"from above: x ↑, y ←", -Vector3d::UnitY(), Vector3d::UnitX()}};
  std::string text = Formatted(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' font-family='sans-serif' "
      "font-size='15'>\n<rect width='100%%' height='100%%' fill='white'/>\n",
      3 * (width + kGap) + kGap, kHeight + 3 * kGap);
  for (size_t i = 0; i < views.size(); ++i) {
    const double middle = kGap + (static_cast<double>(i) + 0.5) * (width + kGap);
    const double floor = i == 2 ? kGap + 0.5 * kHeight : kGap + kHeight;
    Drawing drawing(views[i], scale, {middle, floor});
    if (i < 2) {
      drawing.Line(-reach * views[i].right, reach * views[i].right, "#afb8c1", 1);
    }
    Draw(robot, standing, &drawing);
    drawing.Title({middle - 0.5 * width, kHeight + 2 * kGap}, views[i].title);
    text += drawing.text();
  }
  return text +
         Formatted(
             "<text x='%.0f' y='%.0f'>%s: waist frame and soles x red, y green, z blue; left "
             "leg violet, right leg orange; CoM yellow; legs' axes black</text>\n</svg>\n",
             kGap, kHeight + 2.6 * kGap, robot.name.c_str());
}

}  // namespace halfstep
