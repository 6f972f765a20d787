// YAML read through a declaration with a key of every kind, with overrides, and written back.

#include "tests/fuzz/fuzz.h"
#include "tests/wpg/yaml_test_config.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto [text, sets] = fuzz::Halves(fuzz::Text(data, size));
  std::vector<YamlOverride> overrides;  // "key=value" by line
  for (size_t begin = 0; begin < sets.size() && overrides.size() < 3;) {
    const size_t end = std::min(sets.find('\n', begin), sets.size());
    const std::string line = sets.substr(begin, end - begin);
    const size_t equals = std::min(line.find('='), line.size());
    overrides.push_back({line.substr(0, equals), line.substr(std::min(equals + 1, line.size()))});
    begin = end + 1;
  }
  yaml_test::Config config;
  const bool read =
      fuzz::Reads("", [&, &text = text] { config = yaml_test::Read(text, overrides); });
  if (!read) return 0;
  const std::string written = yaml_test::Write(&config);
  yaml_test::Config again = yaml_test::Read(written);
  fuzz::Require(yaml_test::Write(&again) == written, "written and read differs", written);
  return 0;
}
