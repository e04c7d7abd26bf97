#include "reference/results/known_defects.h"

#include <gmock/gmock.h>

#include <string>

#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::results {
namespace {

using test::Scratch;
using testing::ElementsAre;
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

}  // namespace
}  // namespace contactcheck::results
