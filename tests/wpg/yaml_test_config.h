#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "wpg/files/input_error.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep::yaml_test {

struct Step {
  double x = 0.0;
  std::string side = "left";
};

// One key of every kind.
struct Config {
  double clearance = 0.02;
  double lean = 0.1;
  std::optional<double> deadline;
  int seed = 1;
  bool certify = true;
  std::string name = "walk";
  std::string side = "left";
  std::vector<std::string> methods{"dichotomy"};
  std::vector<double> xyz{0.0, 0.0, 0.0};
  Eigen::Matrix2Xd polygon = Eigen::Matrix2Xd::Zero(2, 0);
  bool has_goal = false;
  double goal_x = 0.0;
  std::vector<Step> steps;
};

inline void DeclareFields(Fields& fields, Config* config) {
  fields.Group("margins", {}, [config](Fields& margins) {
    margins.Number("clearance_m", &config->clearance, {.unit = "m", .min = 0.0, .max = 0.5});
    margins.Number("lean_deg", &config->lean, {.unit = "deg", .min = -180.0, .max = 180.0});
  });
  fields.OptionalNumber("deadline_s", &config->deadline, {.unit = "s", .min = 0.0});
  fields.Integer("seed", &config->seed, {.min = 0});
  fields.Boolean("certify", &config->certify, {});
  fields.Text("name", &config->name, {});
  fields.Text("side", &config->side, {.choices = {"left", "right"}});
  fields.Texts("methods", &config->methods, {.choices = {"dichotomy", "ipopt", "nlopt"}});
  fields.Numbers("xyz", &config->xyz, 3, {.unit = "m"});
  fields.Points("polygon", &config->polygon, {.max_items = 4}, {.unit = "m"});
  fields.OptionalGroup("goal", &config->has_goal, {}, [config](Fields& goal) {
    goal.Number("x_m", &config->goal_x, {.unit = "m", .required = true});
  });
  fields.List("steps", {.max_items = 3}, &config->steps, [](Fields& item, Step* step) {
    item.Number("x_m", &step->x, {.unit = "m", .required = true});
    item.Text("side", &step->side, {.choices = {"left", "right"}});
    if (step->x > 1.0) item.Complain("x_m", "a step of more than 1 m");
  });
}

inline Config Read(const std::string& text, const std::vector<YamlOverride>& overrides = {}) {
  Config config;
  ReadYamlText(text, "c.yaml", "", overrides,
               [&config](Fields& fields) { DeclareFields(fields, &config); });
  return config;
}

inline std::vector<std::string> ComplaintsAbout(const std::string& text,
                                                const std::vector<YamlOverride>& overrides = {}) {
  try {
    Read(text, overrides);
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

inline std::string Write(Config* config) {
  return WriteYaml([config](Fields& fields) { DeclareFields(fields, config); });
}

}  // namespace halfstep::yaml_test
