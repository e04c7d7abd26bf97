#include "tests/hard/corpus.h"

#include <map>

#include "reference/run/judged_scene.h"
#include "reference/scene/catalogue.h"

namespace contactcheck::test {
namespace {

const std::filesystem::path kFixtures = CONTACTCHECK_FIXTURES;

HardFamily read_family(const std::string& id) {
  HardFamily family;
  family.scene = load_scene(find_scene(id, kFixtures));
  family.truth = family_truth(family.scene);
  for (const auto& nodes : family.scene.recorded)
    family.vertices.push_back(map_bodies(family.scene, nodes));
  return family;
}

}  // namespace

Frame HardFamily::frame(std::size_t value) const {
  return make_frame(value, 0.0, scene.recorded[value], vertices[value]);
}

const HardFamily& hard_family(const std::string& id) {
  static std::map<std::string, HardFamily> known;
  const auto found = known.find(id);
  return found != known.end() ? found->second : known.emplace(id, read_family(id)).first->second;
}

std::vector<std::string> family_ids() {
  std::vector<std::string> ids;
  for (const CatalogueEntry& entry : list_families(kFixtures)) ids.push_back(entry.id);
  return ids;
}

const ExpectedFamilies& expected_families() {
  static const ExpectedFamilies expected = read_expected(kFixtures / "hard" / "expected.json");
  return expected;
}

}  // namespace contactcheck::test
