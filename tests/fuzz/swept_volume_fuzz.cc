// Two swept volumes, as a cache file holds them, and the file around them.

#include "planner/swept/swept_volume_bytes.h"
#include "tests/fuzz/fuzz.h"
#include "wpg/files/checked_file.h"
#include "wpg/files/sha256.h"

using namespace halfstep;

namespace {

// A file is refused with a sentence, or read; here with a checksum that fits.
void FuzzFile(const std::string& bytes) {
  std::string digest;
  const std::string hex = Sha256(bytes);
  for (size_t i = 0; i < hex.size(); i += 2) {
    digest += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  for (const std::string& all : {bytes, bytes + digest}) {
    const CheckedFile file = ParseCheckedFile("fuzz.swept", all, "header\n");
    fuzz::Require(file.body.has_value() != file.refused.starts_with("fuzz.swept: refused: "),
                  "a file neither read nor refused");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes = fuzz::Text(data, size);
  FuzzFile(bytes);
  const auto volumes = ParseVolumes(bytes, 2, 0.01);
  if (!volumes) return 0;
  fuzz::Require(VolumeBytes((*volumes)[0]) + VolumeBytes((*volumes)[1]) == bytes, "bytes differ");
  for (const auto& volume : *volumes) {
    if (!volume) continue;
    for (const BoxTree::CellBox& box : volume->SolidBoxes()) {
      const Eigen::Vector3d middle = 0.5 * (volume->Corner(box.lower) + volume->Corner(box.upper));
      fuzz::Require(volume->Contains(middle), "a box is not in its volume");
    }
    fuzz::Require(volume->Volume() >= 0, "a negative volume");
  }
  return 0;
}
