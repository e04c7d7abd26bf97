// Every relation over the scenes of the suites `default` and `references`, in the moments round
// contact, for every detector that promises to be exact and for the oracle.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/types/check.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/suite_file.h"
#include "tests/conformance/detectors.h"
#include "tests/metamorphic/exact_ones.h"
#include "tests/metamorphic/moments.h"

namespace contactcheck {
namespace {

using test::Outcome;
using test::Relation;
using test::RelationCase;
using test::Subject;

const std::filesystem::path kFixtures = CONTACTCHECK_FIXTURES;

std::set<std::string> scene_ids() {
  std::set<std::string> ids;
  for (const char* suite : {"default", "references"})
    for (const scene::SuiteScene& scene :
         scene::load_suite(scene::find_target(suite, kFixtures).file).scenes)
      ids.insert(scene.id);
  return ids;
}

struct LoadedMoments {
  std::shared_ptr<const Subject> subject;
  std::string missing;  // not empty: the package that this machine lacks, in a sentence
};

LoadedMoments load_moments(const std::string& id) {
  try {
    const scene::Scene scene = scene::load_scene(scene::find_scene(id, kFixtures));
    return {std::make_shared<const Subject>(test::telling_moments(scene)), ""};
  } catch (const InputError& error) {
    const std::string sentence = error.what();
    if (sentence.find("the Debian package") == std::string::npos) throw;
    return {nullptr, sentence};
  }
}

// Tests come scene by scene, and in each relation by relation: one of each is kept.
class Workshop {
 public:
  const LoadedMoments& moments(const std::string& id) {
    if (id != scene_) {
      relation_ = nullptr, case_.reset();
      moments_ = load_moments(id);
      scene_ = id;
    }
    return moments_;
  }
  RelationCase& relation_case(const std::string& id, const Relation& relation) {
    const LoadedMoments& loaded = moments(id);
    if (relation_ != &relation) case_.emplace(relation, loaded.subject);
    relation_ = &relation;
    return *case_;
  }

 private:
  std::string scene_;
  LoadedMoments moments_;
  const Relation* relation_ = nullptr;
  std::optional<RelationCase> case_;
};

Workshop& workshop() {
  static Workshop shop;
  return shop;
}

// Who may refuse bodies without a lattice. Nothing else may be refused by anybody: a detector that
// refuses what it claims would pass every relation.
struct MayRefuse {
  const char *detectors, *reason;
};
constexpr MayRefuse kMayRefuseBareBodies[] = {
    {"bd-tree", "lattice nodes are its reduced coordinates"},
    {"ffd-grid", "its boxes are those of lattice cells"},
    {"ffd-aabb", "its boxes are those of lattice cells"}};

bool may_refuse(const std::string& detector, const std::vector<Body>& bodies) {
  const bool bare =
      std::ranges::any_of(bodies, [](const Body& body) { return !body.shape->lattice; });
  return bare && std::ranges::any_of(kMayRefuseBareBodies, [&](const MayRefuse& entry) {
           return detector.starts_with(entry.detectors);
         });
}

class SceneRelation : public ::testing::Test {
 public:
  SceneRelation(std::string scene, const Relation& relation, std::string detector)
      : scene_(std::move(scene)), relation_(relation), detector_(std::move(detector)) {}

  void TestBody() override {
    const LoadedMoments& loaded = workshop().moments(scene_);
    if (!loaded.missing.empty()) GTEST_SKIP() << loaded.missing;
    RelationCase& asked = workshop().relation_case(scene_, relation_);
    const bool allowed = may_refuse(detector_, asked.variant().bodies);
    try {
      expect_the_same(test::outcome_of(detector_, relation_, asked));
      EXPECT_FALSE(allowed) << detector_ << " answers what the list says it refuses";
    } catch (const RefusedInput& refusal) {
      EXPECT_TRUE(allowed) << detector_ << " refuses what it claims: " << refusal.what();
    }
  }

 private:
  void expect_the_same(const Outcome& found) {
    EXPECT_EQ(found.differing, 0u) << detector_ << found.differences;
    EXPECT_EQ(found.found_hash, found.expected_hash);
    EXPECT_EQ(found.skipped, 0u);
    EXPECT_GE(found.frames, 2u);
  }

  std::string scene_;
  const Relation& relation_;
  std::string detector_;
};

void register_test(const std::string& scene, const Relation& relation,
                   const std::string& detector) {
  const std::string suite = "Scene_" + test::test_name(scene) + "_" + relation.name;
  ::testing::RegisterTest(suite.c_str(), test::test_name(detector).c_str(), nullptr, nullptr,
                          __FILE__, __LINE__, [&relation, scene, detector]() -> SceneRelation* {
                            return new SceneRelation(scene, relation, detector);
                          });
}

// One bucket is brute force, and two threads do in the hard cases what they would do here.
bool too_slow(const std::string& name) {
  return name == "spatial-hash:table=1" || name == "ffd-lazy:bounds=nodes,threads=2";
}

void register_tests() {
  for (const std::string& scene : scene_ids())
    for (const Relation& relation : test::relations_of_scenes())
      for (const std::string& name : test::exact_ones(relation))
        if (!too_slow(name)) register_test(scene, relation, name);
}

}  // namespace
}  // namespace contactcheck

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  contactcheck::register_tests();
  return contactcheck::test::run_registered_tests();
}
