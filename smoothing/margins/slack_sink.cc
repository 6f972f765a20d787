#include "smoothing/margins/slack_sink.h"

namespace halfstep {
namespace {

// The waist's height comes last, so that a sum over what moves on flat ground is what it is
// without.
double Product(const WalkState& gradient, const WalkState& tangent) {
  static_assert(kWaistZ + 1 == kNumQuantities);
  return gradient.head<kWaistZ>().dot(tangent.head<kWaistZ>()) +
         gradient[kWaistZ] * tangent[kWaistZ];
}

}  // namespace

void SlackSink::Begin(MarginFamily family, double demanded) {
  family_ = family;
  demanded_ = demanded;
  scale_ = Scale(family);
}

bool SlackSink::AddSlack(double margin, double rate) {
  const double slack = (margin - demanded_) / scale_;
  if (slack > cutoff_) return false;
  rows_.push_back({family_, slack, rate / scale_});
  return true;
}

void SlackSink::AddSlopes(const WalkJet& gradient) {
  const bool of_first = !gradient.first.isZero(0.0), of_second = !gradient.second.isZero(0.0);
  for (const WalkSensitivity& s : sensitivities) {
    double slope = Product(gradient.value, s.jet.value);
    if (of_first) slope += Product(gradient.first, s.jet.first);
    if (of_second) slope += Product(gradient.second, s.jet.second);
    gradient_.push_back(slope / scale_);
  }
}

const std::vector<PostureTangent>& SlackSink::Tangents(Instant* at) {
  if (tangents_.empty()) {
    for (const WalkSensitivity& s : sensitivities) {
      tangents_.push_back(Differentiate(at->robot(), at->jet(), at->posture(), s.jet));
    }
  }
  return tangents_;
}

Eigen::MatrixXd SlackSink::Gradient() const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(gradient_.data(), static_cast<Eigen::Index>(rows_.size()),
                                    static_cast<Eigen::Index>(sensitivities.size()));
}

}  // namespace halfstep
