#include "experiments/config/replay_config.h"

namespace halfstep {
namespace {

constexpr double kMostOfSpring = 1e6;  // more is stiffer than the contacts with the floor

void DeclareSpring(Fields& fields, const char* key, std::vector<double>* spring,
                   const char* meaning) {
  fields.Numbers(
      key, spring, 0,
      {.meaning = meaning, .unit = "N m/rad, N m s/rad", .min = 0, .max = kMostOfSpring});
  const std::string mistake = MistakeInSpring(*spring);
  if (!mistake.empty()) fields.Complain(key, mistake);
}

}  // namespace

std::string MistakeInSpring(const std::vector<double>& spring) {
  if (spring.empty()) return "";
  const bool good = spring.size() == 2 && spring[0] > 0 && spring[0] <= kMostOfSpring &&
                    spring[1] >= 0 && spring[1] <= kMostOfSpring;
  return good ? ""
              : "is no spring (valid: K,D with K in N m/rad above 0, D in N m s/rad from 0 on, "
                "neither above 1e6)";
}

void DeclareReplay(Fields& fields, ReplayConfig* config) {
  fields.Integer("seeds", &config->seeds,
                 {.meaning = "simulations of each walk; seed k draws the same for every number",
                  .min = 1,
                  .max = kMostSeeds});
  DeclareSpring(fields, "servos", &config->servos,
                "K, D of the joints' servos; []: as the robot's size has them");
  DeclareSpring(fields, "ankle", &config->ankle,
                "K, D of a passive bush above each foot, in pitch and roll; []: none");
  fields.Boolean("torque_limits", &config->torque_limits,
                 {.meaning = "whether servos give no more than the efforts of the robot file"});
  fields.Text("controller", &config->controller,
              {.meaning = "what moves the robot; `none`: the servos get the plan itself",
               .choices = {"none", "dcm"}});
}

}  // namespace halfstep
