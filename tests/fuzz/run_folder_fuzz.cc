// The files of a run folder, as `compare` and `report` read them.

#include "experiments/report/report_walk.h"
#include "experiments/tables/run_record.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/fuzz.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static fuzz::Folder folder;
  const auto files = fuzz::Files(fuzz::Text(data, size));
  for (const char* name : {"manifest.json", "summary.csv", "footsteps.csv", "raw/certificate.json",
                           "raw/trajectory.csv", "raw/half_steps.csv", "m/iterates.csv"}) {
    folder.Put(name, files);
  }
  const std::string path = folder.path().string();
  RunRecord record;
  if (fuzz::Reads(path, [&] { record = ReadRun(path); })) {
    fuzz::Require(!record.methods.empty() && record.methods.front().raw(), "raw is not the first");
  }
  const auto dump = [](const nlohmann::json& json) {
    (void)json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  };
  fuzz::Reads(path, [&] { dump(RowsJson(folder.path() / "summary.csv")); });
  fuzz::Reads(path, [&] { dump(WalkJson(folder.path() / "raw", 0.02)); });
  return 0;
}
