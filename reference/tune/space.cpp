#include "reference/tune/space.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <set>

#include "core/types/check.h"

namespace contactcheck {
namespace {

std::string shortest(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

std::vector<std::string> values_of(const OptionInfo& option) {
  if (!option.choices.empty()) return option.choices;
  double usual = 0.0;
  std::from_chars(option.default_value.data(),
                  option.default_value.data() + option.default_value.size(), usual);
  std::vector<std::string> values = {option.default_value};
  for (double value : {0.5 * usual, 2.0 * usual}) {
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

  std::vector<Candidate> make() {
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
    if (option == info.options.size()) return add_lattices(info, spec);
    const OptionInfo& o = info.options[option];
    if (is_the_machines(o) || given_.contains(o.name)) return vary(info, spec, option + 1);
    for (const std::string& value : values_of(o)) {
      DetectorSpec varied = spec;
      varied.options[o.name] = value;
      vary(info, varied, option + 1);
    }
  }

  void add_lattices(const DetectorInfo& info, const DetectorSpec& spec) {
    for (const double lattice : request_.lattices) {
      Candidate candidate;
      candidate.lattice = lattice;
      candidate.choices.push_back({"detector", spec.id});
      candidate.usual = lattice == request_.lattices.front();
      std::string options;
      for (const OptionInfo& o : info.options) {
        const std::string& value = spec.options.at(o.name);
        if (!is_the_machines(o)) candidate.choices.push_back({o.name, value});
        if (value == o.default_value) continue;
        candidate.usual = false;
        options += (options.empty() ? ":" : ",") + o.name + "=" + value;
      }
      candidate.choices.push_back({"lattice", shortest(lattice)});
      candidate.detector = catalog_.parse(spec.id + options).name;
      candidates_.push_back(std::move(candidate));
    }
  }

  const DetectorCatalog& catalog_;
  const SpaceRequest& request_;
  std::set<std::string> given_;  ///< of the name that is varied
  std::vector<Candidate> candidates_;
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

std::vector<Candidate> make_space(const DetectorCatalog& catalog, const SpaceRequest& request) {
  std::vector<Candidate> candidates = Space(catalog, request).make();
  if (candidates.empty())
    throw InputError(std::string("no detector answers the question \"") +
                     name_of(request.question) + "\"");
  return candidates;
}

}  // namespace contactcheck
