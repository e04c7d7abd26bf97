#include "tests/hard/corpus.h"

#include <map>

#include "reference/judge/judged_scene.h"
#include "reference/scene/catalogue.h"

namespace contactcheck::test {
namespace {

const std::filesystem::path kFixtures = CONTACTCHECK_FIXTURES;

HardFamily read_family(const std::string& id) {
  HardFamily family;
  family.scene = scene::load_scene(scene::find_scene(id, kFixtures));
  family.truth = suite::family_truth(family.scene);
  for (const auto& nodes : family.scene.recorded)
    family.vertices.push_back(scene::map_bodies(family.scene, nodes));
  return family;
}

}  // namespace

Frame HardFamily::frame(std::size_t value) const {
  return judge::make_frame(value, 0.0, scene.recorded[value], vertices[value]);
}

const HardFamily& hard_family(const std::string& id) {
  static std::map<std::string, HardFamily> known;
  const auto found = known.find(id);
  return found != known.end() ? found->second : known.emplace(id, read_family(id)).first->second;
}

std::vector<std::string> family_ids() {
  std::vector<std::string> ids;
  for (const scene::CatalogueEntry& entry : scene::list_families(kFixtures))
    ids.push_back(entry.id);
  return ids;
}

const suite::ExpectedFamilies& expected_families() {
  static const suite::ExpectedFamilies expected =
      suite::read_expected(kFixtures / "hard" / "expected.json");
  return expected;
}

}  // namespace contactcheck::test
