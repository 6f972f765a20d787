#include "experiments/run/json_fields.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

using nlohmann::ordered_json;

double NumberOf(const std::string& key, double value) {
  return IsDegrees(key) ? ParseNumber(ShortestDegrees(value)).value : value;
}

class JsonWriter : public Fields {
 public:
  const ordered_json& object() const { return object_; }

  void Number(const char* key, double* value, const NumberSpec& spec) override {
    if (*value != spec.left_out) object_[key] = NumberOf(key, *value);
  }
  void OptionalNumber(const char* key, std::optional<double>* value,
                      const NumberSpec& spec) override {
    if (!value->has_value()) {
      if (!spec.none_left_out) object_[key] = nullptr;
    } else if (*value != spec.left_out) {
      object_[key] = NumberOf(key, **value);
    }
  }
  void Integer(const char* key, int* value, const NumberSpec&) override { object_[key] = *value; }
  void Boolean(const char* key, bool* value, const TextSpec&) override { object_[key] = *value; }
  void Text(const char* key, std::string* value, const TextSpec&) override {
    object_[key] = *value;
  }
  void Texts(const char* key, std::vector<std::string>* value, const TextSpec&) override {
    object_[key] = *value;
  }
  void Numbers(const char* key, std::vector<double>* value, size_t, const NumberSpec&) override {
    ordered_json& list = object_[key] = ordered_json::array();
    for (const double x : *value) list.push_back(NumberOf(key, x));
  }
  void Points(const char* key, Eigen::Matrix2Xd* value, const GroupSpec&,
              const NumberSpec&) override {
    ordered_json& list = object_[key] = ordered_json::array();
    for (const auto& point : value->colwise()) {
      list.push_back({NumberOf(key, point.x()), NumberOf(key, point.y())});
    }
  }

  bool Group(const char* key, const GroupSpec&,
             const std::function<void(Fields&)>& declare) override {
    object_[key] = JsonOf(declare);
    return true;
  }
  void Items(const char* key, const GroupSpec&, size_t size, const std::function<void(size_t)>&,
             const std::function<void(Fields&, size_t)>& declare) override {
    ordered_json& list = object_[key] = ordered_json::array();
    for (size_t i = 0; i < size; ++i) {
      list.push_back(JsonOf([&](Fields& fields) { declare(fields, i); }));
    }
  }

 private:
  ordered_json object_ = ordered_json::object();
};

}  // namespace

ordered_json JsonOf(const std::function<void(Fields&)>& declare) {
  JsonWriter writer;
  declare(writer);
  return writer.object();
}

}  // namespace halfstep
