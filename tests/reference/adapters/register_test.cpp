#include "reference/adapters/register.h"

#include <gmock/gmock.h>

namespace contactcheck::adapters {
namespace {

using ::testing::MatchesRegex;

TEST(ReferenceDetectors, AreListedWithOneLineEach) {
  DetectorCatalog catalog;
  register_reference_detectors(catalog);
  for (const char* id : {"fcl-aabb", "fcl-obbrss", "fcl-collide"}) {
    const DetectorInfo* info = catalog.find(id);
    ASSERT_NE(info, nullptr) << id;
    EXPECT_THAT(info->summary, MatchesRegex("FCL[^\n]+")) << id;
    EXPECT_TRUE(info->absent_because.empty()) << id;
  }
  for (const char* id : {"fcl-ccd", "embree-swept"}) {
    const DetectorInfo* info = catalog.find(id);
    ASSERT_NE(info, nullptr) << id;
    EXPECT_THAT(info->summary, MatchesRegex("contact between frames: [^\n]+")) << id;
    EXPECT_TRUE(info->absent_because.empty()) << id;
  }
}

TEST(ReferenceDetectors, NamesParseToThemselves) {
  DetectorCatalog catalog;
  register_reference_detectors(catalog);
  for (const DetectorInfo& info : catalog.all()) EXPECT_EQ(catalog.parse(info.id).name, info.id);
}

// Rows of results are put together by it, and known defects name it.
TEST(LibraryOf, DetectorsOfStepsIsTheirAdapters) {
  EXPECT_EQ(library_of("fcl-ccd"), "fcl");
  EXPECT_EQ(library_of("embree-swept"), "embree");
  EXPECT_EQ(library_of("swept-aabb"), "contactcheck");
}

TEST(LibraryVersions, AreNumbersOfTheBuiltLibraries) {
  const std::map<std::string, std::string> versions = library_versions();
  EXPECT_THAT(versions.at("fcl"), MatchesRegex("0\\.7\\.[0-9]+"));
  EXPECT_THAT(versions.at("eigen"), MatchesRegex("3\\.[0-9]+\\.[0-9]+"));
}

}  // namespace
}  // namespace contactcheck::adapters
