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

/// A detector with every combination of the values of its options. An option that the name sets
/// stays as it is.
std::vector<DetectorSpec> varied(const DetectorInfo& info, const DetectorSpec& spec,
                                 const std::string& name) {
  std::set<std::string> given;
  for (std::size_t at = name.find(':'); at != std::string::npos; at = name.find(',', at + 1))
    given.insert(name.substr(at + 1, name.find('=', at) - at - 1));
  std::vector<DetectorSpec> specs = {spec};
  for (const OptionInfo& option : info.options) {
    if (is_the_machines(option) || given.contains(option.name)) continue;
    const std::vector<std::string> values = values_of(option);
    std::vector<DetectorSpec> more;
    for (const DetectorSpec& one : specs)
      for (const std::string& value : values) {
        more.push_back(one);
        more.back().options[option.name] = value;
      }
    specs = std::move(more);
  }
  return specs;
}

/// In the scene's own lattice and with its own deformer, which are not among its choices yet.
TuneCandidate candidate_of(const DetectorCatalog& catalog, const DetectorInfo& info,
                           const DetectorSpec& spec) {
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
  candidate.detector = catalog.parse(spec.id + options).name;
  return candidate;
}

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
  const bool named = !request.detectors.empty();
  std::vector<std::string> names = request.detectors;
  if (!named)
    for (const DetectorInfo& info : catalog.all())
      if (info.absent_because.empty()) names.push_back(info.id);

  std::vector<TuneCandidate> candidates;
  for (const std::string& name : names) {
    const DetectorSpec spec = catalog.parse(name);
    const DetectorInfo& info = *catalog.find(spec.id);
    if (!info.absent_because.empty())
      throw InputError("detector \"" + name + "\" is absent: " + info.absent_because);
    const std::unique_ptr<Detector> detector = catalog.make(spec);
    const Semantics& semantics = detector->semantics();
    if (!semantics.answers(request.question) || !semantics.claims(level_of(request.question))) {
      if (!named) continue;
      throw InputError("detector \"" + name + "\" does not answer the question \"" +
                       name_of(request.question) + "\"");
    }
    for (const DetectorSpec& one : varied(info, spec, name)) {
      const TuneCandidate plain = candidate_of(catalog, info, one);
      for (const double lattice : request.lattices) {
        TuneCandidate candidate = plain;
        candidate.lattice = lattice;
        candidate.choices.push_back({"lattice", shortest(lattice)});
        candidate.usual &= lattice == request.lattices.front();
        if (request.deformers.empty()) candidates.push_back(candidate);
        for (const DeformerChoice& deformer : request.deformers) {
          TuneCandidate& deformed = candidates.emplace_back(candidate);
          deformed.deformer = deformer.name;
          deformed.step = deformer.step;
          deformed.choices.push_back({"deformer", deformer.name});
          deformed.usual &= deformer.name == request.deformers.front().name;
        }
      }
    }
  }
  if (candidates.empty())
    throw InputError(std::string("no detector answers the question \"") +
                     name_of(request.question) + "\"");
  return candidates;
}

}  // namespace contactcheck::tune
