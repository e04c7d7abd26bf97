#include "tests/conformance/detectors.h"

#include <algorithm>
#include <cctype>

#include "reference/adapters/register.h"

namespace contactcheck::test {
namespace {

// Options that change what is asked of a library or what is claimed.
constexpr const char* kVariants[] = {"spatial-hash:table=1",
                                     "spatial-hash:precision=single",
                                     "aabb-tree:precision=single",
                                     "sphere-tree:precision=single",
                                     "bd-tree:bound=paper",
                                     "bd-tree:precision=single",
                                     "ffd-aabb:bounds=safe",
                                     "ffd-aabb-sphere2:bounds=safe",
                                     "ffd-aabb-sphere2+tri:bounds=paper",
                                     "ffd-aabb-sphere2+tri:radius=0.8",
                                     "ffd-aabb-sphere2+tri:radius=1.25",
                                     "ffd-aabb-sphere2+tri:precision=single",
                                     "ffd-lazy:precision=single",
                                     "ffd-lazy:threads=2",
                                     "full-refit:precision=single",
                                     "full-refit:threads=2",
                                     "bullet-vf:scale=1",
                                     "libccd-gjk:pieces=boxes",
                                     "libccd-mpr:pieces=boxes"};

DetectorCatalog made_catalogue() {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  adapters::register_reference_detectors(catalog);
  return catalog;
}

}  // namespace

const DetectorCatalog& catalogue() {
  static const DetectorCatalog catalog = made_catalogue();
  return catalog;
}

std::vector<std::string> detector_names() {
  std::vector<std::string> names;
  for (const DetectorInfo& info : catalogue().all()) names.push_back(info.id);
  for (const char* variant : kVariants) names.push_back(variant);
  return names;
}

std::vector<std::string> detector_names(Moment of) {
  std::vector<std::string> names = detector_names();
  std::erase_if(names, [of](const std::string& name) {
    const bool absent = !catalogue().find(catalogue().parse(name).id)->absent_because.empty();
    return absent ? of != Moment::kFrame : !answers_any(make_detector(name)->semantics(), of);
  });
  return names;
}

bool is_of(Question question, Moment moment) {
  return is_of_steps(question) == (moment == Moment::kStep);
}

bool answers_any(const Semantics& semantics, Moment moment) {
  return std::any_of(semantics.questions.begin(), semantics.questions.end(),
                     [moment](Question question) { return is_of(question, moment); });
}

std::string test_name(const std::string& detector) {
  std::string name = detector;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

std::unique_ptr<Detector> make_detector(const std::string& name) {
  return catalogue().make(catalogue().parse(name));
}

}  // namespace contactcheck::test
