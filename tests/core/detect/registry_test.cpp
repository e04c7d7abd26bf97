#include "core/detect/registry.h"

#include <gmock/gmock.h>

#include <set>

#include "core/types/check.h"
#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;
using ::testing::IsSupersetOf;

const DetectorCatalog& core_catalog() {
  static const DetectorCatalog catalog = [] {
    DetectorCatalog c;
    register_core_detectors(c);
    return c;
  }();
  return catalog;
}

std::string canonical(const std::string& text) { return core_catalog().parse(text).name; }

std::string error_of(const std::string& text) {
  try {
    core_catalog().parse(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(DetectorCatalog, HoldsTheFamilyWithoutAndWithTriangles) {
  std::vector<std::string> ids;
  for (const DetectorInfo& info : core_catalog().all()) {
    ids.push_back(info.id);
    EXPECT_FALSE(info.summary.empty());
    EXPECT_TRUE(info.absent_because.empty());
    for (const OptionInfo& option : info.options) EXPECT_FALSE(option.help.empty());
  }
  ASSERT_GE(ids.size(), 10u);
  EXPECT_THAT(std::vector<std::string>(ids.begin(), ids.begin() + 10),
              ElementsAre("ffd-grid", "ffd-aabb", "ffd-aabb-sphere", "ffd-aabb-sphere2",
                          "ffd-aabb-sphereN", "ffd-grid+tri", "ffd-aabb+tri", "ffd-aabb-sphere+tri",
                          "ffd-aabb-sphere2+tri", "ffd-aabb-sphereN+tri"));
  EXPECT_THAT(ids, IsSupersetOf({"spatial-hash", "aabb-tree", "sphere-tree", "swept-aabb"}));
}

TEST(DetectorCatalog, DefaultBoundsArePaperAndSafeWithTriangles) {
  for (const std::string& id : test::family()) {
    EXPECT_EQ(core_catalog().parse(id).options.at("bounds"), "paper") << id;
    EXPECT_EQ(core_catalog().parse(id + "+tri").options.at("bounds"), "safe") << id;
  }
}

TEST(DetectorCatalog, ParseCompletesTheOptions) {
  const DetectorSpec spec = core_catalog().parse("ffd-aabb-sphere2+tri:spheres=8");
  EXPECT_EQ(spec.id, "ffd-aabb-sphere2+tri");
  EXPECT_EQ(spec.options, (Options{{"bounds", "safe"},
                                   {"cell", "1"},
                                   {"precision", "double"},
                                   {"radius", "1"},
                                   {"spheres", "8"},
                                   {"table", "0"}}));
}

TEST(DetectorCatalog, CanonicalNamesLeaveDefaultsOutAndSortTheRest) {
  EXPECT_EQ(canonical("ffd-aabb"), "ffd-aabb");
  EXPECT_EQ(canonical("ffd-aabb:bounds=paper"), "ffd-aabb");
  EXPECT_EQ(canonical("ffd-aabb:bounds=safe"), "ffd-aabb:bounds=safe");
  EXPECT_EQ(canonical("ffd-aabb+tri:bounds=safe"), "ffd-aabb+tri");
  EXPECT_EQ(canonical("ffd-aabb+tri:bounds=paper"), "ffd-aabb+tri:bounds=paper");
  EXPECT_EQ(canonical("ffd-aabb-sphere2:table=8,spheres=4,cell=2"),
            "ffd-aabb-sphere2:cell=2,spheres=4,table=8");
  EXPECT_EQ(canonical("ffd-aabb-sphere2:spheres=16"), "ffd-aabb-sphere2");
  EXPECT_EQ(canonical("ffd-aabb-sphereN:spheres=16,levels=3"), "ffd-aabb-sphereN:spheres=16");
}

TEST(DetectorCatalog, NumbersHaveOneSpelling) {
  EXPECT_EQ(canonical("ffd-aabb:cell=1.000"), "ffd-aabb");
  EXPECT_EQ(canonical("ffd-aabb:cell=1e0"), "ffd-aabb");
  EXPECT_EQ(canonical("ffd-aabb:table=-0"), "ffd-aabb");
  EXPECT_EQ(canonical("ffd-aabb:cell=2.50"), "ffd-aabb:cell=2.5");
  EXPECT_EQ(canonical("ffd-aabb:cell=0.1"), "ffd-aabb:cell=0.1");
}

TEST(DetectorCatalog, CanonicalNamesReadBack) {
  for (const char* text : {"ffd-grid:cell=0.30000000000000004", "ffd-aabb:table=100000",
                           "ffd-aabb-sphereN+tri:bounds=paper,levels=8"}) {
    const DetectorSpec spec = core_catalog().parse(text);
    EXPECT_EQ(core_catalog().parse(spec.name).options, spec.options) << spec.name;
    EXPECT_EQ(canonical(spec.name), spec.name);
  }
}

TEST(DetectorCatalog, DefaultsSpelledOtherwiseAreStillLeftOut) {
  DetectorCatalog catalog;
  DetectorInfo info;
  info.id = "other";
  info.options.push_back({"margin", "0.00010", {}, 0.0, 1.0, false, "metres"});
  catalog.add(info);
  EXPECT_EQ(catalog.parse("other:margin=0.0001").name, "other");
  EXPECT_EQ(catalog.parse("other:margin=1e-4").name, "other");
  EXPECT_EQ(catalog.parse("other:margin=0.001").name, "other:margin=0.001");
}

// Plug-ins read them with strtol.
TEST(DetectorCatalog, WholeNumbersHaveDigitsAlone) {
  DetectorCatalog catalog;
  DetectorInfo info;
  info.id = "other";
  info.options.push_back({"most", "1e6", {}, -0x1p60, 0x1p60, true, "how many"});
  info.options.push_back({"many", "1", {}, 0.0, 1e9, true, "how many"});
  info.options.push_back({"length", "1e6", {}, 0.0, 1e300, false, "metres"});
  catalog.add(info);
  EXPECT_EQ(catalog.parse("other").options,
            (Options{{"length", "1e+06"}, {"many", "1"}, {"most", "1000000"}}));
  EXPECT_EQ(catalog.parse("other:most=1000000").name, "other");
  EXPECT_EQ(catalog.parse("other:most=-0").name, "other:most=0");
  EXPECT_EQ(catalog.parse("other:most=-3e9").name, "other:most=-3000000000");
  EXPECT_EQ(catalog.parse("other:most=9007199254740991").name, "other:most=9007199254740991");
  EXPECT_EQ(catalog.parse("other:most=9007199254740992").name, "other:most=9007199254740992");
  EXPECT_EQ(catalog.parse("other:most=1e17").name, "other:most=1e+17");
  EXPECT_EQ(catalog.parse("other:length=2e6").name, "other:length=2e+06");
  try {
    catalog.parse("other:many=1.5");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("a whole number from 0 to 1000000000"));
  }
}

TEST(DetectorCatalog, KnowsDetectorsOfQueriesApartFromThoseOfFrames) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  ImpactDetectorInfo info;
  info.id = "both";
  info.options.push_back({"tolerance", "1e-6", {}, 0.0, 1.0, false, "metres"});
  catalog.add(info);
  EXPECT_EQ(catalog.parse_impact("exact").id, "exact");
  EXPECT_EQ(catalog.parse_impact("both:tolerance=0.5").name, "both:tolerance=0.5");
  EXPECT_THROW(catalog.parse_impact("both:tolerance=2"), InputError);
  EXPECT_EQ(catalog.find_impact("ffd-aabb"), nullptr);
  EXPECT_EQ(catalog.find("exact"), nullptr);
  EXPECT_THROW(catalog.parse_impact("ffd-aabb"), InputError);
  EXPECT_THROW(catalog.parse("both"), InputError);
  DetectorInfo frames;
  frames.id = "both";
  catalog.add(frames);
  EXPECT_EQ(catalog.parse("both").options, Options{}) << "one of each kind may share a name";
}

TEST(DetectorCatalog, UnknownDetectorIsNamed) {
  EXPECT_EQ(error_of("ffd-abab:cell=2"),
            "unknown detector \"ffd-abab\"; did you mean ffd-aabb? `contactcheck list` names all");
  EXPECT_EQ(error_of(""), "unknown detector \"\"; `contactcheck list` names all");
  EXPECT_EQ(error_of("ffd-aabb+TRI"),
            "unknown detector \"ffd-aabb+TRI\"; did you mean ffd-aabb+tri? `contactcheck list` "
            "names all");
}

TEST(DetectorCatalog, UnknownOptionIsNamedWithThoseThatExist) {
  EXPECT_EQ(error_of("ffd-aabb:sphere=2"),
            "detector \"ffd-aabb:sphere=2\": unknown option \"sphere\"; ffd-aabb knows bounds, "
            "cell, table, precision");
  EXPECT_EQ(error_of("ffd-aabb-sphere:spheres=2"),
            "detector \"ffd-aabb-sphere:spheres=2\": unknown option \"spheres\"; ffd-aabb-sphere "
            "knows bounds, cell, table, precision, radius");
  EXPECT_THAT(error_of("ffd-aabb:=2"), ::testing::HasSubstr("unknown option \"\""));
  DetectorCatalog catalog;
  DetectorInfo plain;
  plain.id = "plain";
  catalog.add(plain);
  EXPECT_THROW(catalog.parse("plain:a=1"), InputError);
}

TEST(DetectorCatalog, PartThatIsNoAssignmentIsNamed) {
  EXPECT_EQ(error_of("ffd-aabb:cell"),
            "detector \"ffd-aabb:cell\": \"cell\" is not of the form option=value");
  EXPECT_EQ(error_of("ffd-aabb:"), "detector \"ffd-aabb:\": \"\" is not of the form option=value");
  EXPECT_EQ(error_of("ffd-aabb:cell=2,"),
            "detector \"ffd-aabb:cell=2,\": \"\" is not of the form option=value");
}

TEST(DetectorCatalog, NumberOutOfRangeIsNamedWithItsRange) {
  for (const char* bad : {"0", "-1", "1000.5", "nan", "inf", "1e999", "2x", "", "0x10", " 1"})
    EXPECT_EQ(error_of(std::string("ffd-aabb:cell=") + bad),
              std::string("detector \"ffd-aabb:cell=") + bad + "\": option cell is \"" + bad +
                  "\"; allowed: a number from 0.001 to 1000");
  for (const char* bad : {"1.5", "-1", "16777217", "nan", "inf", "1e300"})
    EXPECT_EQ(error_of(std::string("ffd-aabb:table=") + bad),
              std::string("detector \"ffd-aabb:table=") + bad + "\": option table is \"" + bad +
                  "\"; allowed: a whole number from 0 to 16777216");
  EXPECT_EQ(error_of("ffd-aabb:cell=0.001"), "no error");
  EXPECT_EQ(error_of("ffd-aabb:table=16777216"), "no error");
}

TEST(DetectorCatalog, WordNotAllowedIsNamedWithThoseThatAre) {
  EXPECT_EQ(error_of("ffd-grid:bounds=Safe"),
            "detector \"ffd-grid:bounds=Safe\": option bounds is \"Safe\"; allowed: paper, safe");
}

TEST(DetectorCatalog, OptionGivenTwiceIsNamed) {
  EXPECT_EQ(error_of("ffd-aabb:cell=2,table=4,cell=3"),
            "detector \"ffd-aabb:cell=2,table=4,cell=3\": option cell is given twice");
}

TEST(DetectorCatalogDeathTest, IdsAreUniqueAndAbsentDetectorsAreNotMade) {
  DetectorCatalog catalog;
  DetectorInfo info;
  info.id = "twice";
  info.absent_because = "not built";
  catalog.add(info);
  EXPECT_DEATH(catalog.add(info), "detector ids are unique: twice");
  EXPECT_DEATH(catalog.make(catalog.parse("twice")), "only built detectors are made");
}

TEST(NumberOption, ReadsWhatParseWrote) {
  const DetectorSpec spec = core_catalog().parse("ffd-aabb:cell=0.1,table=100000");
  EXPECT_EQ(number_option(spec.options, "cell"), 0.1);
  EXPECT_EQ(number_option(spec.options, "table"), 100000.0);
}

}  // namespace
}  // namespace contactcheck
