// A sweep file, what is written back, and its cases.

#include "experiments/sweep/sweep_config.h"
#include "tests/fuzz/fuzz.h"
#include "tests/places.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string path = InSources("experiments/sweeps/fuzz.yaml");
  SweepConfig sweep;
  const std::string text = fuzz::Text(data, size);
  if (!fuzz::Reads(path, [&] { sweep = ParseSweep(path, text, {}, /*check=*/false); })) return 0;
  const std::string written = fuzz::Written(sweep);
  fuzz::Require(fuzz::Written(ParseSweep(path, written, {}, false)) == written,
                "written and read differs", written);
  size_t values = 1;
  for (const SweepAxis& axis : sweep.vary) values *= axis.values.size();
  if (values <= 100) fuzz::Require(SweepCases(sweep).size() <= values, "too many cases", written);
  return 0;
}
