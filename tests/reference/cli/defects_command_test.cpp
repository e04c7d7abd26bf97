// contactcheck defects, on a family of hard cases and a list of the test's own.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/results/known_defects.h"
#include "reference/scene/catalogue.h"
#include "tests/reference/cli/program.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::contactcheck_program;
using test::Environment;
using test::Outcome;
using test::Scratch;
using testing::HasSubstr;

// Two segments in one plane, apart: FCL takes them for a contact at every value.
constexpr const char* kFamily = "hard-two-segments-plane";

class DefectsCommand : public testing::Test {
 protected:
  DefectsCommand()
      : fixtures_(own_fixtures(scratch_)), environment_("CONTACTCHECK_FIXTURES", fixtures_) {}

  // Fixtures as they are, but for the list of known defects.
  static fs::path own_fixtures(const Scratch& scratch) {
    const fs::path original = scene::fixtures_directory(), copy = scratch.folder() / "fixtures";
    fs::create_directories(copy / "hard");
    for (const char* folder : {"scenes", "suites", "hard/families"})
      fs::create_directory_symlink(original / folder, copy / folder);
    fs::create_symlink(original / "results.schema.json", copy / "results.schema.json");
    return copy;
  }

  json run() const {
    const Outcome outcome = contactcheck_program(
        {"run", kFamily, "--detector", "fcl-aabb", "--no-timing", "--out", out().string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(test::text_of(results()));
  }
  Outcome defects(std::vector<std::string> flags = {}) const {
    flags.insert(flags.begin(), {"defects", results().string()});
    return contactcheck_program(flags);
  }
  fs::path out() const { return scratch_.folder() / "out"; }
  fs::path results() const { return out() / "results.json"; }
  fs::path hard() const { return fixtures_ / "hard"; }

  Scratch scratch_;
  fs::path fixtures_;
  Environment environment_;
};

TEST_F(DefectsCommand, SaysWhatIsNotListed) {
  const json unlisted = run().at("known_defects").at("unlisted");
  ASSERT_EQ(unlisted.size(), 1u);
  EXPECT_EQ(unlisted[0].at("detector"), "fcl-aabb");
  EXPECT_EQ(unlisted[0].at("kind"), "spurious");
  const Outcome outcome = defects();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("shown, not listed:\n  fcl-aabb  " + std::string(kFamily) +
                                     "  spurious  0: 1; 0.1: 1;"));
  EXPECT_FALSE(fs::exists(hard() / "known-defects.json")) << "it is written when asked for alone";
}

TEST_F(DefectsCommand, WritesWhatShowsAndIsThenContent) {
  run();
  EXPECT_EQ(defects({"--write"}).exit_code, 0);
  const results::KnownDefects known = results::read_known_defects(hard());
  ASSERT_EQ(known.defects.size(), 1u);
  EXPECT_EQ(known.defects[0].library, "fcl");
  EXPECT_EQ(known.defects[0].where, results::kUnexplained);
  const Outcome outcome = defects();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("show as listed, 0 with another count and 0 do not. "
                                     "0 show that are not listed.\n"));
  EXPECT_EQ(run().at("known_defects").at("unlisted"), json::array());
}

TEST_F(DefectsCommand, SaysWhatDoesNotShow) {
  run();
  defects({"--write"});
  results::KnownDefects known = results::read_known_defects(hard());
  results::Sighting mended = known.defects[0].seen.begin()->first;
  mended.kind = known.defects[0].kind = results::SightingKind::kMissed;
  known.defects[0].seen = {{mended, 5}};
  results::write_known_defects(hard(), known);
  const Outcome outcome = defects();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("listed, not shown:\n  fcl-aabb  " + std::string(kFamily) +
                                     "  missed  " + mended.value + ": 5\n"));
}

TEST_F(DefectsCommand, SaysWhichCountChanged) {
  run();
  defects({"--write"});
  results::KnownDefects known = results::read_known_defects(hard());
  const results::Sighting more = known.defects[0].seen.begin()->first;
  known.defects[0].seen[more] = 40;
  results::write_known_defects(hard(), known);
  const Outcome outcome = defects();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out,
              HasSubstr("count changed (listed -> shown):\n  fcl-aabb  " + std::string(kFamily) +
                        "  spurious  " + more.value + ": 40 -> 1\n"));
  EXPECT_EQ(run().at("known_defects").at("changed").size(), 1u);
}

// One that is not listed, and a listed one that does not show any more.
TEST_F(DefectsCommand, WatchesRefusals) {
  json results = run();
  defects({"--write"});
  json& row = results.at("runs").at(0);
  row = {{"scene", kFamily},          {"detector", "fcl-aabb"},     {"status", "refused"},
         {"message", "not this one"}, {"frames", row.at("frames")}, {"contact_frames", 0},
         {"failed_frame", 2}};
  scratch_.write("out/results.json", results.dump());
  Outcome outcome = defects();
  EXPECT_EQ(outcome.exit_code, 1) << "it refuses what it answered";
  EXPECT_THAT(outcome.out,
              HasSubstr("shown, not listed:\n  fcl-aabb  " + std::string(kFamily) + "  refused  "));
  EXPECT_EQ(defects({"--write"}).exit_code, 0) << outcome.out;
  EXPECT_EQ(defects().exit_code, 0);
  run();
  outcome = defects();
  EXPECT_EQ(outcome.exit_code, 1) << "it answers what it refused";
  EXPECT_THAT(outcome.out,
              HasSubstr("listed, not shown:\n  fcl-aabb  " + std::string(kFamily) + "  refused  "));
}

TEST_F(DefectsCommand, ABadListEndsARunBeforeItStarts) {
  scratch_.write("fixtures/hard/known-defects.json", "{}");
  const Outcome outcome = contactcheck_program({"run", kFamily, "--out", out().string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("known-defects.json\": defects"));
  EXPECT_FALSE(fs::exists(results()));
}

}  // namespace
}  // namespace contactcheck::cli
