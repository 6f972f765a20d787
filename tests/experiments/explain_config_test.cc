// What explain-config prints is what the reader reads.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/commands/commands.h"
#include "experiments/config/data_folder.h"
#include "experiments/config/experiment_config.h"
#include "experiments/config/key_tables.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/schema_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "wpg/files/yaml_node.h"

namespace halfstep {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path kSource = InSources();

YamlNode Parsed(const std::string& text) {
  YamlComplaints complaints("");
  const YamlNode node = ParseYaml(text, "", &complaints);
  complaints.ThrowIfAny();
  return node;
}

// Every value of a tree by its path, items of a list of maps as N.
void Collect(const YamlNode& node, const std::string& path,
             std::map<std::string, const YamlNode*>* values) {
  for (const YamlNode& item : node.items) {
    const bool in_list = node.kind == YamlNode::Kind::kList;
    const std::string below = in_list ? path + ".N" : KeyPath(path, item.key);
    if (!in_list) (*values)[below] = &item;
    Collect(item, below, values);
  }
}

void Collect(const std::vector<KeyDescription>& keys,
             std::map<std::string, const KeyDescription*>* all) {
  for (const KeyDescription& key : keys) {
    (*all)[key.path] = &key;
    Collect(key.keys, all);
  }
}

bool SameValue(const YamlNode& a, const YamlNode& b) {
  if (a.text != b.text || a.items.size() != b.items.size()) return false;
  for (size_t i = 0; i < a.items.size(); ++i) {
    if (!SameValue(a.items[i], b.items[i])) return false;
  }
  return true;
}

TEST(ExplainConfig, DefaultsAndKeysAreThoseOfAResolvedConfig) {
  const TemporaryFolder place;
  ExperimentConfig config = LoadConfig(
      WriteText(place / "short.yaml",
                "{robot: hrp2, scene: none, footsteps: [{foot: right, x_m: 0.2, y_m: -0.1}],\n"
                " start: {left: {x_m: 0, y_m: 0.1}, right: {x_m: 0, y_m: -0.1}},\n"
                " smoothing: {fixed: [{parameter: height_scale}]}}"),
      {});
  // So that their keys are written.
  config.has_goal = config.smoothing.has_given = config.has_replay = true;
  config.smoothing.has_tube = true;
  // So that these keys are, which are left out at their defaults.
  const std::set<std::string> left_out = {"smoothing.margins.joint_acceleration_rad_s2",
                                          "smoothing.margins.double_support_s",
                                          "smoothing.margins.landing_speed_m_s",
                                          "smoothing.limits.landing_speed_m_s",
                                          "smoothing.limits.joint_acceleration_rad_s2",
                                          "smoothing.margins.foothold_m",
                                          "half_step.rise_begin",
                                          "half_step.rise_end",
                                          "half_step.crouch_m",
                                          "goal.level",
                                          "planner.cost",
                                          "planner.free_by",
                                          "planner.moving",
                                          "footsteps.N.rest_s",
                                          "footsteps.N.rest_on_one_foot_s",
                                          "footsteps.N.crouch_m",
                                          "footsteps.N.z_m",
                                          "start.left.z_m",
                                          "start.right.z_m"};
  for (LevelChoice* on : {&config.start_left_on, &config.start_right_on, &config.footsteps[0].on}) {
    *on = {"floor", 0.0};
  }
  config.goal.level = "floor";
  config.planner.cost = "steps";
  config.planner.free_by = "certificates";
  config.planner.moving = "everywhere";
  config.footsteps[0].rest = config.footsteps[0].rest_on_one_foot = 1.0;
  config.footsteps[0].crouch = 0.02;
  config.half_step.rise_begin = 0.5;
  config.half_step.rise_end = 0.9;
  config.half_step.crouch = 0.01;
  MarginLimits& limits = config.smoothing.limits;
  for (const MarginFamily family : {MarginFamily::kJointAcceleration, MarginFamily::kDoubleSupport,
                                    MarginFamily::kLandingSpeed, MarginFamily::kFoothold}) {
    limits.demanded_of(family) = 1.0;
  }
  config.smoothing.assumed_acceleration = limits.landing_speed = 1.0;
  const YamlNode resolved =
      Parsed(WriteYaml([&config](Fields& fields) { DeclareFields(fields, &config); }));
  std::map<std::string, const YamlNode*> values;
  Collect(resolved, "", &values);
  const std::vector<KeyDescription> described = ConfigKeys();
  std::map<std::string, const KeyDescription*> keys;
  Collect(described, &keys);
  // Its footsteps become `footsteps`.
  EXPECT_EQ(
      std::erase_if(keys, [](const auto& k) { return k.first.starts_with("footsteps_file"); }), 3u);
  EXPECT_EQ(values.size(), keys.size());
  EXPECT_GT(keys.size(), 100u);
  int defaults = 0;
  for (const auto& [path, key] : keys) {
    SCOPED_TRACE(path);
    ASSERT_TRUE(values.contains(path));
    EXPECT_NE(key->meaning, "");
    if (key->default_text.empty() || !key->otherwise.empty() || path == "footsteps" ||
        path == "smoothing.fixed" || left_out.contains(path)) {
      continue;
    }
    ++defaults;
    EXPECT_TRUE(SameValue(*values[path], Parsed(key->default_text))) << key->default_text;
  }
  EXPECT_GT(defaults, 70);
}

TEST(ExplainConfig, SchemaAcceptsEveryShippedConfigAsWrittenAndAsResolved) {
  const json schema = json::parse(KeySchema("halfstep config", ConfigKeys()));
  for (const fs::path& path : YamlFiles(kSource / "experiments/configs")) {
    SCOPED_TRACE(path);
    EXPECT_EQ(SchemaComplaint(schema, JsonOfYaml(Parsed(ReadText(path)))), "");
    ExperimentConfig config = LoadConfig(path.string(), {});
    const std::string resolved =
        WriteYaml([&config](Fields& fields) { DeclareFields(fields, &config); });
    EXPECT_EQ(SchemaComplaint(schema, JsonOfYaml(Parsed(resolved))), "");
  }
}

TEST(ExplainConfig, SchemaRefusesWhatTheReaderRefuses) {
  const json schema = json::parse(KeySchema("halfstep config", ConfigKeys()));
  const auto complaint = [&](const std::string& fixture) {
    const fs::path path = kSource / "tests/fixtures/config" / (fixture + ".yaml");
    return SchemaComplaint(schema, JsonOfYaml(Parsed(ReadText(path))));
  };
  EXPECT_EQ(complaint("margin_negative"), "/smoothing/margins/clearance_m: minimum");
  EXPECT_EQ(complaint("misspelt_key"), "/footstep: additionalProperties");
  EXPECT_EQ(complaint("method_unknown"), "/smoothing/methods/0: enum");
  EXPECT_EQ(complaint("robot_missing"), ": required robot");
  EXPECT_EQ(complaint("smoothing_as_list"), "/smoothing: type");
  EXPECT_EQ(complaint("limits_none_where_needed"), "/smoothing/limits/foot_yaw_rate_rad_s: anyOf");
}

TEST(ExplainConfig, FindsAKeyByItsPathOrItsEnd) {
  const TemporaryFolder place;
  const auto explained = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {"explain-config"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return Halfstep(place.path(), words);
  };
  EXPECT_EQ(explained({"clearance_m"}).out,
            "smoothing.margins.clearance_m: number [m], default 0.005, valid: 0 … 0.5\n"
            "    robot to obstacles\n");
  EXPECT_THAT(explained({"footsteps.3.foot"}).out,
              HasSubstr("footsteps.N.foot: text, required, valid: left, right\n"));
  EXPECT_THAT(explained({"smoothing.dichotomy"}).out,
              HasSubstr("smoothing.dichotomy.passes: integer, default 1, valid: 1 … 100\n"));
  // A word that ends no key is looked for in what keys mean.
  EXPECT_THAT(explained({"via point"}).out, HasSubstr("half_step.via_height_m: number [m]"));
  EXPECT_THAT(explained({"Swing"}).out, HasSubstr("smoothing.limits.foot_speed_m_s: number"));
  const Outcome unknown = explained({"smothing.margins"});
  EXPECT_EQ(unknown.status, kBadInput);
  EXPECT_THAT(unknown.err, HasSubstr("'smothing.margins': no such key (did you mean "
                                     "'smoothing.margins'?"));
  EXPECT_EQ(explained({"--markdown"}).out, KeyMarkdown(ConfigKeys()));
  EXPECT_EQ(explained({"--json-schema"}).out, KeySchema("halfstep config", ConfigKeys()));
}

}  // namespace
}  // namespace halfstep
