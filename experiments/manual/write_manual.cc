// The build step that writes the manual page and completions: halfstep_write_manual PAGE BASH ZSH
// FISH.

#include <exception>
#include <iostream>
#include <string>

#include "experiments/about/build_info.h"
#include "experiments/commands/command_line.h"
#include "experiments/manual/completion.h"
#include "experiments/manual/manual_page.h"
#include "wpg/files/whole_file.h"

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  try {
    CLI::App app;
    const auto commands = halfstep::DeclareProgram(&app, {});
    halfstep::WriteWhole(argv[1], {halfstep::ManualPage(app, std::string(halfstep::kVersion))});
    halfstep::WriteWhole(argv[2], {halfstep::BashCompletion(app, "halfstep")});
    halfstep::WriteWhole(argv[3], {halfstep::ZshCompletion(app, "halfstep")});
    halfstep::WriteWhole(argv[4], {halfstep::FishCompletion(app, "halfstep")});
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
