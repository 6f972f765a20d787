#include "smoothing/margins/slack_sink.h"

namespace halfstep {

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

Eigen::MatrixXd SlackSink::Gradient() const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(gradient_.data(), static_cast<Eigen::Index>(rows_.size()),
                                    static_cast<Eigen::Index>(sensitivities.size()));
}

}  // namespace halfstep
