#include "experiments/live/script_event.h"

namespace halfstep {
namespace {

constexpr double kFastestCourse = 2.0;     // along x, y and a path [m/s], and of yaw [rad/s]
constexpr double kSlowestPath = 0.001;     // [m/s]
constexpr double kShortestSegment = 1e-3;  // of a path [m]

void DeclareFootstep(Fields& fields, CommandedFootstep* one) {
  std::string foot(Name(one->side));
  fields.Text(
      "foot", &foot,
      {.meaning = "that is to stand there", .required = true, .choices = {"left", "right"}});
  one->side = foot == "right" ? Side::kRight : Side::kLeft;
  const auto place = [&](const char* key, double* value) {
    fields.Number(
        key, value,
        {.meaning = "of the sole", .unit = "m", .min = -1000, .max = 1000, .required = true});
  };
  place("x_m", &one->X_WF.x);
  place("y_m", &one->X_WF.y);
  fields.Number("yaw_deg", &one->X_WF.yaw,
                {.meaning = "of the sole", .unit = "deg", .min = -36000, .max = 36000});
}

// The keys of events that command a course; others do not have them. `e->what` is "" where all keys
// are explained.
void DeclareCommand(Fields& fields, ScriptEvent* e) {
  const auto is = [e](const char* what) { return e->what.empty() || e->what == what; };
  if (is("walk")) {
    fields.Numbers("velocity", &e->velocity, 0,
                   {.meaning = "of walk: forward and to the left [m/s], of yaw [rad/s], as seen by "
                               "the robot, which goes on until the next command; [0, 0, 0]: it "
                               "comes to rest",
                    .min = -kFastestCourse,
                    .max = kFastestCourse});
  }
  if (is("follow")) {
    fields.Points("path_m", &e->path,
                  {.meaning = "of follow: points of a polyline in W", .max_items = 1000},
                  {.meaning = "of a point", .unit = "m", .min = -1000, .max = 1000});
  }
  if (is("footsteps")) {
    fields.List("footsteps",
                {.meaning = "of footsteps: to be taken in their order", .max_items = 100},
                &e->footsteps, DeclareFootstep);
  }
  if (e->what == "walk" && e->velocity.size() != 3) {
    fields.Complain("velocity",
                    "is missing or of another length (valid: forward, left, yaw rate in m/s, m/s, "
                    "rad/s)");
  }
  if (e->what == "footsteps" && e->footsteps.empty()) {
    fields.Complain("footsteps", "is missing (valid: at least one)");
  }
  if (e->what != "follow") return;
  if (e->path.cols() < 2) {
    fields.Complain("path_m", "is missing or too short (valid: at least two points)");
  } else if (!IsPath(e->path)) {
    fields.Complain("path_m", "has a point twice in a row (valid: points 1 mm apart and more)");
  }
  if (!(e->speed >= kSlowestPath && e->speed <= kFastestCourse)) {
    fields.Complain("speed_m_s", "is missing or out of range (valid: of follow from 0.001 to 2)");
  }
}

}  // namespace

void DeclareFields(Fields& fields, ScriptEvent* e) {
  fields.Number(
      "at_s", &e->at,
      {.meaning = "when it happens", .unit = "s", .min = 0, .max = 3600, .required = true});
  fields.Text("do", &e->what,
              {.meaning = "an obstacle jumps, is carried, appears or vanishes; the goal moves; in "
                          "place of the goal: to walk at a velocity, to follow a path, to take "
                          "footsteps; a no-step area appears; no frame arrives for a while",
               .required = true,
               .choices = {"jump", "carry", "appear", "vanish", "goal", "walk", "follow",
                           "footsteps", "forbid", "lose"}});
  fields.Text("obstacle", &e->obstacle, {.meaning = "of jump, carry, appear, vanish: its name"});
  fields.Numbers("xyz", &e->xyz, 0,
                 {.meaning = "of jump and carry: where to; []: of others",
                  .unit = "m",
                  .min = -1000,
                  .max = 1000});
  fields.Number("yaw_deg", &e->turn,
                {.meaning = "of jump and carry: how far it turns about the world's z",
                 .unit = "deg",
                 .min = -360,
                 .max = 360});
  fields.Number(
      "speed_m_s", &e->speed,
      {.meaning = "of carry, and of follow: along the path", .unit = "m/s", .min = 0, .max = 10});
  fields.Numbers(
      "goal_m", &e->goal, 0,
      {.meaning = "of goal: its new place; []: of others", .unit = "m", .min = -1000, .max = 1000});
  fields.Integer("area", &e->area,
                 {.meaning = "of forbid: which no-step area, from 1", .min = 1, .max = 100000});
  fields.Number("for_s", &e->lasts, {.meaning = "of lose", .unit = "s", .min = 0, .max = 3600});
  DeclareCommand(fields, e);
  const bool moves = e->what == "jump" || e->what == "carry";
  const bool of_obstacle = moves || e->what == "appear" || e->what == "vanish";
  if (of_obstacle && e->obstacle.empty()) {
    fields.Complain("obstacle", "is missing (valid: the name of an obstacle of the scene)");
  }
  if (e->xyz.size() != 3 && (moves || !e->xyz.empty())) {
    fields.Complain("xyz", "is missing or of another length (valid: x, y, z in m)");
  }
  if (e->what == "carry" && !(e->speed > 0.0)) {
    fields.Complain("speed_m_s", "is missing (valid: above 0)");
  }
  if (e->goal.size() != 2 && (e->what == "goal" || !e->goal.empty())) {
    fields.Complain("goal_m", "is missing or of another length (valid: x, y in m)");
  }
}

bool IsPath(const Eigen::Matrix2Xd& points) {
  for (Eigen::Index i = 0; i + 1 < points.cols(); ++i) {
    if (!((points.col(i + 1) - points.col(i)).norm() >= kShortestSegment)) return false;
  }
  return points.cols() >= 2;
}

bool Commands(const ScriptEvent& event) {
  return event.what == "walk" || event.what == "follow" || event.what == "footsteps";
}

Course CourseOf(const ScriptEvent& event, int number) {
  Course course{.number = number, .path = {}, .footsteps = event.footsteps};
  if (event.what == "walk") {
    course.velocity = {event.velocity[0], event.velocity[1], event.velocity[2]};
  } else if (event.what == "follow") {
    course.kind = CourseKind::kPath;
    course.speed = event.speed;
    for (Eigen::Index i = 0; i < event.path.cols(); ++i) course.path.push_back(event.path.col(i));
  } else {
    course.kind = CourseKind::kFootsteps;
  }
  return course;
}

}  // namespace halfstep
