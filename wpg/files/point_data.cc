#include "wpg/files/point_data.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

template <typename T>
double As(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double ReadScalar(const char* bytes, PointScalar scalar, bool big_endian) {
  std::array<char, 8> own{};
  std::copy(bytes, bytes + scalar.bytes, own.begin());
  if (big_endian) std::reverse(own.begin(), own.begin() + static_cast<long>(scalar.bytes));
  const char* at = own.data();
  switch (scalar.kind) {
    case 'F':
      return scalar.bytes == 4 ? As<float>(at) : As<double>(at);
    case 'I':
      return scalar.bytes == 1   ? As<std::int8_t>(at)
             : scalar.bytes == 2 ? As<std::int16_t>(at)
             : scalar.bytes == 4 ? As<std::int32_t>(at)
                                 : As<std::int64_t>(at);
    default:
      return scalar.bytes == 1   ? As<std::uint8_t>(at)
             : scalar.bytes == 2 ? As<std::uint16_t>(at)
             : scalar.bytes == 4 ? As<std::uint32_t>(at)
                                 : As<std::uint64_t>(at);
  }
}

}  // namespace

// A whole number of a header, 0 … most.
long PointCount(const MeshText& text, const MeshWord& word, long most) {
  long value = 0;
  const char* end = word.text.data() + word.text.size();
  const auto [at, error] = std::from_chars(word.text.data(), end, value);
  if (word.text.empty() || error != std::errc() || at != end || value < 0 || value > most) {
    text.Fail(word, (word.text.empty() ? "a number is missing" : Quote(word.text)) +
                        " (valid: 0 … " + std::to_string(most) + ")");
  }
  return value;
}

// Where x, y and z are among the fields.
std::array<size_t, 3> PointAxes(const MeshText& text, const MeshWord& place,
                                const std::vector<PointField>& fields) {
  std::array<size_t, 3> axes{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const auto has_name = [&](const PointField& field) { return field.name == name; };
    const auto found = std::find_if(fields.begin(), fields.end(), has_name);
    if (found == fields.end() || found->count != 1 || found->list ||
        std::find_if(found + 1, fields.end(), has_name) != fields.end()) {
      text.Fail(place, "points need one number `" + name + "` (valid: x, y and z once each)");
    }
    axes[axis] = static_cast<size_t>(found - fields.begin());
  }
  return axes;
}

void PointList::Add(const Eigen::Vector3d& p) {
  if (p.hasNaN()) {
    ++invalid_;
  } else {
    all_.push_back(p);
  }
}

LoadedPoints PointList::Take(const std::string& path) const {
  if (all_.empty()) throw InputError({path + ": has no point"});
  LoadedPoints loaded;
  loaded.points = Eigen::Map<const Eigen::Matrix3Xd>(all_.front().data(), 3,
                                                     static_cast<Eigen::Index>(all_.size()));
  loaded.invalid = invalid_;
  return loaded;
}

double PointData::Next(PointScalar scalar) {
  Need(scalar.bytes);
  const double value = ReadScalar(bytes_.data() + at_, scalar, big_endian_);
  at_ += scalar.bytes;
  return value;
}

size_t PointData::NextLength(PointScalar scalar) {
  const double length = Next(scalar);
  if (!(length >= 0 && length <= 1e9 && length == std::floor(length))) {
    RefuseByte(path_, at_, "a list of " + Formatted("%g", length) + " numbers");
  }
  return static_cast<size_t>(length);
}

void PointData::Skip(size_t count, size_t each) {
  if (each != 0 && count > bytes_.size() / each) Need(bytes_.size() + 1);
  Need(count * each);
  at_ += count * each;
}

void PointData::Need(size_t bytes) const {
  if (bytes > bytes_.size() - at_)
    RefuseByte(path_, bytes_.size(), "the file ends within its data");
}

Eigen::Vector3d PointData::Element(const std::vector<PointField>& fields,
                                   const std::array<size_t, 3>* axes) {
  Eigen::Vector3d p(0, 0, 0);
  for (size_t f = 0; f < fields.size(); ++f) {
    const PointField& field = fields[f];
    if (field.list) {
      Skip(NextLength(*field.list), field.scalar.bytes);
      continue;
    }
    const auto axis =
        axes == nullptr ? 3 : std::find(axes->begin(), axes->end(), f) - axes->begin();
    if (axis < 3) {
      p[axis] = Next(field.scalar);
    } else {
      Skip(field.count, field.scalar.bytes);
    }
  }
  return p;
}

double PointNumber(const MeshText& text, const MeshWord& word) {
  for (const char* const nan : {"nan", "-nan", "NaN", "NAN"}) {
    if (word.text == nan) return std::numeric_limits<double>::quiet_NaN();
  }
  return text.Number(word);
}

void CheckPoint(const std::string& path, size_t byte, const Eigen::Vector3d& p) {
  if ((p.array().abs() > kMaxMeshCoordinate).any()) {
    RefuseByte(path, byte, "a coordinate is not finite or too large (valid: -1e9 … 1e9)");
  }
}

}  // namespace halfstep
