#include "reference/results/known_defects.h"

#include <gmock/gmock.h>

#include "core/types/check.h"
#include "reference/scene/catalogue.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::results {
namespace {

using test::Scratch;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const char* const kTwoDefects = R"({
 "defects": [
  {
   "library": "fcl",
   "version": "0.7.0",
   "issue": "502",
   "kind": "spurious",
   "sentence": "near is there",
   "seen": {
     "fcl-aabb": {
      "gap": ["0","1e-9"],
      "tip": ["2"]},
     "fcl-obbrss": {
      "gap": ["0"]}}
  },
  {
   "library": "fcl",
   "version": "0.7.0",
   "issue": "8",
   "kind": "error",
   "sentence": "it hangs",
   "seen": {
     "fcl-aabb": {
      "pile": ["-"]}}
  }
 ]
}
)";

std::string changed(const std::string& from, const std::string& to) {
  std::string text = kTwoDefects;
  return text.replace(text.find(from), from.size(), to);
}

TEST(KnownDefects, AreReadAndWrittenAsTheyAre) {
  const Scratch scratch;
  const auto file = scratch.write("known.json", kTwoDefects);
  const KnownDefects known = read_known_defects(file);
  ASSERT_THAT(known.defects, SizeIs(2));
  EXPECT_THAT(known.defects[0].seen,
              ElementsAre(Sighting{"fcl-aabb", "gap", SightingKind::kSpurious, "0"},
                          Sighting{"fcl-aabb", "gap", SightingKind::kSpurious, "1e-9"},
                          Sighting{"fcl-aabb", "tip", SightingKind::kSpurious, "2"},
                          Sighting{"fcl-obbrss", "gap", SightingKind::kSpurious, "0"}));
  EXPECT_EQ(known.defects[1].kind, SightingKind::kError);
  EXPECT_EQ(known.defects[1].sentence, "it hangs");
  write_known_defects(scratch.folder() / "again.json", known);
  EXPECT_EQ(test::text_of(scratch.folder() / "again.json"), kTwoDefects);
}

TEST(KnownDefects, AreNoneWithoutAFile) {
  EXPECT_THAT(read_known_defects("/nowhere/known.json").defects, IsEmpty());
}

TEST(KnownDefects, ThatCannotBeReadAreRefusedWithThePlace) {
  const std::pair<std::string, const char*> wrong[] = {
      {"{", "known defects"},
      {changed("\"spurious\"", "\"odd\""), "defects[0].kind is \"odd\""},
      {changed("\"issue\": \"502\",", ""), "defects[0].issue"},
      {changed("\"0\",\"1e-9\"", "\"0\",\"0\""), "defects[0].seen.fcl-aabb.gap[1]"},
      {changed("[\"2\"]", "[]"), "defects[0].seen.fcl-aabb.tip"},
      {changed("\"pile\": [\"-\"]", "\"pile\": [3]"), "defects[1].seen.fcl-aabb.pile[0]"}};
  const Scratch scratch;
  for (const auto& [text, place] : wrong) {
    const auto file = scratch.write("known.json", text);
    try {
      read_known_defects(file);
      ADD_FAILURE() << text;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(place));
    }
  }
}

TEST(KnownDefects, HaveOneCauseForEachDetectorSceneAndKind) {
  const Scratch scratch;
  std::string text = changed("\"kind\": \"error\"", "\"kind\": \"spurious\"");
  text.replace(text.find("\"pile\": [\"-\"]"), 13, "\"gap\": [\"1e-3\"]");
  EXPECT_THROW(read_known_defects(scratch.write("known.json", text)), InputError);
  const auto other = text.rfind("0.7.0");
  text.replace(other, 5, "0.8.0");
  EXPECT_NO_THROW(read_known_defects(scratch.write("known.json", text)));
}

TEST(KnownDefects, OfThisRepositoryAreExplained) {
  const KnownDefects known =
      read_known_defects(scene::fixtures_directory() / "hard" / "known-defects.json");
  EXPECT_FALSE(known.defects.empty());
  for (const KnownDefect& d : known.defects) {
    EXPECT_NE(d.issue, kUnexplained) << d.library;
    EXPECT_NE(d.sentence, kUnexplained) << d.library;
  }
}

}  // namespace
}  // namespace contactcheck::results
