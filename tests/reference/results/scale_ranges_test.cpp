#include "reference/results/scale_ranges.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "core/types/check.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::results {
namespace {

using test::Scratch;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

ScaleRange range(const std::string& detector, const std::string& library,
                 const std::string& version, const std::string& by = "size") {
  ScaleRange out;
  out.detector = detector;
  out.library = library;
  out.version = version;
  out.by = by;
  out.level = "triangle";
  out.from = "0x1p-3";
  out.to = "1e6";
  out.least = "1e-12";
  out.most = "1e12";
  out.right = 9;
  out.cases = 12;
  out.wrong_below = "size-gap@1e-2: 1 missed, 0 spurious of 1 true";
  out.wrong_above = "size-gap@1e9: 0 missed, 4 spurious of 1 true";
  return out;
}

ScaleRange nowhere(const std::string& detector) {
  ScaleRange out = range(detector, "bullet", "2.89");
  out.from = out.to = out.wrong_below = "";
  out.right = 0;
  return out;
}

TEST(ScaleRanges, AreReadAsTheyAreWritten) {
  const Scratch scratch;
  const std::vector<ScaleRange> ranges = {range("a", "fcl", "0.7.0"),
                                          range("a", "fcl", "0.7.0", "distance"), nowhere("b")};
  write_scale_ranges(scratch.folder(), ranges);
  EXPECT_EQ(read_scale_ranges(scratch.folder()), ranges);
  write_scale_ranges(scratch.folder(), {});
  EXPECT_THAT(read_scale_ranges(scratch.folder()), IsEmpty());
  EXPECT_THAT(read_scale_ranges("/nowhere"), IsEmpty());
}

// What `change` makes of a good range is refused, with the field.
void expect_refused(const std::function<void(ScaleRange&)>& change, const std::string& words) {
  const Scratch scratch;
  std::vector<ScaleRange> ranges = {range("a", "fcl", "0.7.0"), range("b", "fcl", "0.7.0")};
  change(ranges[1]);
  write_scale_ranges(scratch.folder(), ranges);
  try {
    read_scale_ranges(scratch.folder());
    ADD_FAILURE() << "is taken; it has to be refused: " << words;
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr(words));
  }
}

TEST(ScaleRanges, AreRefusedWithTheirPlace) {
  expect_refused([](ScaleRange& r) { r.by = "mass"; }, "ranges[1].by is \"mass\"");
  expect_refused([](ScaleRange& r) { r.to = "nan"; }, "ranges[1].to is \"nan\"");
  expect_refused([](ScaleRange& r) { r.to = ""; }, "ranges[1].to is missing");
  expect_refused([](ScaleRange& r) { r.to = "1e-9"; }, "ranges[1].to is below");
  expect_refused([](ScaleRange& r) { r.cases = 0; }, "ranges[1].cases is 0");
  expect_refused([](ScaleRange& r) { r.detector = "a"; }, "ranges[1] has the detector, version");
}

TEST(ScaleRanges, OfARunTakeThePlaceOfEarlierOnes) {
  ScaleRange newer = range("b", "fcl", "0.7.0");
  newer.to = "10";
  const std::vector<ScaleRange> known =
      updated({range("b", "fcl", "0.7.0"), range("b", "fcl", "0.6.1"),
               range("b", "fcl", "0.7.0", "distance")},
              {newer, range("a", "fcl", "0.7.0")});
  EXPECT_THAT(known, ElementsAre(range("a", "fcl", "0.7.0"), range("b", "fcl", "0.6.1"), newer,
                                 range("b", "fcl", "0.7.0", "distance")));
}

TEST(ScaleRanges, AreThoseOfARunsDetectorsInItsVersions) {
  Results results;
  results.libraries = {{"fcl", "0.7.0"}};
  results.runs.resize(3);
  results.runs[0].detector = "fcl-aabb";
  results.runs[1].detector = "ffd-lazy";
  results.runs[2].detector = "fcl-aabb:refit=rebuild";
  const ScaleRange ours = range("ffd-lazy", "contactcheck", "any");
  const ScaleRange theirs = range("fcl-aabb", "fcl", "0.7.0");
  EXPECT_THAT(ranges_of_run(
                  {ours, theirs, range("fcl-aabb", "fcl", "0.6.1", "distance"),
                   range("embree", "embree", "3.13.5"), range("full-refit", "contactcheck", "any")},
                  results),
              ElementsAre(theirs, ours));
}

TEST(ScaleRanges, EndWhereTrianglesAreSmallerLargerOrFartherOut) {
  const ScaleRange sizes = range("a", "fcl", "0.7.0");  // from an eighth to a million
  EXPECT_FALSE(outside(sizes, {0.125, 1e6, 1e30}));
  EXPECT_TRUE(outside(sizes, {std::nextafter(0.125, 0.0), 1e6, 1.0}));
  EXPECT_TRUE(outside(sizes, {0.125, std::nextafter(1e6, 1e7), 1.0}));
  const ScaleRange distances = range("a", "fcl", "0.7.0", "distance");
  EXPECT_FALSE(outside(distances, {0.5, 100.0, 0.5e6}));
  EXPECT_TRUE(outside(distances, {0.5, 100.0, std::nextafter(0.5e6, 1e6)}));
  EXPECT_FALSE(outside(distances, {1e-9, 1e-9, 0.0})) << "it begins at the origin";
  EXPECT_TRUE(outside(nowhere("a"), {1.0, 1.0, 0.0}));
}

}  // namespace
}  // namespace contactcheck::results
