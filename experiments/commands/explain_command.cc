#include <algorithm>
#include <cctype>
#include <iostream>
#include <memory>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/config/experiment_config.h"
#include "experiments/config/key_tables.h"
#include "experiments/config/scaled_defaults.h"
#include "experiments/live/live_config.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

// Items of lists are N in a description: footsteps.0.x_m is footsteps.N.x_m.
std::string WithoutIndices(const std::string& path) {
  std::string result, part;
  const auto end_part = [&] {
    const bool index = !part.empty() && std::all_of(part.begin(), part.end(), [](unsigned char c) {
      return std::isdigit(c) != 0;
    });
    result += (result.empty() ? "" : ".") + (index ? "N" : part);
    part.clear();
  };
  for (const char c : path) c == '.' ? end_part() : part.push_back(c);
  end_part();
  return result;
}

// The keys whose path ends in `wanted`, each with all that is in it.
void Find(const std::vector<KeyDescription>& keys, const std::string& wanted,
          std::vector<KeyDescription>* found, std::vector<std::string>* paths) {
  for (const KeyDescription& key : keys) {
    paths->push_back(key.path);
    if (key.path == wanted || key.path.ends_with("." + wanted)) {
      found->push_back(key);
    } else {
      Find(key.keys, wanted, found, paths);
    }
  }
}

std::string Lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Whether a text has a word that is in lower case, however the text spells it.
bool Contains(const std::string& text, const std::string& lower) {
  return Lower(text).find(lower) != std::string::npos;
}

// The keys, at any depth and without what is in them, whose path or meaning has the word.
void FindByMeaning(const std::vector<KeyDescription>& keys, const std::string& lower,
                   std::vector<KeyDescription>* found) {
  for (const KeyDescription& key : keys) {
    if (Contains(key.path, lower) || Contains(key.meaning, lower)) {
      found->push_back(key);
      found->back().keys.clear();
    }
    FindByMeaning(key.keys, lower, found);
  }
}

}  // namespace

ExitStatus ExplainConfig(const ExplainCommand& command) {
  std::vector<KeyDescription> keys = ConfigKeys(command.tools);
  // The keys of an episode are searched by name only: a run has no `live`.
  if (!command.key.empty()) keys = EpisodeKeys(command.tools);
  if (!command.robot.empty()) {
    ExperimentConfig config;
    config.robot = command.robot;
    DescribeScaling(MeasureRobot(RobotPath(config).string()), &keys);
  }
  if (!command.key.empty()) {
    std::vector<KeyDescription> found;
    std::vector<std::string> paths;
    Find(keys, WithoutIndices(command.key), &found, &paths);
    if (found.empty() && command.key.size() > 1) FindByMeaning(keys, Lower(command.key), &found);
    if (found.empty()) {
      throw InputError({"explain-config: " + Quote(command.key) + ": no such key (" +
                        DidYouMean(command.key, paths) +
                        "valid: a key, its last part, or a word of what it means; none for "
                        "all)"});
    }
    keys = std::move(found);
  }
  if (command.json_schema || command.markdown) {
    std::cout << (command.json_schema ? KeySchema("halfstep config", keys) : KeyMarkdown(keys));
    return kSuccess;
  }
  const std::string screen = KeyScreen(keys);
  std::cout << screen;
  if (command.robot.empty() && screen.find("ℓ") != std::string::npos) {
    std::cout
        << "\nℓ, w, q̇, lift and aside are measures of the robot: `--robot NAME` shows values.\n";
  }
  return kSuccess;
}

CommandAction DeclareExplain(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<ExplainCommand>();
  command->tools = tools;
  app->add_option("KEY", command->key,
                  "a key, its last part, or a word of what it means (default: all)");
  app->add_option("--robot", command->robot,
                  "name or file of a robot: shows the defaults that go by its size");
  app->add_flag("--json-schema", command->json_schema, "print a JSON schema, for editors");
  app->add_flag("--markdown", command->markdown, "print a Markdown table");
  return [command] { return ExplainConfig(*command); };
}

}  // namespace halfstep
