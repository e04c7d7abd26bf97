// Every hard case, for every detector that promises to be exact: one test each, registered from the
// corpus. Called with GoogleTest's filter, it fails if that names no test.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "core/detect/registry.h"
#include "reference/adapters/register.h"
#include "reference/judge/judge.h"
#include "tests/hard/corpus.h"
#include "tests/hard/exact_detectors.h"

namespace contactcheck {
namespace {

using test::hard_family;
using test::HardFamily;

const DetectorCatalog& catalogue() {
  static const DetectorCatalog catalog = [] {
    DetectorCatalog made;
    register_core_detectors(made);
    adapters::register_reference_detectors(made);
    return made;
  }();
  return catalog;
}

// Detectors of families, prepared once; cases follow one another as frames do.
Detector& prepared(const std::string& detector, const HardFamily& family) {
  static std::map<std::pair<std::string, std::string>, std::unique_ptr<Detector>> known;
  std::unique_ptr<Detector>& made = known[{detector, family.scene.id}];
  if (!made) {
    made = catalogue().make(catalogue().parse(detector));
    made->prepare(family.scene.bodies);
  }
  return *made;
}

ContactSet answer(Detector& detector, const HardFamily& family, std::size_t value,
                  Question question) {
  Frame frame = family.frame(value);
  if (!detector.needs_vertices())
    for (BodyState& body : frame.bodies) body.vertices = {};
  detector.update(frame);
  ContactSet out;
  detector.query(question, out);
  out.canonicalize();
  return out;
}

class HardCase : public ::testing::Test {
 public:
  HardCase(std::string detector, std::string family, std::size_t value)
      : detector_(std::move(detector)), family_(std::move(family)), value_(value) {}

  void TestBody() override {
    const HardFamily& family = hard_family(family_);
    Detector& detector = prepared(detector_, family);
    const suite::CaseTruth& truth = family.truth[value_];
    EXPECT_EQ(answer(detector, family, value_, Question::kTriangles).triangles, truth.triangles);
    if (detector.semantics().answers(Question::kBody)) {
      EXPECT_EQ(answer(detector, family, value_, Question::kBody).bodies.size(), truth.bodies);
    }
    if (detector.semantics().answers(Question::kSelf)) {
      const std::vector<Body>& bodies = family.scene.bodies;
      std::vector<SelfPair> self = answer(detector, family, value_, Question::kSelf).self;
      std::erase_if(self, [&](const SelfPair& pair) {
        return !family.scene.judges(*judge::self_level(*bodies[pair.body].shape, pair.a, pair.b));
      });
      EXPECT_EQ(self, truth.self);
    }
  }

 private:
  std::string detector_, family_;
  std::size_t value_;
};

// Letters, digits and underscores: a hyphen would begin the negative part of a filter.
std::string plain(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

// Two values such as 1e-9 and 1e+9 must not become one name.
std::string case_name(const std::string& family, std::size_t index, const std::string& value) {
  return plain(family) + "/" + std::to_string(index) + "_" + plain(value);
}

void register_cases(const std::string& detector) {
  for (const std::string& family : test::family_ids()) {
    const std::vector<std::string>& values = hard_family(family).scene.family()->values;
    for (std::size_t v = 0; v < values.size(); ++v)
      ::testing::RegisterTest(("HardCase_" + plain(detector)).c_str(),
                              case_name(family, v, values[v]).c_str(), nullptr, nullptr, __FILE__,
                              __LINE__,
                              [=]() -> HardCase* { return new HardCase(detector, family, v); });
  }
}

}  // namespace
}  // namespace contactcheck

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  for (const std::string& detector : contactcheck::test::exact_detectors())
    contactcheck::register_cases(detector);
  const int result = RUN_ALL_TESTS();
  const auto& unit = *::testing::UnitTest::GetInstance();
  if (::testing::GTEST_FLAG(list_tests) || unit.test_to_run_count() > 0) return result;
  std::fprintf(stderr, "no case was run\n");
  return 1;
}
