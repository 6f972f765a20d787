#include "tests/verify/verify_study.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <sstream>

#include "experiments/verify/certificate_text.h"
#include "tests/verify/what_is_claimed.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Table = TamperedRun::Table;
using StudyList = std::vector<StudyMutation>;

constexpr char kNotClaimed[] = "no statement is about it";
constexpr char kWeaker[] = "the claim that is left is weaker, and follows from the true one";

bool IsNumber(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

// Another value of the same type.
std::string Other(const std::string& value, double change) {
  if (value == "true") return "false";
  if (value == "false") return "true";
  if (value == "left") return "right";
  if (value == "right") return "left";
  if (value == "up") return "down";
  if (value == "down") return "up";
  if (value.empty()) return "1";
  if (value == "inf") return "0.5";
  if (!IsNumber(value)) return value + "x";
  if (value.find_first_of(".e") == std::string::npos)
    return std::to_string(std::stol(value) + (change < 0 ? -1 : 1));
  return ShortestText(std::stod(value) + change);
}

// One cell of one column of a table, in a row that `random` draws, from `first` on.
void EveryColumn(const std::string& kind, const std::string& file, int rows,
                 const std::set<std::string>& harmless, const char* why, StudyList* list,
                 size_t first = 1) {
  const TamperedRun run;
  const Table table = TamperedRun::Cells(ReadText(run.run() / file));
  std::mt19937 random(7);
  for (size_t column = 0; column < table.front().size(); ++column) {
    const std::string& name = table.front()[column];
    for (int k = 0; k < rows; ++k) {
      const size_t row = first + random() % (table.size() - first);
      const double change = k % 2 == 0 ? 1e-3 : -1e-3;
      list->push_back({kind, file + ":" + std::to_string(row + 1) + " " + name,
                       [=](TamperedRun& to) {
                         to.EditCsv(to.run() / file, [=](Table& cells) {
                           std::string& cell = cells[row][column];
                           cell = Other(cell, change);
                         });
                       },
                       harmless.contains(name) ? why : ""});
    }
  }
}

// Whether a row of certificate.csv says no more than it did.
void EveryClaim(StudyList* list) {
  struct Edit {
    const char* name;
    size_t column;
    std::function<std::string(const std::string&)> by;
    const char* harmless;
  };
  const auto add = [](double change) {
    return [=](const std::string& cell) { return Other(cell, change); };
  };
  const std::vector<Edit> edits = {
      {"begin later", 0, add(1e-4), ""},
      {"end later", 1, add(1e-4), ""},
      {"another family", 2,
       [](const std::string& cell) { return std::string(cell == "zmp" ? "reach" : "zmp"); }, ""},
      {"one statement more", 3, add(0), ""},
      {"subject unknown", 4, add(0), ""},
      {"margin raised", 5, add(0.01), ""},
      {"margin lowered", 5, add(-1e-6), kWeaker},
      {"bound raised", 6, add(1e-9), kWeaker},
      {"bound zero", 6, [](const std::string&) { return std::string("0"); },
       "true at the instants that verify looks at: the walk hardly moves there"},
      {"bound negative", 6, [](const std::string&) { return std::string("-1"); }, ""},
      {"demanded lowered", 7, add(-1e-3), ""},
  };
  const TamperedRun run;
  const Table table = TamperedRun::Cells(ReadText(run.certificate()));
  std::mt19937 random(11);
  for (const char* family : verify::kFamilyNames) {
    std::vector<size_t> rows;
    for (size_t i = 1; i < table.size(); ++i) {
      if (table[i][2] == family) rows.push_back(i);
    }
    if (rows.empty()) continue;
    for (const Edit& edit : edits) {
      const size_t row = rows[random() % rows.size()];
      list->push_back({"certificate.csv", std::string(family) + ": " + edit.name,
                       [=](TamperedRun& to) {
                         to.EditCertificate([=](Table& cells) {
                           cells[row][edit.column] = edit.by(cells[row][edit.column]);
                         });
                       },
                       edit.harmless});
    }
  }
}

// Every member of a JSON document that is no object or list, changed.
void EveryMember(const std::string& kind, const std::string& file,
                 const std::function<const char*(const std::string&)>& harmless, StudyList* list) {
  const TamperedRun run;
  const Json flat = Json::parse(ReadText(run.run() / file)).flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (pointer.find("sha256") != std::string::npos) continue;  // recomputed
    if (pointer.starts_with("/files/") || pointer.starts_with("/inputs/")) continue;
    list->push_back({kind, file + " " + pointer,
                     [=, pointer = pointer](TamperedRun& to) {
                       const fs::path path = to.run() / file;
                       Json document = Json::parse(ReadText(path));
                       Json& member = document[Json::json_pointer(pointer)];
                       if (member.is_number_integer()) {
                         member = member.get<long>() + 1;
                       } else if (member.is_number()) {
                         member = member.get<double>() - 1e-3;
                       } else if (member.is_string()) {
                         member = Other(member.get<std::string>(), 0);
                       } else {
                         member = 0.5;
                       }
                       WriteText(path, document.dump(2) + "\n");
                     },
                     harmless(pointer)});
  }
}

// Lines "key: value" of config.yaml: another value, and a misspelt key.
void EveryKey(StudyList* list) {
  const TamperedRun run;
  const std::string text = ReadText(run.run() / "config.yaml");
  std::istringstream lines(text);
  std::string line;
  std::vector<std::string> groups;
  // What the smoothing was told, which no statement is about.
  const std::set<std::string> free_groups = {"planner", "step_set", "swept_volumes", "output",
                                             "goal"};
  const std::set<std::string> claimed = {"margins", "limits"};
  for (size_t number = 0; std::getline(lines, line); ++number) {
    const size_t indent = std::min(line.find_first_not_of(" -"), line.size());
    const size_t colon = line.find(':', indent);
    if (colon == std::string::npos) continue;
    groups.resize(std::min(groups.size(), indent / 2));
    groups.push_back(line.substr(indent, colon - indent));
    const std::string top = groups.front(), key = groups.back();
    const std::string second = groups.size() > 1 ? groups[1] : "";
    std::string path;
    for (const std::string& group : groups) path += (path.empty() ? "" : ".") + group;
    const auto replace = [=](const std::string& by) {
      return [=](TamperedRun& to) {
        std::istringstream in(ReadText(to.run() / "config.yaml"));
        std::string all, one;
        for (size_t i = 0; std::getline(in, one); ++i) all += (i == number ? by : one) + "\n";
        WriteText(to.run() / "config.yaml", all);
      };
    };
    std::string misspelt = line;
    misspelt.insert(colon, "x");
    // Weights of costs that a program added have names of its own, which verify says.
    const bool own = path.starts_with("smoothing.optimizer.weights.");
    list->push_back({"config.yaml: misspelt", path, replace(misspelt), own ? kHow : ""});
    const std::string value = colon + 2 <= line.size() ? line.substr(colon + 2) : "";
    if (value.empty() || value.front() == '[') continue;
    std::string harmless;
    if (free_groups.contains(top) && key != "period_s") harmless = kHow;
    if (top == "smoothing" && !claimed.contains(second) && key != "program") harmless = kHow;
    // Where a search begins: half_steps.csv says where each step's support point is.
    if (path == "half_step.support_point_m") harmless = kHow;
    for (const double change : {1e-3, -1e-3}) {
      std::string why = harmless;
      const bool looser = second == "margins" ? change < 0 : change > 0;
      if (top == "smoothing" && claimed.contains(second) && looser) {
        why = "the certificate demands more than the config does";
      }
      list->push_back({"config.yaml: another value", path + (change > 0 ? " +" : " -"),
                       replace(line.substr(0, colon + 2) + Other(value, change)), why});
      if (!IsNumber(value)) break;
    }
  }
}

void EveryFile(StudyList* list) {
  const TamperedRun run;
  for (const std::string& name : FilesBelow(run.run())) {
    if (name == "manifest.json") continue;
    const bool described = name.ends_with(".schema.json") || name == "report.html";
    list->push_back({"file removed", name, [=](TamperedRun& to) { fs::remove(to.run() / name); },
                     name.starts_with("raw/") ? "verify is asked about the other method" : ""});
    list->push_back({"file removed and no longer listed", name,
                     [=](TamperedRun& to) {
                       fs::remove(to.run() / name);
                       to.EditManifest([&](Json& manifest) { manifest["files"].erase(name); });
                     },
                     name.starts_with("raw/") ? "verify is asked about the other method"
                     : described              ? kNotClaimed
                                              : ""});
    list->push_back({"file no longer listed", name,
                     [=](TamperedRun& to) {
                       to.EditManifest([&](Json& manifest) { manifest["files"].erase(name); });
                     },
                     name.starts_with("raw/")      ? "verify is asked about the other method"
                     : name.starts_with("inputs/") ? "its hash stands beside robot and scene"
                     : described                   ? "told as not listed; no statement is about it"
                                                   : ""});
    if (described) {
      list->push_back(
          {"description changed", name,
           [=](TamperedRun& to) { WriteText(to.run() / name, ReadText(to.run() / name) + "\n"); },
           kNotClaimed});
    }
  }
}

void Swap(const fs::path& a, const fs::path& b) {
  const fs::path aside = a.string() + ".aside";
  fs::rename(a, aside);
  fs::rename(b, a);
  fs::rename(aside, b);
}

void Swaps(StudyList* list) {
  const TamperedRun run;
  for (const std::string& name : FilesBelow(run.run() / "raw")) {
    if (name.ends_with(".schema.json")) continue;
    list->push_back({"file of raw in its place", name, [=](TamperedRun& to) {
                       Swap(to.run() / "raw" / name, to.run() / "dichotomy" / name);
                     }});
  }
  list->push_back({"folder of raw in its place", "as it is",
                   [](TamperedRun& to) { Swap(to.run() / "raw", to.run() / "dichotomy"); }});
  list->push_back({"folder of raw in its place", "with overlaps of its own", [](TamperedRun& to) {
                     for (const char* name : {"overlaps.csv", "iterates.csv"}) {
                       fs::copy(to.run() / "dichotomy" / name, to.run() / "raw" / name);
                     }
                     Swap(to.run() / "raw", to.run() / "dichotomy");
                   }});
  // The same walk in other rows, and another walk.
  const std::vector<TamperedWalk> others = {{.overrides = {"output.period_s=0.01"}},
                                            {.overrides = {"smoothing.margins.clearance_m=0.002"}},
                                            {.overrides = {"footsteps.0.x_m=0.276"}}};
  for (size_t k = 0; k < others.size(); ++k) {
    const TamperedRun other(others[k]);
    for (const std::string& name : FilesBelow(other.run())) {
      if (name.starts_with("raw/") || name.ends_with(".schema.json")) continue;
      const std::string bytes = ReadText(other.run() / name);
      if (bytes == ReadText(run.run() / name)) continue;
      const bool how = name.ends_with("iterates.csv") || name == "report.html";
      const std::string why = how ? kHow : SaysTheSame(name, bytes, ReadText(run.run() / name));
      list->push_back({"file of another run", others[k].overrides.front() + " " + name,
                       [=](TamperedRun& to) { WriteText(to.run() / name, bytes); }, why});
    }
  }
}

// The forgeries that were accepted once.
void Forgeries(StudyList* list) {
  const auto forge = [list](const std::string& name, std::function<void(TamperedRun&)> by,
                            const char* harmless = "") {
    list->push_back({"forged whole", name, std::move(by), harmless});
  };
  const auto demand_no_clearance = [](TamperedRun& to) {
    to.EditJson([](Json& json) { json["demanded"]["clearance"] = 0.0; });
    to.EditCertificate([](Table& table) {
      for (auto& row : table) {
        if (row[2] == "clearance") row[7] = "0";
      }
    });
  };
  forge("the certificate names no scene",
        [](TamperedRun& to) { to.EditJson([](Json& json) { json["scene"] = "none"; }); });
  forge(
      "the certificate names another scene",
      [](TamperedRun& to) {
        fs::copy(to.scene(), to.scene().parent_path() / "other.yaml");
        to.EditJson([](Json& json) { json["scene"] = "inputs/scene/other.yaml"; });
      },
      "its hash says which it is");
  forge("the config names another scene", [](TamperedRun& to) {
    fs::copy(to.scene(), to.scene().parent_path() / "other.yaml");
    TamperedRun::Replace(to.run() / "config.yaml", "scene/box.yaml", "scene/other.yaml");
  });
  forge("overlaps.csv is nonsense",
        [](TamperedRun& to) { WriteText(to.run() / "dichotomy/overlaps.csv", "nonsense\n"); });
  forge("smoothing misspelt, no clearance demanded", [=](TamperedRun& to) {
    demand_no_clearance(to);
    TamperedRun::Replace(to.run() / "config.yaml", "\nsmoothing:", "\nsmothing:");
  });
  forge("no clearance demanded", demand_no_clearance);
  forge("no clearance demanded, nor by a config without the key", [=](TamperedRun& to) {
    demand_no_clearance(to);
    TamperedRun::Replace(to.run() / "config.yaml", "    clearance_m: 0.005\n", "");
  });
  forge("the walk of another height", [](TamperedRun& to) {
    to.EditCsv(to.run() / "dichotomy/half_steps.csv",
               [](Table& table) { table[1][5] = table[2][5] = "0.9"; });
    to.EditCsv(to.run() / "dichotomy/overlaps.csv",
               [](Table& table) { table[1][11] = table[1][12] = "0.9"; });
  });
  forge("a shorter overlap everywhere but in the trajectory", [](TamperedRun& to) {
    to.EditCsv(to.run() / "dichotomy/overlaps.csv", [](Table& table) { table[1][2] = "0.5"; });
    to.EditCsv(to.run() / "dichotomy/half_steps.csv", [](Table& table) { table[2][3] = "1.5"; });
  });
  forge("the footstep elsewhere in config and footsteps.csv", [](TamperedRun& to) {
    TamperedRun::Replace(to.run() / "config.yaml", "x_m: 0.274", "x_m: 0.275");
    to.EditCsv(to.run() / "footsteps.csv", [](Table& table) { table[3][2] = "0.275"; });
  });
}

}  // namespace

std::vector<StudyMutation> StudyMutations() {
  StudyList list;
  EveryColumn("trajectory.csv", "dichotomy/trajectory.csv", 3, {}, "", &list);
  EveryClaim(&list);
  EveryMember("certificate.json", "dichotomy/certificate.json", HarmlessInCertificate, &list);
  EveryColumn("half_steps.csv", "dichotomy/half_steps.csv", 2, {}, "", &list);
  EveryColumn("overlaps.csv", "dichotomy/overlaps.csv", 2, kFreeOfOverlaps, kHow, &list);
  EveryColumn("footsteps.csv", "footsteps.csv", 3, {}, "", &list);
  EveryColumn("summary.csv", "summary.csv", 2, kFreeOfSummary, kNotClaimed, &list, /*first=*/2);
  EveryColumn("iterates.csv", "dichotomy/iterates.csv", 1,
              {"iteration", "wall_s", "instants", "effort", "candidate_duration_s",
               "candidate_worst_margin", "accepted", "lambda", "incumbent_duration_s",
               "incumbent_worst_margin"},
              kHow, &list);
  EveryMember("manifest.json", "manifest.json", HarmlessInManifest, &list);
  EveryKey(&list);
  EveryFile(&list);
  Swaps(&list);
  Forgeries(&list);
  return list;
}

}  // namespace halfstep
