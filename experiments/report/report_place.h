#pragma once

#include <nlohmann/json.hpp>

#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What the page needs to draw a robot at any joint angles: the axes of its legs and the surfaces
/// of its bodies, all in the waist frame B at q = 0; [m], to 0.1 mm.
nlohmann::json RobotJson(const RobotModel& robot);

/// The obstacles' surfaces and the no-step polygons in W; [m], to 0.1 mm. Large meshes are drawn
/// coarser. Obstacles with waypoints have them as `places`, and their surface about their origin;
/// what is not known of where an obstacle is, is not drawn. Of more than 2,000 obstacles the
/// nearest to `middle_W` [m] are drawn, by their frames' origins, and the scene's name says so.
/// Pages draw the floor at z = 0, so the ground is that (std::logic_error).
nlohmann::json SceneJson(const Scene& scene, const Eigen::Vector2d& middle_W = {0.0, 0.0});

/// The same with every obstacle in its own frame, to be put where it is told to be.
nlohmann::json ShapesJson(Scene scene);

}  // namespace halfstep
