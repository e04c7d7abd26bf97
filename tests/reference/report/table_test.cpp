#include "reference/report/tables/table.h"

#include <gmock/gmock.h>

namespace contactcheck::report {
namespace {

using testing::ElementsAre;

std::vector<std::string> titles_of(const TitledTable& table) {
  std::vector<std::string> out;
  for (const Column& column : table.columns) out.push_back(column.title);
  return out;
}

TitledTable times(const std::string& ms, const std::string& over) {
  return {"",
          "",
          {{.title = "detector", .left = true},
           {.title = "question", .left = true, .role = Role::kOfTimes},
           {.title = "ms", .left = false, .role = Role::kTime},
           {.title = "vs fcl", .left = false, .role = Role::kTime},
           {.title = "missed", .left = false}},
          {{"a", "body", ms, over, "0"}, {"b", "error", "", "", ""}}};
}

TEST(Table, KeepsItsColumnsWhereARowHasATime) {
  TitledTable table = times("0.5", "-");
  leave_out_untimed(table);
  EXPECT_THAT(titles_of(table), ElementsAre("detector", "question", "ms", "vs fcl", "missed"));
}

TEST(Table, ErasesNoMessage) {
  TitledTable table = times("0.5", "2x");
  table.rows[1] = {"b", "error", "it died", "", ""};
  erase_column(2, table);
  EXPECT_THAT(table.rows[0], ElementsAre("a", "body", "2x", "0"));
  EXPECT_THAT(table.rows[1], ElementsAre("b", "error", "it died", ""));
}

TEST(Table, WithoutTimesLeavesOutWhatIsAboutThem) {
  TitledTable table = times("-", "-");
  leave_out_untimed(table);
  EXPECT_THAT(titles_of(table), ElementsAre("detector", "missed"));
  EXPECT_THAT(table.rows[0], ElementsAre("a", "0"));
  EXPECT_THAT(table.rows[1], ElementsAre("b", "error"));
}

}  // namespace
}  // namespace contactcheck::report
