// A config, and whether what is written back says the same.

#include "experiments/config/experiment_config.h"
#include "tests/fuzz/fuzz.h"
#include "tests/places.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string path = InSources("experiments/configs/fuzz.yaml");
  ExperimentConfig config;
  if (!fuzz::Reads(path, [&] { config = ParseConfig(path, fuzz::Text(data, size), {}); })) return 0;
  const std::string written = fuzz::Written(config);
  fuzz::Require(fuzz::Written(ParseConfig(path, written, {})) == written,
                "written and read differs", written);
  return 0;
}
