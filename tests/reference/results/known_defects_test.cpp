#include "reference/results/known_defects.h"

#include <gmock/gmock.h>

#include <span>
#include <string>
#include <utility>

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
using testing::Pair;
using testing::SizeIs;

const char* const kTwoDefects = R"json({
 "defects": [
  {
   "library": "fcl",
   "version": "0.7.0",
   "where": "overlap()",
   "upstream": "https://example.org/issues/502",
   "kind": "spurious",
   "sentence": "near is there",
   "seen": {
     "fcl-aabb": {
      "gap": {"0":1,"1e-9":1000000},
      "tip": {"2":3}},
     "fcl-obbrss": {
      "gap": {"0":2}}}
  },
  {
   "library": "fcl",
   "version": "0.7.0",
   "where": "loop()",
   "upstream": null,
   "kind": "error",
   "sentence": "it hangs",
   "seen": {
     "fcl-aabb": {
      "pile": {"-":1}}}
  }
 ]
}
)json";

const char* const kReading = R"({
 "readings": [
  {
   "where": "section 3",
   "kind": "missed",
   "sentence": "nodes stand for the surface",
   "seen": {
     "ffd-aabb": {
      "gap": {"0":7}}}
  }
 ]
}
)";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// The folder's files in the place of those before.
KnownDefects read(const Scratch& scratch, const std::string& defects,
                  const std::string& readings = kReading) {
  scratch.write("known-defects.json", defects);
  scratch.write("readings.json", readings);
  return read_known_defects(scratch.folder());
}

TEST(KnownDefects, AreReadAndWrittenAsTheyAre) {
  const Scratch scratch;
  const KnownDefects known = read(scratch, kTwoDefects);
  ASSERT_THAT(known.defects, SizeIs(3));
  EXPECT_THAT(
      known.defects[0].seen,
      ElementsAre(Pair(Sighting{"fcl-aabb", "gap", SightingKind::kSpurious, "0"}, 1),
                  Pair(Sighting{"fcl-aabb", "gap", SightingKind::kSpurious, "1e-9"}, 1'000'000),
                  Pair(Sighting{"fcl-aabb", "tip", SightingKind::kSpurious, "2"}, 3),
                  Pair(Sighting{"fcl-obbrss", "gap", SightingKind::kSpurious, "0"}, 2)));
  EXPECT_EQ(known.defects[0].where, "overlap()");
  EXPECT_EQ(known.defects[0].upstream, "https://example.org/issues/502");
  EXPECT_EQ(known.defects[1].upstream, std::nullopt);
  EXPECT_EQ(known.defects[1].kind, SightingKind::kError);
  EXPECT_EQ(known.defects[1].sentence, "it hangs");
  EXPECT_FALSE(known.defects[1].is_reading());
  EXPECT_TRUE(known.defects[2].is_reading());
  EXPECT_EQ(known.defects[2].version, kOwnVersion);
  const Scratch again;
  write_known_defects(again.folder(), known);
  EXPECT_EQ(test::text_of(again.folder() / "known-defects.json"), kTwoDefects);
  EXPECT_EQ(test::text_of(again.folder() / "readings.json"), kReading);
}

TEST(KnownDefects, AreNoneWithoutFiles) {
  EXPECT_THAT(read_known_defects("/nowhere").defects, IsEmpty());
}

TEST(KnownDefects, OfNothingAreReadAsTheyAreWritten) {
  const Scratch scratch;
  write_known_defects(scratch.folder(), {});
  EXPECT_THAT(read_known_defects(scratch.folder()).defects, IsEmpty());
}

/// Texts, and what a refusal of each says.
void expect_refusals(std::span<const std::pair<std::string, const char*>> wrong) {
  const Scratch scratch;
  for (const auto& [text, sentence] : wrong) {
    try {
      read(scratch, text);
      ADD_FAILURE() << text;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(sentence));
    }
  }
}

TEST(KnownDefects, ThatCannotBeReadAreRefusedWithThePlace) {
  const std::string good = kTwoDefects;
  const std::pair<std::string, const char*> wrong[] = {
      {"{", "known defects"},
      {changed(good, "\"spurious\"", "\"odd\""),
       "defects[0].kind is \"odd\"; it must be one of missed, spurious, error, refused."},
      {changed(good, "\"where\": \"overlap()\",", ""), "defects[0].where is missing"},
      {changed(good, "\"upstream\": null,", ""), "defects[1].upstream is missing"},
      {changed(good, "null", "\"502\""), "defects[1].upstream is \"502\"; it must be the address"},
      {changed(good, "\"library\": \"fcl\"", "\"library\": \"contactcheck\""),
       "defects[0].library is \"contactcheck\"; it must be another's"},
      {changed(good, "\"0\":1,", "\"0\":1,\"0\":2,"), "defects[0].seen.fcl-aabb.gap.0 is given"},
      {changed(good, "\"2\":3", "\"2\":0"), "defects[0].seen.fcl-aabb.tip.2 is 0"},
      {changed(good, "\"2\":3", "\"2\":true"), "defects[0].seen.fcl-aabb.tip.2 is true"},
      {changed(good, "{\"2\":3}", "{}"), "defects[0].seen.fcl-aabb.tip is an object"},
      {changed(good, "\"-\":1", "\"-\":2"),
       "defects[1].seen.fcl-aabb.pile.- is 2; it must be a whole number from 1 to 1."}};
  expect_refusals(wrong);
}

TEST(KnownDefects, OfTheFormWithoutCountsAreRefused) {
  const std::pair<std::string, const char*> wrong[] = {
      {changed(kTwoDefects, "\"where\": \"overlap()\"", "\"issue\": \"502\""),
       "defects[0].issue is of the list without counts; \"where\" and \"upstream\" must stand in "
       "its place."},
      {changed(kTwoDefects, "{\"2\":3}", "[\"2\"]"),
       "defects[0].seen.fcl-aabb.tip lists cases without their counts; it must be an object of "
       "counts by case."}};
  expect_refusals(wrong);
}

TEST(KnownDefects, HaveOneCauseForEachDetectorSceneAndKind) {
  const Scratch scratch;
  std::string text = changed(kTwoDefects, "\"kind\": \"error\"", "\"kind\": \"spurious\"");
  text = changed(text, "\"pile\": {\"-\":1}", "\"gap\": {\"1e-3\":1}");
  EXPECT_THROW(read(scratch, text), InputError);
  const auto other = text.rfind("0.7.0");
  text.replace(other, 5, "0.8.0");
  EXPECT_NO_THROW(read(scratch, text));
}

TEST(KnownDefects, OfThisRepositoryAreExplained) {
  const KnownDefects known = read_known_defects(scene::fixtures_directory() / "hard");
  std::size_t readings = 0;
  for (const KnownDefect& d : known.defects) {
    EXPECT_NE(d.where, kUnexplained) << d.library;
    EXPECT_NE(d.sentence, kUnexplained) << d.library;
    readings += d.is_reading();
  }
  EXPECT_GT(readings, 0u);
  EXPECT_LT(readings, known.defects.size());
}

}  // namespace
}  // namespace contactcheck::results
