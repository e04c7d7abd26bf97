#include "reference/scene/catalogue.h"

#include <gmock/gmock.h>

namespace contactcheck::scene {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FixturesFolder, OfAnInstalledProgramStandsBesideIt) {
  EXPECT_EQ(installed_fixtures("/opt/tools/bin/contactcheck"),
            "/opt/tools/share/contactcheck/fixtures");
}

TEST(FixturesFolder, SharedDataIsLookedForInOrder) {
  EXPECT_THAT(
      shared_fixtures("/usr/local/share:/usr/share"),
      ElementsAre("/usr/local/share/contactcheck/fixtures", "/usr/share/contactcheck/fixtures"));
}

TEST(FixturesFolder, EmptyAndRelativeDataFoldersAreLeftOut) {
  EXPECT_THAT(shared_fixtures("::share:/data:"), ElementsAre("/data/contactcheck/fixtures"));
  EXPECT_THAT(shared_fixtures(""), IsEmpty());
}

}  // namespace
}  // namespace contactcheck::scene
