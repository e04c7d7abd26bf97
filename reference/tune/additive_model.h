// A guess at what has not been measured yet, from what has: every choice adds an effect of its own,
// and a smaller one together with the detector it is made for.
//
// Bayesian linear regression with a normal prior on every effect (Bishop, Pattern Recognition and
// Machine Learning, 2006, 3.3): few measurements give wide guesses, and a choice that was never
// tried is as uncertain as the prior says.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "reference/tune/candidate.h"

namespace contactcheck {

/// Standard deviations of the effects, in units of the value that is modelled.
struct EffectPriors {
  double detector = 2.0;     ///< of the detector itself
  double choice = 0.5;       ///< of another choice
  double interaction = 0.2;  ///< of a choice for one detector
  double noise = 0.05;       ///< of a measurement
};

class AdditiveModel {
 public:
  /// `candidates` must outlive it.
  AdditiveModel(const std::vector<TuneCandidate>& candidates, const EffectPriors& priors);

  /// Forgets earlier fits. @pre as many values as indices, at least one, all finite
  void fit(std::span<const std::size_t> measured, std::span<const double> values);

  struct Guess {
    double mean = 0.0, deviation = 0.0;
  };
  /// @pre fit was called
  Guess guess(std::size_t candidate) const;

 private:
  std::vector<std::vector<std::pair<Eigen::Index, double>>> features_;  ///< [candidate]
  Eigen::Index size_ = 0;
  double noise_;
  double centre_ = 0.0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;
};

}  // namespace contactcheck
