// The candidates of a scene: every detector that answers the question, with its options varied.
#pragma once

#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "core/types/semantics.h"
#include "reference/tune/candidate.h"

namespace contactcheck::tune {

/// The level at which answers to a question are counted. @pre not `contacts`
Level level_of(Question question);

struct DeformerChoice {
  std::string name;
  Cost step = {};
};

struct SpaceRequest {
  Question question = Question::kBody;
  /// Names of detectors; an option given in a name is not varied. Empty: all that are there.
  std::vector<std::string> detectors;
  std::vector<double> lattices = {
      1.0};  ///< see TuneCandidate::lattice; the first is the scene's own
  /// The first is the scene's own; empty: the deformer is not varied.
  std::vector<DeformerChoice> deformers;
};

/// All combinations. Of an option with choices each is tried; of a number its default, less and
/// more by its step (OptionInfo::step), where the option allows that (0, which stands for "by
/// itself", stays). The instruction set and the number of threads are the machine's, and not
/// varied.
/// @throws InputError for unknown detectors, and for one that was named and does not answer
std::vector<TuneCandidate> make_space(const DetectorCatalog& catalog, const SpaceRequest& request);

}  // namespace contactcheck::tune
