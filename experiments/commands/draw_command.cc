#include <cstdint>
#include <iostream>
#include <memory>

#include "experiments/commands/command_line.h"
#include "experiments/config/random_scenes.h"
#include "experiments/run/exit_status.h"

namespace halfstep {

CommandAction DeclareDraw(CLI::App* app) {
  struct Options {
    std::string what;
    int count = 40, seed = 1;
  };
  const auto options = std::make_shared<Options>();
  app->add_option("WHAT", options->what, "cylinders or random_room")
      ->required()
      ->check(CLI::IsMember(RandomSceneNames()));
  app->add_option("--count", options->count, "obstacles (default: 40)")
      ->check(CLI::Range(0, 100000));
  app->add_option("--seed", options->seed, "of the draw (default: 1)")
      ->check(CLI::Range(0, 2147483647));
  return [options] {
    std::cout << DrawScene(options->what, options->count,
                           static_cast<std::uint64_t>(options->seed));
    return kSuccess;
  };
}

}  // namespace halfstep
