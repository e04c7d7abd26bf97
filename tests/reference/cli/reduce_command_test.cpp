// `contactcheck reduce`: from a run's case files and from families to minimal cases. What it does
// with detectors of known defects is tests/faults/reduce_test.cpp.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/scene/scene.h"
#include "tests/reference/cli/program.h"
#include "tests/reference/cli/refusal.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::BadCommand;
using test::contactcheck_program;
using test::Outcome;
using test::Scratch;
using test::text_of;
using testing::HasSubstr;

// FCL calls two triangles that are segments of one plane a contact wherever they are.
constexpr const char* kFamily = "hard-two-segments-plane";

json results_of_run(const std::string& target, const std::string& detector, const fs::path& out) {
  const Outcome run = contactcheck_program(
      {"run", target, "--detector", detector, "--no-timing", "--quiet", "--out", out.string()});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(text_of(out / "results.json"));
}

class ReduceCase : public testing::Test {
 protected:
  fs::path out(const char* name) const { return scratch_.folder() / name; }
  Scratch scratch_;
};

TEST_F(ReduceCase, EveryCaseOfARunBecomesOneThatRunShowsAgain) {
  const json before = results_of_run(kFamily, "fcl-aabb", out("out"));
  ASSERT_EQ(before.at("disagreements").size(), 2u);  // bodies, triangles
  for (const json& d : before.at("disagreements")) {
    const fs::path file = out("out") / d.at("case").get<std::string>();
    const Outcome reduce = contactcheck_program({"reduce", file.string()});
    ASSERT_EQ(reduce.exit_code, 0) << reduce.err;
    fs::path least = file;
    least.replace_extension(".min.json");
    EXPECT_THAT(reduce.err, HasSubstr(least.string() + "\n"));
    const json after = results_of_run(least.string(), "fcl-aabb", out("again"));
    const auto same = [&](const json& other) {
      return other.at("level") == d.at("level") && other.at("kind") == d.at("kind");
    };
    const json& found = after.at("disagreements");
    EXPECT_EQ(std::count_if(found.begin(), found.end(), same), 1) << found;
  }
}

TEST_F(ReduceCase, StaysBehindForTheNextRun) {
  results_of_run(kFamily, "fcl-aabb", out("out"));
  ASSERT_EQ(contactcheck_program({"reduce", (out("out") / "cases/0001.json").string()}).exit_code,
            0);
  results_of_run(kFamily, "fcl-aabb", out("out"));
  EXPECT_TRUE(fs::exists(out("out") / "cases/0001.min.json"));
}

TEST_F(ReduceCase, TakesAnotherDetectorThatErrsInTheSameWay) {
  results_of_run(kFamily, "fcl-aabb", out("out"));
  const fs::path file = out("out") / "cases/0002.json";
  const Outcome other = contactcheck_program({"reduce", file.string(), "--detector", "fcl-obbrss"});
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.err, HasSubstr("fcl-obbrss spurious at level triangle"));
}

TEST_F(ReduceCase, ThatDoesNotShowAnyMoreIsRefused) {
  results_of_run(kFamily, "fcl-aabb", out("out"));
  const fs::path file = out("out") / "cases/0002.json";
  const Outcome right = contactcheck_program({"reduce", file.string(), "--detector", "embree"});
  EXPECT_EQ(right.exit_code, 2);
  EXPECT_EQ(right.err,
            "contactcheck: hard-two-segments-plane, frame 0: nothing is spurious at level triangle "
            "any more in the answer of embree\n");
  EXPECT_FALSE(fs::exists(out("out") / "cases/0002.min.json"));
}

TEST_F(ReduceCase, OfAFamilyIsTheFirstFrameOrTheNamedValue) {
  const std::string file = out("least.json").string();
  const Outcome first = contactcheck_program(
      {"reduce", "hard-balls-scale", "--detector", "fcl-obbrss", "--out", file});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.err, HasSubstr("(frame 0): fcl-obbrss missed at level triangle"));
  EXPECT_EQ(scene::load_scene(file).id, "least");
  const Outcome named = contactcheck_program({"reduce", std::string(kFamily) + "@0", "--detector",
                                              "fcl-obbrss", "--kind", "missed", "--out", file});
  EXPECT_EQ(named.exit_code, 2);
  EXPECT_THAT(named.err, HasSubstr("nothing is missed in the answer of fcl-obbrss"));
}

class BadReduction : public testing::TestWithParam<BadCommand> {};

TEST_P(BadReduction, IsRefusedWithOneSentence) {
  const Scratch scratch;
  scratch.write("tiny.json", test::tiny_scene());
  scratch.write("empty.json", "");
  scratch.write("list.json", "[]");
  scratch.write("cut.json", R"({"detector": "fcl-aabb", )");
  scratch.write("case.json", R"({"detector": "fcl-aabb", "kind": "missed"})");
  test::expect_refused(GetParam(), scratch);
}

std::string named(const testing::TestParamInfo<BadCommand>& test) { return test.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Reduce, BadReduction,
    testing::Values(
        BadCommand{"Nothing", {"reduce"}, {"case"}},
        BadCommand{"MissingFile", {"reduce", "DIR/none.json"}, {"none.json"}},
        BadCommand{"EmptyFile", {"reduce", "DIR/empty.json"}, {"empty.json", "is empty"}},
        BadCommand{"NotACaseAndNotAScene", {"reduce", "DIR/list.json"}, {"list.json"}},
        BadCommand{"CutShort", {"reduce", "DIR/cut.json"}, {"cut.json", "line 1"}},
        BadCommand{"CaseWithoutScene", {"reduce", "DIR/case.json"}, {"case.json", "scene"}},
        BadCommand{"SceneWithoutDetector", {"reduce", "DIR/tiny.json"}, {"--detector"}},
        BadCommand{"UnknownDetector",
                   {"reduce", "DIR/tiny.json", "--detector", "embers"},
                   {"unknown detector \"embers\""}},
        BadCommand{"UnknownLevel",
                   {"reduce", "DIR/tiny.json", "--detector", "embree", "--level", "corner"},
                   {"--level \"corner\""}},
        BadCommand{"LevelOfSolids",
                   {"reduce", "DIR/tiny.json", "--detector", "bullet-vf", "--level", "vertex"},
                   {"level vertex", "a part of one is open"}},
        BadCommand{"UnknownKind",
                   {"reduce", "DIR/tiny.json", "--detector", "embree", "--kind", "late"},
                   {"--kind", "late"}},
        BadCommand{"NoSuchFrame",
                   {"reduce", "DIR/tiny.json@5", "--detector", "embree"},
                   {"no frame \"5\"", "0 to 4"}},
        BadCommand{"NoBudget",
                   {"reduce", "DIR/tiny.json", "--detector", "embree", "--budget", "0"},
                   {"--budget", "0"}},
        BadCommand{"NothingIsWrong",
                   {"reduce", "DIR/tiny.json", "--detector", "embree"},
                   {"every frame: nothing is wrong in the answer of embree"}}),
    named);

}  // namespace
}  // namespace contactcheck::cli
