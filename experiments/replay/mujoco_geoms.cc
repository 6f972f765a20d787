#include "experiments/replay/mujoco_geoms.h"

#include "wpg/check.h"
#include "wpg/files/number_text.h"

namespace halfstep::replay {
namespace {

// Coordinates of vertices, one after the other.
std::string VertexText(const ConvexBody& body) {
  std::string text;
  for (Eigen::Index i = 0; i < body.vertices.cols(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      text += (text.empty() ? "" : " ") + ShortestText(body.vertices(k, i));
    }
  }
  return text;
}

}  // namespace

std::string Attribute(const std::string& name, const std::string& value) {
  std::string text = " " + name + "=\"";
  for (const char c : value) {
    switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '"':
        text += "&quot;";
        break;
      default:
        text += c;
    }
  }
  return text + "\"";
}

MujocoGeom GeomOf(const ConvexBody& body, const std::string& name) {
  const Eigen::Index vertices = body.vertices.cols();
  if (vertices == 1) {
    return {.shape = " type=\"sphere\"" + Attribute("size", ShortestText(body.ball_radius)) +
                     Attribute("pos", VertexText(body)),
            .asset = ""};
  }
  if (vertices == 2) {
    const bool disc = body.disc_radius > 0.0;
    const double radius = disc ? body.disc_radius : body.ball_radius;
    return {.shape = Attribute("type", disc ? "cylinder" : "capsule") +
                     Attribute("size", ShortestText(radius)) +
                     Attribute("fromto", VertexText(body)),
            .asset = ""};
  }
  HALFSTEP_CHECK(vertices >= 4 && body.disc_radius == 0.0, "no body that MuJoCo has");
  return {
      .shape = " type=\"mesh\"" + Attribute("mesh", name),
      .asset = "<mesh" + Attribute("name", name) + Attribute("vertex", VertexText(body)) + "/>"};
}

}  // namespace halfstep::replay
