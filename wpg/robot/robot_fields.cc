#include "wpg/robot/robot_fields.h"

#include <algorithm>
#include <filesystem>

#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/geometry/simplified_hull.h"
#include "wpg/robot/robot_bodies.h"

namespace halfstep {
namespace {

std::vector<std::string> LinkNames(const RobotFile& file) {
  std::vector<std::string> names;
  if (file.urdf) {
    for (const UrdfLink& link : file.urdf->links) names.push_back(link.name);
  }
  return names;
}

void DeclareLeg(Fields& fields, const char* side, const std::vector<std::string>& links,
                LegFile* leg) {
  fields.Group(side, {.meaning = "foot of this leg", .required = true}, [&](Fields& f) {
    f.Text("foot_link", &leg->foot_link,
           {.meaning = "URDF link of the foot", .required = true, .choices = links});
    f.Numbers("sole_xyz", &leg->sole_xyz, 3,
              {.meaning = "centre of the sole in the frame of the foot's link",
               .unit = "m",
               .required = true});
    f.Numbers("sole_rpy_deg", &leg->sole_rpy, 3,
              {.meaning = "sole frame (x forward, z up) in the frame of the foot's link: roll, "
                          "pitch, yaw about fixed axes",
               .unit = "deg"});
  });
}

// Whether a joint has an angle, which keys of its name are about. Where there is such a key, and
// none, the reason is told.
bool Turns(Fields& fields, const UrdfJoint& joint) {
  if (joint.kind == UrdfJoint::Kind::kRevolute) return true;
  fields.Misplaced(joint.name.c_str(), joint.faults.empty()
                                           ? "is no revolute joint"
                                           : "is held still: " + joint.faults.front());
  return false;
}

// Keys under the names of the URDF's joints.
void DeclareJoints(Fields& fields, RobotFile* file) {
  const std::vector<UrdfJoint> none;
  const std::vector<UrdfJoint>& joints = file->urdf ? file->urdf->joints : none;
  file->posture_deg.resize(joints.size(), 0.0);
  file->limits_deg.resize(joints.size());
  file->effort_limits.clear();
  for (const UrdfJoint& joint : joints) file->effort_limits.emplace_back(joint.max_effort);
  fields.Group("standing_posture_deg", {.meaning = "joint angles of the standing posture"},
               [&](Fields& f) {
                 for (size_t i = 0; i < joints.size(); ++i) {
                   if (!Turns(f, joints[i])) continue;
                   f.Number(joints[i].name.c_str(), &file->posture_deg[i], {.unit = "deg"});
                 }
               });
  fields.Group("joint_limits_deg", {.meaning = "joint limits tighter than the URDF's"},
               [&](Fields& f) {
                 for (size_t i = 0; i < joints.size(); ++i) {
                   if (!Turns(f, joints[i])) continue;
                   std::vector<double>& limits = file->limits_deg[i];
                   const char* name = joints[i].name.c_str();
                   f.Numbers(name, &limits, 2, {.unit = "deg"});
                   if (limits.empty()) continue;
                   if (!(limits[0] < limits[1]))
                     f.Complain(name, "the lower limit is not below the upper");
                   if (DegreesToRadians(limits[0]) < joints[i].lower - 1e-9 ||
                       DegreesToRadians(limits[1]) > joints[i].upper + 1e-9) {
                     f.Complain(name, "reaches beyond the URDF's limits (valid: " +
                                          ShortestDegrees(joints[i].lower) + " … " +
                                          ShortestDegrees(joints[i].upper) + ")");
                   }
                 }
               });
}

void DeclareEfforts(Fields& fields, RobotFile* file) {
  fields.Group("effort_limits_n_m",
               {.meaning = "torques that joints give, in place of the URDF's efforts; none: not "
                           "known"},
               [&](Fields& f) {
                 for (size_t i = 0; i < file->effort_limits.size(); ++i) {
                   const UrdfJoint& joint = file->urdf->joints[i];
                   if (!Turns(f, joint)) continue;
                   f.OptionalNumber(joint.name.c_str(), &file->effort_limits[i],
                                    {.unit = "N m", .min = 1e-9, .max = 1e5});
                 }
               });
}

void DeclareAccelerations(Fields& fields, RobotFile* file) {
  file->acceleration_limits.resize(file->urdf ? file->urdf->joints.size() : 0);
  fields.Group("acceleration_limits_rad_s2",
               {.meaning = "accelerations that joints are allowed, either way; none: no limit"},
               [&](Fields& f) {
                 for (size_t i = 0; i < file->acceleration_limits.size(); ++i) {
                   const UrdfJoint& joint = file->urdf->joints[i];
                   if (!Turns(f, joint)) continue;
                   f.OptionalNumber(joint.name.c_str(), &file->acceleration_limits[i],
                                    {.unit = "rad/s²", .min = 1e-3, .max = 1e5});
                 }
               });
}

void DeclarePackages(Fields& fields, RobotFile* file) {
  fields.Group("packages", {.meaning = "folders of the package:// names in the URDF"},
               [&](Fields& f) {
                 if (!file->urdf) return;
                 const std::vector<std::string> named = MeshPackages(*file->urdf);
                 file->warnings.clear();
                 for (const std::string& name : f.Keys()) {
                   std::string folder;
                   f.Text(name.c_str(), &folder, {.meaning = "folder"});
                   if (folder.empty()) continue;
                   if (std::find(named.begin(), named.end(), name) == named.end()) {
                     file->warnings.push_back("packages." + name +
                                              ": no collision mesh of the URDF is in it");
                   }
                   file->packages[name] =
                       (std::filesystem::path(f.directory()) / folder).lexically_normal().string();
                 }
               });
}

void DeclareExcluded(Fields& fields, const std::vector<std::string>& links, RobotFile* file) {
  fields.List("excluded_self_pairs",
              {.meaning = "pairs of links that touch by design and are not checked"},
              &file->excluded, [&](Fields& f, ExcludedPair* pair) {
                f.Texts("links", &pair->links,
                        {.meaning = "two links", .required = true, .choices = links});
                f.Text("why", &pair->why, {.meaning = "the reason, for the reader"});
                if (pair->links.size() != 2) f.Complain("links", "must be two links");
              });
}

void DeclareMeshParts(Fields& fields, RobotFile* file) {
  fields.Group("mesh_parts",
               {.meaning = "links whose meshes are cut into so many convex parts, not filled into "
                           "one hull"},
               [&](Fields& f) {
                 if (!file->urdf) return;
                 for (const UrdfLink& link : file->urdf->links) {
                   if (!HasMesh(link)) continue;
                   int parts = 1;
                   f.Integer(link.name.c_str(), &parts, {.min = 1, .max = 32});
                   if (parts > 1) file->mesh_parts[link.name] = parts;
                 }
               });
}

// Also reads the URDF, which other keys are about.
void DeclareUrdf(Fields& fields, RobotFile* file) {
  fields.Text("urdf", &file->urdf_path, {.meaning = "URDF file", .required = true});
  if (!file->urdf && !file->urdf_path.empty()) {
    file->urdf = ReadUrdf((std::filesystem::path(fields.directory()) / file->urdf_path).string());
    file->urdf->source.name = file->urdf_path;
  }
}

void DeclareWaist(Fields& fields, const std::vector<std::string>& links, RobotFile* file) {
  fields.Text(
      "waist_link", &file->waist_link,
      {.meaning = "link whose frame, turned by waist_rpy_deg, is the waist frame: x forward, "
                  "z up when standing",
       .required = true,
       .choices = links});
  fields.Numbers("waist_rpy_deg", &file->waist_rpy, 3,
                 {.meaning = "waist frame in the frame of that link: roll, pitch, yaw about fixed "
                             "axes",
                  .unit = "deg"});
}

}  // namespace

void DeclareFields(Fields& fields, RobotFile* file) {
  fields.Text("name", &file->name, {.meaning = "name of the robot", .required = true});
  if (const std::string mistake = NameMistake(file->name); !mistake.empty()) {
    fields.Complain("name", mistake);
  }
  DeclareUrdf(fields, file);
  const std::vector<std::string> links = LinkNames(*file);
  DeclarePackages(fields, file);
  fields.Text("dae_up_axis", &file->dae_up_axis,
              {.meaning = "whether meshes in DAE are turned by their `up_axis`, as some viewers do",
               .choices = {"ignored", "applied"}});
  DeclareWaist(fields, links, file);
  fields.OptionalNumber("com_height_m", &file->com_height,
                        {.meaning = "height of the CoM while walking; none: that of the model in "
                                    "the standing posture",
                         .unit = "m",
                         .min = 0.01});
  fields.OptionalNumber("lift_m", &file->lift,
                        {.meaning = "how high the swing foot goes at most in half-steps by "
                                    "default; none: what the legs reach",
                         .unit = "m",
                         .min = 0.01});
  fields.Renamed("support_offset_m", "support_point_m");
  fields.Number("support_point_m", &file->support_point,
                {.meaning = "where CoM and ZMP rest on one foot by default: from the support "
                            "sole's centre, along its y, towards the other foot",
                 .unit = "m",
                 .min = -1,
                 .max = 1});
  fields.Group("legs", {.meaning = "the feet", .required = true}, [&](Fields& f) {
    DeclareLeg(f, "left", links, &file->legs[0]);
    DeclareLeg(f, "right", links, &file->legs[1]);
  });
  fields.Numbers("sole_size_m", &file->sole_size, 2,
                 {.meaning = "length and width of the sole rectangle",
                  .unit = "m",
                  .min = 1e-3,
                  .required = true});
  DeclareJoints(fields, file);
  DeclareEfforts(fields, file);
  DeclareAccelerations(fields, file);
  DeclareExcluded(fields, links, file);
  DeclareMeshParts(fields, file);
  fields.Integer("hull_vertices", &file->hull_vertices,
                 {.meaning = "a mesh whose hull has more vertices gets a hull around it, with at "
                             "most that many",
                  .min = kFewestHullVertices,
                  .max = 1e6});
}

}  // namespace halfstep
