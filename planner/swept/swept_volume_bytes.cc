#include "planner/swept/swept_volume_bytes.h"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace halfstep {
namespace {

constexpr uint32_t kNone = 0xffffffff;
constexpr double kFarthestCorner =
    1000.0;  // of a volume from its support sole [m]; far beyond any robot

// Nor NaN.
bool IsNear(const Eigen::Vector3d& p) { return (p.array().abs() <= kFarthestCorner).all(); }

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <typename T>
  bool Take(T* values, size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > rest_.size() / sizeof(T)) return false;
    if (count > 0) std::memcpy(values, rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
    return true;
  }
  bool Holds(size_t bytes) const { return bytes <= rest_.size(); }
  bool AtEnd() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

bool TakeVolume(Reader* reader, double cell, std::optional<BoxTree>* volume) {
  uint32_t nodes = 0, parts = 0;
  if (!reader->Take(&nodes, 1)) return false;
  volume->reset();
  if (nodes == kNone) return true;
  BoxTree tree;
  tree.cell = cell;
  if (!reader->Take(&parts, 1) || !reader->Take(tree.origin.data(), 3)) return false;
  if (!reader->Holds(size_t{parts} * sizeof(double) * 3)) return false;
  tree.parts.resize(parts);
  for (Eigen::Vector3d& part : tree.parts) {
    if (!reader->Take(part.data(), 3) || !IsNear(part)) return false;
  }
  if (!reader->Holds(size_t{nodes} * sizeof(BoxNode))) return false;
  tree.nodes.resize(nodes);
  if (!reader->Take(tree.nodes.data(), nodes)) return false;
  if (!IsNear(tree.origin) || !tree.IsSound()) return false;
  *volume = std::move(tree);
  return true;
}

template <typename T>
void AppendBytes(const T* values, size_t count, std::string* bytes) {
  if (count > 0) bytes->append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

}  // namespace

std::string VolumeBytes(const std::optional<BoxTree>& volume) {
  std::string bytes;
  const uint32_t nodes = volume ? static_cast<uint32_t>(volume->nodes.size()) : kNone;
  AppendBytes(&nodes, 1, &bytes);
  if (!volume) return bytes;
  const uint32_t parts = static_cast<uint32_t>(volume->parts.size());
  AppendBytes(&parts, 1, &bytes);
  AppendBytes(volume->origin.data(), 3, &bytes);
  for (const Eigen::Vector3d& part : volume->parts) AppendBytes(part.data(), 3, &bytes);
  AppendBytes(volume->nodes.data(), volume->nodes.size(), &bytes);
  return bytes;
}

std::optional<std::vector<std::optional<BoxTree>>> ParseVolumes(std::string_view bytes,
                                                                size_t count, double cell) {
  Reader reader(bytes);
  std::vector<std::optional<BoxTree>> volumes(count);
  for (std::optional<BoxTree>& volume : volumes) {
    if (!TakeVolume(&reader, cell, &volume)) return std::nullopt;
  }
  if (!reader.AtEnd()) return std::nullopt;
  return volumes;
}

}  // namespace halfstep
