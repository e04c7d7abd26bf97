#include "reference/report/formats/contacts_file.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "core/types/semantics.h"
#include "tests/support/shapes.h"

namespace contactcheck::report {
namespace {

using testing::HasSubstr;

// Two triangles without a lattice: a body has the triangle 0, the vertices 0 to 2 and no cell.
Recording two_triangles() {
  Recording out;
  out.scene = "pair";
  const auto shape = make_bare_shape(test::triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  out.bodies = {{"a", shape}, {"b", shape}};
  out.frames = {{shape->mesh.vertices, shape->mesh.vertices}};
  return out;
}

std::string contacts(const std::string& truth, const std::string& detectors) {
  return R"({"schema": "contactcheck-contacts/1", "scene": "pair", "limit": 500, "truth": [)" +
         truth + R"(], "detectors": [)" + detectors + "]}";
}

std::string differences(const std::string& level, const std::string& missed,
                        const std::string& spurious) {
  return R"({"detector": "d", "level": ")" + level +
         R"(", "frames": [{"frame": 0, "missed": {"count": 1, "pairs": [)" + missed +
         R"(]}, "spurious": {"count": 1, "pairs": [)" + spurious + "]}}]}";
}

std::string fault(const std::string& text) {
  try {
    read_contacts(text, "contacts/pair.json", two_triangles());
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ContactsFile, IsGivenBackAsItIs) {
  const std::string text = contacts(R"({"frame": 0, "count": 1, "pairs": [0, 0, 1, 0]})",
                                    differences("triangle", "0, 0, 1, 0", ""));
  EXPECT_EQ(read_contacts(text, "x", two_triangles()), nlohmann::ordered_json::parse(text));
}

TEST(ContactsFile, WithEveryLevelIsRead) {
  for (const Level level : kLevels) {
    std::string missed = "0, 0, 1, 0";
    if (level == Level::kBody || level == Level::kContainment || level == Level::kSelfBody ||
        level == Level::kImpact)
      missed = "0, -1, 1, -1";
    if (level == Level::kNear || level == Level::kSelfNear || level == Level::kImpactVf ||
        level == Level::kImpactSelfVf)
      missed = "0, 2, 1, 0";
    if (level == Level::kImpactEe || level == Level::kImpactSelfEe) missed = "0, 2, 1, 1";
    if (level == Level::kVertex) missed = "0, 2, 1, -1";
    if (level == Level::kBox) missed = "";  // these bodies have no cells
    EXPECT_EQ(fault(contacts("", differences(name_of(level), missed, ""))), "") << name_of(level);
  }
}

TEST(ContactsFile, ThatIsNoneIsRefused) {
  EXPECT_THAT(fault("{"), HasSubstr("contacts \"contacts/pair.json\": it is no JSON"));
  EXPECT_THAT(fault("[]"), HasSubstr("contacts \"contacts/pair.json\": "));
  EXPECT_THAT(fault(R"({"schema": "contactcheck-contacts/2"})"), HasSubstr("its schema is not"));
  EXPECT_THAT(fault(R"({"schema": "contactcheck-contacts/1", "scene": "other"})"),
              HasSubstr("it is not of the scene \"pair\""));
}

TEST(ContactsFile, NamingWhatIsNotRecordedIsRefused) {
  EXPECT_THAT(fault(contacts(R"({"frame": 1, "count": 0, "pairs": []})", "")),
              HasSubstr("frame 1 is not among the 1 recorded ones"));
  EXPECT_THAT(fault(contacts(R"({"frame": 0, "count": 1, "pairs": [0, 0, 2, 0]})", "")),
              HasSubstr("body 2 is not recorded"));
  EXPECT_THAT(fault(contacts(R"({"frame": 0, "count": 1, "pairs": [0, 0, 1, 1]})", "")),
              HasSubstr("body 1 has no element 1"));
  EXPECT_THAT(fault(contacts(R"({"frame": 0, "count": 1, "pairs": [0, -1, 1, 0]})", "")),
              HasSubstr("body 0 has no element -1"));
  EXPECT_THAT(fault(contacts(R"({"frame": 0, "count": 1, "pairs": [0, 0, 1]})", "")),
              HasSubstr("3 numbers, which is no multiple of 4"));
  EXPECT_THAT(fault(contacts("", differences("cell", "", "0, 0, 1, 0"))),
              HasSubstr("body 0 has no element 0"));
  EXPECT_THAT(fault(contacts("", differences("vertex", "0, 3, 1, -1", ""))),
              HasSubstr("body 0 has no element 3"));
  EXPECT_THAT(fault(contacts("", differences("impact-ee", "0, 3, 1, 0", ""))),
              HasSubstr("body 0 has no element 3"));
  EXPECT_THAT(fault(contacts("", differences("edge", "", ""))),
              HasSubstr("the level \"edge\" is not known"));
}

}  // namespace
}  // namespace contactcheck::report
