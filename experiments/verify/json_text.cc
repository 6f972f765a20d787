#include "experiments/verify/json_text.h"

#include <algorithm>

#include "wpg/files/input_error.h"
#include "wpg/files/nesting.h"

namespace halfstep::verify {

using nlohmann::json;

json ParseJson(const std::string& path, const std::string& text) {
  if (JsonDepth(text) > kMostJsonLevels) {
    throw InputError({path + ": nests too deeply (valid: at most " +
                      std::to_string(kMostJsonLevels) + " levels)"});
  }
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<long>(std::min(error.byte, text.size()));
    const long line = 1 + std::count(text.begin(), end, '\n');
    throw InputError({path + ":" + std::to_string(line) + ": is not JSON"});
  } catch (const json::exception&) {
    throw InputError({path + ": a number is out of range"});
  }
}

JsonMember::JsonMember(const std::string& path, const json& object, std::string name)
    : path_(path), object_(object), name_(std::move(name)) {
  if (!object.is_object()) Fail("is not an object");
}

const json& JsonMember::List(const std::string& key) const {
  const json& value = Of(key);
  if (!value.is_array()) FailAt(key, "is not a list");
  return value;
}

std::vector<JsonMember> JsonMember::Items(const std::string& key) const {
  std::vector<JsonMember> items;
  for (const json& item : List(key)) {
    items.emplace_back(path_, item, Name(key) + "[" + std::to_string(items.size()) + "]");
  }
  return items;
}

std::string JsonMember::String(const std::string& key) const {
  const json& value = Of(key);
  if (!value.is_string()) FailAt(key, "is not a text");
  return value.get<std::string>();
}

double JsonMember::Number(const std::string& key) const {
  const json& value = Of(key);
  if (!value.is_number()) FailAt(key, "is not a number");
  return value.get<double>();
}

std::optional<double> JsonMember::NumberOrNull(const std::string& key) const {
  if (Of(key).is_null()) return std::nullopt;
  return Number(key);
}

long JsonMember::Whole(const std::string& key) const {
  const json& value = Of(key);
  if (!value.is_number_integer()) FailAt(key, "is not a whole number");
  return value.get<long>();
}

void JsonMember::Fail(const std::string& what) const {
  throw InputError({path_ + ": " + (name_.empty() ? "the document" : name_) + ": " + what});
}

void JsonMember::FailAt(const std::string& key, const std::string& what) const {
  throw InputError({path_ + ": " + Name(key) + ": " + what});
}

const json& JsonMember::Of(const std::string& key) const {
  const auto found = object_.find(key);
  if (found == object_.end()) FailAt(key, "is missing");
  return *found;
}

}  // namespace halfstep::verify
