#include <algorithm>
#include <string_view>
#include <utility>

#include "wpg/check.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep {
namespace {

std::string TextOfNumber(const std::string& key, double value) {
  return IsDegrees(key) ? ShortestDegrees(value) : ShortestText(value);
}

// Text that no YAML reader takes for anything else stays plain, the rest goes into double quotes.
std::string TextOf(const std::string& text) {
  HALFSTEP_CHECK(FindInvalidUtf8(text) == std::string::npos && !HasControlCharacter(text),
                 Quote(text) << " is no text of one line");
  constexpr std::string_view kReserved[] = {"true", "false", "yes",  "no", "on",
                                            "off",  "null",  "none", "y",  "n"};
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_plain = [&is_letter](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') ||
           std::string_view("_-./").find(c) != std::string_view::npos;
  };
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const bool reserved =
      std::find(std::begin(kReserved), std::end(kReserved), lower) != std::end(kReserved);
  if (!text.empty() && is_letter(text[0]) && !reserved &&
      std::all_of(text.begin(), text.end(), is_plain)) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

template <typename Values, typename ToText>
std::string FlowList(const Values& values, const ToText& to_text) {
  std::string text = "[";
  for (const auto& value : values) text += (text.size() == 1 ? "" : ", ") + to_text(value);
  return text + "]";
}

// Writes one map in block style, its lines indented.
class YamlWriter : public Fields {
 public:
  explicit YamlWriter(size_t indentation) : indentation_(indentation) {}

  const std::string& text() const { return text_; }

  void Number(const char* key, double* value, const NumberSpec& spec) override {
    if (*value == spec.left_out) return;
    Line(key, TextOfNumber(key, *value));
  }
  void OptionalNumber(const char* key, std::optional<double>* value,
                      const NumberSpec& spec) override {
    if (value->has_value() ? *value == spec.left_out : spec.none_left_out) return;
    Line(key, value->has_value() ? TextOfNumber(key, **value) : "none");
  }
  void Integer(const char* key, int* value, const NumberSpec&) override {
    Line(key, std::to_string(*value));
  }
  void Boolean(const char* key, bool* value, const TextSpec&) override {
    Line(key, *value ? "true" : "false");
  }
  void Text(const char* key, std::string* value, const TextSpec& spec) override {
    if (spec.left_out_empty && value->empty()) return;
    Line(key, TextOf(*value));
  }
  void Texts(const char* key, std::vector<std::string>* value, const TextSpec&) override {
    Line(key, FlowList(*value, TextOf));
  }
  void Numbers(const char* key, std::vector<double>* value, size_t count,
               const NumberSpec&) override {
    if (count > 0 && value->empty()) return;  // an absent key: no list of none is valid
    Line(key, FlowList(*value, [key](double x) { return TextOfNumber(key, x); }));
  }
  void Points(const char* key, Eigen::Matrix2Xd* value, const GroupSpec&,
              const NumberSpec&) override {
    Line(key, FlowList(value->colwise(), [key](const auto& point) {
           return FlowList(point, [key](double x) { return TextOfNumber(key, x); });
         }));
  }

  bool Group(const char* key, const GroupSpec&,
             const std::function<void(Fields&)>& declare) override {
    YamlWriter writer(indentation_ + 2);
    declare(writer);
    writer.text_.empty() ? Line(key, "{}") : Line(key, "");
    text_ += writer.text_;
    return true;
  }
  void Items(const char* key, const GroupSpec&, size_t size, const std::function<void(size_t)>&,
             const std::function<void(Fields&, size_t)>& declare) override {
    Line(key, size == 0 ? "[]" : "");
    for (size_t i = 0; i < size; ++i) {
      YamlWriter writer(indentation_ + 4);
      declare(writer, i);
      const std::string dash = std::string(indentation_ + 2, ' ') + "- ";
      text_ += writer.text_.empty() ? dash + "{}\n" : dash + writer.text_.substr(dash.size());
    }
  }

 private:
  void Line(const std::string& key, const std::string& value) {
    text_ += std::string(indentation_, ' ') + key + ":";
    text_ += value.empty() ? "\n" : " " + value + "\n";
  }

  const size_t indentation_;
  std::string text_;
};

}  // namespace

std::string WriteYaml(const std::function<void(Fields&)>& declare) {
  YamlWriter writer(0);
  declare(writer);
  return writer.text().empty() ? "{}\n" : writer.text();
}

}  // namespace halfstep
