#include "experiments/plot/plot.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include "experiments/plot/subjects.h"
#include "experiments/tables/run_record.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep::plot {
namespace {

namespace fs = std::filesystem;

template <typename Subject>
std::vector<std::string> NamesOf(std::span<const Subject> subjects) {
  std::vector<std::string> names;
  for (const Subject& subject : subjects) names.emplace_back(subject.name);
  return names;
}

std::string Letter(size_t i) { return "(" + std::string(1, static_cast<char>('a' + i)) + ")"; }

// The subjects' rows below each other.
template <typename Subject>
std::vector<Row> AllRows(std::span<const Subject> subjects, std::vector<std::string> what,
                         const std::function<std::vector<Row>(const Subject&)>& rows_of) {
  const std::vector<std::string> names = NamesOf(subjects);
  if (what.empty()) what.push_back(names.front());
  for (const std::string& name : what) {
    if (std::ranges::find(names, name) != names.end()) continue;
    throw InputError({"--what: " + Quote(name) + " is unknown" + Suggestion(name, names)});
  }
  std::vector<Row> all;
  for (size_t i = 0; i < what.size(); ++i) {
    const auto subject = std::ranges::find(names, what[i]) - names.begin();
    std::vector<Row> rows = rows_of(subjects[static_cast<size_t>(subject)]);
    std::string& title = rows.front().front().title;
    if (what.size() > 1) title = Letter(i) + (title.empty() ? "" : " ") + title;
    for (Row& row : rows) all.push_back(std::move(row));
  }
  return all;
}

bool IsComparison(const fs::path& folder) {
  return fs::exists(folder / "manifest.json") && fs::exists(folder / "comparison.csv");
}

void CheckMethods(const std::vector<std::string>& methods) {
  if (methods.size() > 2) {
    throw InputError({"--method: " + std::to_string(methods.size()) +
                      " methods (valid: one, or two to be compared)"});
  }
  if (methods.size() == 2 && methods[0] == methods[1]) {
    throw InputError({"--method: " + Quote(methods[0]) + " twice (valid: two methods)"});
  }
}

std::string Title(const PlotRequest& request, const std::string& name) {
  std::string title = name;
  for (const std::string& what : request.what) title += (title == name ? ": " : ", ") + what;
  return title;
}

}  // namespace

Figure FigureOf(const PlotRequest& request, const Toolbox& tools) {
  const fs::path folder(request.folder);
  Figure figure{.title = "", .width = request.width, .rows = {}};
  if (folder.extension() == ".csv") {
    if (!request.what.empty() || !request.methods.empty()) {
      throw InputError({"--what, --method: not of " + request.folder + " (valid: of a folder)"});
    }
    figure.title = folder.stem().string();
    figure.rows = HalfStepsRows(folder);
    return figure;
  }
  if (IsComparison(folder) || IsSweep(folder)) {
    const auto subjects = IsSweep(folder) ? SweepSubjects() : ComparisonSubjects();
    figure.title = Title(request, folder.filename().string());
    figure.rows = AllRows<FolderSubject>(subjects, request.what, [&](const FolderSubject& subject) {
      return subject.rows(folder, request.methods);
    });
    return figure;
  }
  CheckMethods(request.methods);
  // Before the files are read.
  AllRows<RunSubject>(RunSubjects(), request.what,
                      [](const RunSubject&) { return std::vector<Row>{{Panel{}}}; });
  const PlottedRun run = ReadPlottedRun(folder, request.methods, tools);
  figure.title = Title(request, run.name);
  figure.rows = AllRows<RunSubject>(RunSubjects(), request.what,
                                    [&](const RunSubject& subject) { return subject.rows(run); });
  return figure;
}

std::string SubjectsHelp() {
  std::string help;
  const auto add = [&](const auto& subjects, const std::string& of) {
    help += (help.empty() ? "" : "; ") + of;
    bool first = true;
    for (const auto& subject : subjects) {
      help += (first ? " " : ", ") + std::string(subject.name) + " (" + subject.what + ")";
      first = false;
    }
  };
  add(RunSubjects(), "of a run:");
  add(ComparisonSubjects(), "of a comparison:");
  add(SweepSubjects(), "of a sweep:");
  return help;
}

}  // namespace halfstep::plot
