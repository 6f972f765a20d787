#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halfstep {

inline constexpr size_t kMostMessageBytes = size_t{1} << 20;  ///< of a client's message
inline constexpr int kMostMessageLevels = 8;                  ///< of its nesting
inline constexpr double kFarthestMessage = 1e3;               ///< of a place from W's origin [m]

/// A JSON object of a client. Throws InputError with what is wrong with the text: it is too long,
/// nests too deeply, is no JSON or no object, or a key stands twice in one object.
nlohmann::json ParseMessage(std::string_view text);

/// Reads the keys of one object of a message, strictly. A key that is missing, of another type, out
/// of range or unknown throws InputError "NAME.KEY: what is wrong (valid: …)". Borrows the object.
class MessageFields {
 public:
  /// `name` is the message's, for complaints.
  MessageFields(const nlohmann::json& object, std::string name);

  /// Whether the key is there.
  bool Has(const std::string& key) const { return object_.contains(key); }
  std::string Text(const std::string& key);  ///< a required text
  /// `otherwise`: where the key is missing; none: it may not be.
  double Number(const std::string& key, double min, double max,
                std::optional<double> otherwise = {});
  /// So many numbers.
  Eigen::VectorXd Numbers(const std::string& key, int count, double min, double max);
  /// So many rows of so many numbers.
  Eigen::MatrixXd Rows(const std::string& key, int rows, int count, double min, double max);
  /// From `least` to `most` such rows.
  Eigen::MatrixXd RowsUpTo(const std::string& key, int least, int most, int count, double min,
                           double max);
  /// The fields of an object.
  MessageFields Object(const std::string& key);
  /// The fields of each of a list of objects.
  std::vector<MessageFields> Objects(const std::string& key);
  /// Different whole numbers from 1 to `max`.
  std::vector<int> Indices(const std::string& key, int max);

  /// To be called when every key that is known was read.
  void RefuseOthers() const;
  /// Throws InputError about a key.
  [[noreturn]] void Fail(const std::string& key, const std::string& what) const;

 private:
  const nlohmann::json& Of(const std::string& key);

  const nlohmann::json& object_;
  std::string name_;
  std::vector<std::string> known_;
};

}  // namespace halfstep
