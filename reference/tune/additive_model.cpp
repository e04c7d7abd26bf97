#include "reference/tune/additive_model.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <map>
#include <string>

#include "core/types/check.h"

namespace contactcheck {

AdditiveModel::AdditiveModel(const std::vector<TuneCandidate>& candidates,
                             const EffectPriors& priors)
    : noise_(priors.noise) {
  std::map<std::string, Eigen::Index> columns;
  const auto column = [&](const std::string& name) {
    return columns.emplace(name, static_cast<Eigen::Index>(columns.size())).first->second;
  };
  for (const TuneCandidate& candidate : candidates) {
    auto& row = features_.emplace_back();
    const std::string& detector = candidate.choices.front().value;
    row.emplace_back(column(detector), priors.detector);
    for (std::size_t i = 1; i < candidate.choices.size(); ++i) {
      const std::string choice = candidate.choices[i].axis + "=" + candidate.choices[i].value;
      row.emplace_back(column(choice), priors.choice);
      row.emplace_back(column(detector + " " + choice), priors.interaction);
    }
  }
  size_ = static_cast<Eigen::Index>(columns.size());
}

void AdditiveModel::fit(std::span<const std::size_t> measured, std::span<const double> values) {
  CONTACTCHECK_INVARIANT(!measured.empty() && measured.size() == values.size(),
                         "a fit needs a value for each index");
  centre_ = 0.0;
  for (const double value : values) centre_ += value / static_cast<double>(values.size());
  Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(size_, size_);
  Eigen::VectorXd weighted = Eigen::VectorXd::Zero(size_);
  const double weight = 1.0 / (noise_ * noise_);
  for (std::size_t i = 0; i < measured.size(); ++i)
    for (const auto& [a, x] : features_[measured[i]]) {
      weighted[a] += weight * x * (values[i] - centre_);
      for (const auto& [b, y] : features_[measured[i]]) precision(a, b) += weight * x * y;
    }
  covariance_ = precision.llt().solve(Eigen::MatrixXd::Identity(size_, size_));
  mean_ = covariance_ * weighted;
}

AdditiveModel::Guess AdditiveModel::guess(std::size_t candidate) const {
  Guess guess{centre_, 0.0};
  double variance = 0.0;
  for (const auto& [a, x] : features_[candidate]) {
    guess.mean += x * mean_[a];
    for (const auto& [b, y] : features_[candidate]) variance += x * y * covariance_(a, b);
  }
  guess.deviation = std::sqrt(std::max(variance, 0.0));
  return guess;
}

}  // namespace contactcheck
