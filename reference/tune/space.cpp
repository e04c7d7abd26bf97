#include "reference/tune/space.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <set>

#include "core/types/check.h"
#include "core/types/shortest.h"

namespace contactcheck::tune {
namespace {

std::vector<std::string> values_of(const OptionInfo& option) {
  if (!option.choices.empty()) return option.choices;
  double usual = 0.0;
  std::from_chars(option.default_value.data(),
                  option.default_value.data() + option.default_value.size(), usual);
  std::vector<std::string> values = {option.default_value};
  for (double value : {usual / option.step, option.step * usual}) {
    if (option.integer) value = std::round(value);
    const std::string text = shortest(value);
    const bool fits = value != 0.0 && value >= option.min && value <= option.max;
    if (fits && std::find(values.begin(), values.end(), text) == values.end())
      values.push_back(text);
  }
  return values;
}

bool is_the_machines(const OptionInfo& option) {
  return option.name == "isa" || option.name == "threads";
}

// The options that a name sets, to their defaults or not. @pre the catalogue has parsed it
std::set<std::string> given_in(const std::string& name) {
  std::set<std::string> given;
  for (std::size_t at = name.find(':'); at != std::string::npos; at = name.find(',', at + 1))
    given.insert(name.substr(at + 1, name.find('=', at) - at - 1));
  return given;
}

bool answers(const DetectorCatalog& catalog, const DetectorSpec& spec, Question question) {
  const std::unique_ptr<Detector> detector = catalog.make(spec);
  const Semantics& semantics = detector->semantics();
  return semantics.answers(question) && semantics.claims(level_of(question));
}

class Space {
 public:
  Space(const DetectorCatalog& catalog, const SpaceRequest& request)
      : catalog_(catalog), request_(request) {}

  std::vector<TuneCandidate> make() {
    if (request_.detectors.empty()) {
      for (const DetectorInfo& info : catalog_.all())
        if (info.absent_because.empty()) add(info.id, false);
    } else {
      for (const std::string& name : request_.detectors) add(name, true);
    }
    return std::move(candidates_);
  }

 private:
  void add(const std::string& name, bool named) {
    const DetectorSpec spec = catalog_.parse(name);
    const DetectorInfo& info = *catalog_.find(spec.id);
    if (named && !info.absent_because.empty())
      throw InputError("detector \"" + name + "\" is absent: " + info.absent_because);
    if (!answers(catalog_, spec, request_.question)) {
      if (named)
        throw InputError("detector \"" + name + "\" does not answer the question \"" +
                         name_of(request_.question) + "\"");
      return;
    }
    given_ = given_in(name);
    vary(info, spec, 0);
  }

  // An option that the name sets stays as it is.
  void vary(const DetectorInfo& info, const DetectorSpec& spec, std::size_t option) {
    if (option == info.options.size()) return add_models(info, spec);
    const OptionInfo& o = info.options[option];
    if (is_the_machines(o) || given_.contains(o.name)) return vary(info, spec, option + 1);
    for (const std::string& value : values_of(o)) {
      DetectorSpec varied = spec;
      varied.options[o.name] = value;
      vary(info, varied, option + 1);
    }
  }

  void add_models(const DetectorInfo& info, const DetectorSpec& spec) {
    const TuneCandidate plain = candidate_of(info, spec);
    for (const double lattice : request_.lattices) {
      TuneCandidate candidate = plain;
      candidate.lattice = lattice;
      candidate.choices.push_back({"lattice", shortest(lattice)});
      candidate.usual &= lattice == request_.lattices.front();
      if (request_.deformers.empty()) candidates_.push_back(candidate);
      for (const DeformerChoice& deformer : request_.deformers)
        candidates_.push_back(with(deformer, candidate));
    }
  }

  // In the scene's own model, of which nothing is said yet.
  TuneCandidate candidate_of(const DetectorInfo& info, const DetectorSpec& spec) const {
    TuneCandidate candidate;
    candidate.choices.push_back({"detector", spec.id});
    candidate.usual = true;
    std::string options;
    for (const OptionInfo& o : info.options) {
      const std::string& value = spec.options.at(o.name);
      if (!is_the_machines(o)) candidate.choices.push_back({o.name, value});
      if (value == o.default_value) continue;
      candidate.usual = false;
      options += (options.empty() ? ":" : ",") + o.name + "=" + value;
    }
    candidate.detector = catalog_.parse(spec.id + options).name;
    return candidate;
  }

  TuneCandidate with(const DeformerChoice& deformer, TuneCandidate candidate) const {
    candidate.deformer = deformer.name;
    candidate.step = deformer.step;
    candidate.choices.push_back({"deformer", deformer.name});
    candidate.usual &= deformer.name == request_.deformers.front().name;
    return candidate;
  }

  const DetectorCatalog& catalog_;
  const SpaceRequest& request_;
  std::set<std::string> given_;  ///< of the name that is varied
  std::vector<TuneCandidate> candidates_;
};

}  // namespace

Level level_of(Question question) {
  switch (question) {
    case Question::kTriangles:
      return Level::kTriangle;
    case Question::kCells:
      return Level::kCell;
    default:
      return Level::kBody;
  }
}

std::vector<TuneCandidate> make_space(const DetectorCatalog& catalog, const SpaceRequest& request) {
  std::vector<TuneCandidate> candidates = Space(catalog, request).make();
  if (candidates.empty())
    throw InputError(std::string("no detector answers the question \"") +
                     name_of(request.question) + "\"");
  return candidates;
}

}  // namespace contactcheck::tune
