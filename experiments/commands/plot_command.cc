#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/plot/canvas.h"
#include "experiments/plot/page_size.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

plot::FileKind KindOf(const fs::path& out) {
  static const std::map<std::string, plot::FileKind> kKinds = {{".pdf", plot::FileKind::kPdf},
                                                               {".svg", plot::FileKind::kSvg},
                                                               {".png", plot::FileKind::kPng}};
  const auto found = kKinds.find(out.extension().string());
  if (found != kKinds.end()) return found->second;
  throw InputError(
      {"OUT: " + Quote(out.string()) + " (valid: a name that ends in .pdf, .svg or .png)"});
}

}  // namespace

ExitStatus Plot(const PlotCommand& command) {
  const fs::path out(command.out);
  const plot::FileKind kind = KindOf(out);
  const plot::Figure figure = plot::FigureOf(command.request, command.tools);
  if (const std::string why = plot::WhyNoPlots(); !why.empty()) {
    std::cerr << "halfstep: plot: " << why << '\n';
    return kFailed;
  }
  if (!command.overwrite && fs::exists(fs::symlink_status(out))) {
    throw std::runtime_error(out.string() + ": is there already (--overwrite replaces it)");
  }
  WriteWhole(out, {plot::Drawn(plot::PlaceFigure(figure, plot::TextWidth), kind)});
  if (!command.quiet) std::cout << "written: " << out.string() << '\n';
  return kSuccess;
}

CommandAction DeclarePlot(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<PlotCommand>();
  command->tools = tools;
  const auto width = std::make_shared<std::string>("3.5in");
  app->add_option(
         "RUN", command->request.folder,
         "folder of a run, a comparison or a sweep; or a table *.csv of `halfstep list half-steps`")
      ->required();
  app->add_option("OUT", command->out, "the file: .pdf, .svg or .png")->required();
  app->add_option("--what", command->request.what,
                  "with commas between, below each other: " + plot::SubjectsHelp() +
                      " (default: the first of these)")
      ->delimiter(',')
      ->allow_extra_args(false);
  app->add_option(
         "--method", command->request.methods,
         "of a run: M, or M,M2 to compare two (default: the shortest certified walk); else "
         "those that are drawn (default: all)")
      ->delimiter(',')
      ->allow_extra_args(false);
  app->add_option("--width", *width, "of the figure, as 3.5in, 8.9cm or 89mm (default: 3.5in)");
  app->add_flag("--overwrite", command->overwrite, "replace OUT");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command, width] {
    command->request.width = plot::PointsOf("--width", *width);
    return Plot(*command);
  };
}

}  // namespace halfstep
