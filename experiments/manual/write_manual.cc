// The build step that writes the manual page and the completion in bash: halfstep_write_manual PAGE
// COMPLETION.

#include <exception>
#include <iostream>
#include <string>

#include "experiments/about/build_info.h"
#include "experiments/commands/command_line.h"
#include "experiments/manual/completion.h"
#include "experiments/manual/manual_page.h"
#include "wpg/files/whole_file.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    CLI::App app;
    const auto commands = halfstep::DeclareProgram(&app, {});
    halfstep::WriteWhole(argv[1], {halfstep::ManualPage(app, std::string(halfstep::kVersion))});
    halfstep::WriteWhole(argv[2], {halfstep::BashCompletion(app, "halfstep")});
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
