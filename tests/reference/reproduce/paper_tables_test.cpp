// Reading the paper's numbers: what is read, and the whole sentence of every refusal.
#include <gmock/gmock.h>

#include "tests/reference/reproduce/sample_paper.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::reproduce {
namespace {

using test::replaced;
using test::sample_paper_text;
using test::Scratch;
using test::sentence_of;
using test::tables_of;
using testing::ElementsAre;

TEST(PaperTables, SourceDevicesAndScenesAreRead) {
  const PaperTables tables = tables_of(sample_paper_text());
  EXPECT_THAT(tables.source.authors, ElementsAre("Doe", "Roe"));
  EXPECT_EQ(tables.source.title, "A title");
  EXPECT_EQ(tables.source.journal, "A journal 12");
  EXPECT_EQ(tables.source.year, 2001u);
  EXPECT_EQ(tables.source.doi, "10.1/x");
  ASSERT_EQ(tables.devices.size(), 2u);
  EXPECT_EQ(tables.devices[1].name, "tin");
  EXPECT_EQ(tables.devices[1].average_frame_rate.value, 9.0);
  ASSERT_EQ(tables.scenes.size(), 1u);
  const PaperScene& scene = tables.scenes[0];
  EXPECT_EQ(scene.id, "s");
  EXPECT_EQ(scene.objects, 2u);
  EXPECT_EQ(scene.objects_in_text, 2u);
  EXPECT_EQ(scene.vertices, 20u);
  EXPECT_EQ(scene.triangles, 32u);
  EXPECT_EQ(scene.cells, 7u);
}

TEST(PaperTables, StepTimesAreRead) {
  const PaperTables tables = tables_of(replaced(
      sample_paper_text(), R"("mss": 10, "cell": 1, "test": 20, "response": 4, "total": 40)",
      R"("mss": 11, "cell": 2, "test": 21, "response": 3, "total": 41)"));
  EXPECT_EQ(tables.table_1.name, "Table 1");
  EXPECT_EQ(tables.table_1.device, "tin");
  EXPECT_EQ(tables.table_3.name, "Table 3");
  EXPECT_EQ(tables.table_3.before, "one");
  EXPECT_EQ(tables.table_3.after, "two");
  EXPECT_THAT(tables.table_3.scenes(), ElementsAre("s"));
  const PaperRow& row = tables.table_3.row("s", "two");
  EXPECT_EQ(row.mss, 11.0);
  EXPECT_EQ(row.cell, 2.0);
  EXPECT_EQ(row.test, 21.0);
  EXPECT_EQ(row.response, 3.0);
  EXPECT_EQ(row.total, 41.0);
  EXPECT_EQ(row.steps(), 37.0);
}

TEST(PaperTables, AClaimInWordsHasNoValue) {
  const PaperClaim claim = tables_of(sample_paper_text()).claims.cell_share;
  EXPECT_EQ(claim.says, "next to nothing");
  EXPECT_EQ(claim.value, std::nullopt);
  EXPECT_TRUE(claim.holds(0.0));
  EXPECT_TRUE(claim.holds(5.0));
  EXPECT_FALSE(claim.holds(5.001));
}

TEST(PaperTables, ThoseThatComeWithContactcheckLoad) {
  const PaperTables tables = test::real_paper();
  EXPECT_EQ(tables.devices.size(), 4u);
  EXPECT_THAT(tables.table_1.scenes(), ElementsAre("alphabet", "dinosaur"));
  EXPECT_THAT(tables.table_3.scenes(), ElementsAre("alphabet", "dinosaur", "rabbit", "teapot"));
  EXPECT_EQ(tables.scenes.size(), tables.table_3.scenes().size());
}

struct Defect {
  std::string name, from, to, sentence;  // the sentence after: paper file "PATH"
};
void PrintTo(const Defect& p, std::ostream* out) { *out << p.name; }

class BadPaper : public ::testing::TestWithParam<Defect> {};

TEST_P(BadPaper, IsRefusedWithOneSentence) {
  const Defect& defect = GetParam();
  const Scratch scratch;
  const std::filesystem::path file =
      scratch.write("tables.json", replaced(sample_paper_text(), defect.from, defect.to));
  EXPECT_EQ(sentence_of([&] { load_paper_tables(file); }),
            "paper file \"" + file.string() + "\"" + defect.sentence);
}

std::string named(const ::testing::TestParamInfo<Defect>& test) { return test.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Head, BadPaper,
    ::testing::Values(
        Defect{"UnknownKey", R"("table_2")", R"("tables": 1, "table_2")",
               ": tables is not a known key; allowed here: source, devices, table_1, table_2, "
               "table_3, claims."},
        Defect{"KeyTwice", R"("doi": "10.1/x")", R"("year": 2001)",
               ": source.year is given twice."},
        Defect{"NoDoi", R"(, "doi": "10.1/x")", "", ": source.doi is missing."},
        Defect{"NoAuthors", R"(["Doe", "Roe"])", "[]",
               ": source.authors is an array of 0; it must be an array of at least 1."},
        Defect{"Year", "2001", "20001",
               ": source.year is 20001; it must be a whole number from 1900 to 2100."},
        Defect{"DeviceTwice", R"("name": "tin")", R"("name": "box")",
               ": devices[1].name is \"box\"; it must be named once only."},
        Defect{"EmptyText", R"("title": "A title")", R"("title": "")",
               ": source.title is \"\"; it must be a text that is not empty."}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Tables, BadPaper,
    ::testing::Values(
        Defect{"UnknownDevice", R"("device": "box")", R"("device": "bin")",
               ": table_3.device is \"bin\"; it must be one of box, tin."},
        Defect{"UnknownScene", R"({"scene": "s", "method": "none")",
               R"({"scene": "t", "method": "none")",
               ": table_1.rows[0].scene is \"t\"; it must be one of s."},
        Defect{"UnknownMethod", R"("method": "none")", R"("method": "three")",
               ": table_1.rows[0].method is \"three\"; it must be one of none, one."},
        Defect{"MethodsEqual", R"("before": "one", "after": "two")",
               R"("before": "one", "after": "one")",
               ": table_3.after is \"one\"; it must be another method than before."},
        Defect{"RowTwice", R"("method": "none", "mss")", R"("method": "one", "mss")",
               ": table_1.rows[1] is a second row of one on s."},
        Defect{"RowMissing", R"(,
    {"scene": "s", "method": "two", "mss": 10, "cell": 1, "test": 20, "response": 4, "total": 40})",
               "", ": table_3.rows has no row of two on s."},
        Defect{"TimeZero", R"("cell": 1,)", R"("cell": 0,)",
               ": table_3.rows[0].cell is 0; it must be a number above 0 and at most 3600000."},
        Defect{"TimeTooLong", R"("mss": 10)", R"("mss": 3600001)",
               ": table_1.rows[0].mss is 3600001; it must be a number above 0 and at most "
               "3600000."},
        Defect{"TimeIsText", R"("response": 4)", R"("response": "4")",
               ": table_3.rows[0].response is \"4\"; it must be a number above 0 and at most "
               "3600000."},
        Defect{"TotalIsTheTest", R"("total": 40)", R"("total": 20)",
               ": table_3.rows[1].total is 20; it must be a number above 20 and at most 3600000."},
        Defect{"SceneTwice", R"("cells": 7})",
               R"("cells": 7}, {"scene": "s", "objects": 1, "vertices": 4, "triangles": 4,
                  "cells": 1})",
               ": table_2[1].scene is \"s\"; it must be named once only."},
        Defect{"HalfAVertex", R"("vertices": 20)", R"("vertices": 20.5)",
               ": table_2[0].vertices is 20.5; it must be a whole number from 1 to 1000000000."}),
    named);

INSTANTIATE_TEST_SUITE_P(
    Claims, BadPaper,
    ::testing::Values(
        Defect{"HighBelowLow", R"("low": 45, "high": 55)", R"("low": 45, "high": 44)",
               ": claims.test_share.high is 44; it must be a number of at least 45 and at most "
               "1e+06."},
        Defect{"ValueOutside", R"("value": 50)", R"("value": 56)",
               ": claims.test_share.value is 56; it must be a number of at least 45 and at most "
               "55."},
        Defect{"BestDevice", R"("best_device": "box")", R"("best_device": "bin")",
               ": claims.best_device is \"bin\"; it must be one of box, tin."},
        Defect{"BestScene", R"("best_scene": "s")", R"("best_scene": "t")",
               ": claims.best_scene is \"t\"; it must be one of s."},
        Defect{"NoWords", R"("says": "half", )", "", ": claims.test_share.says is missing."}),
    named);

TEST(PaperTables, AMissingFileIsNamed) {
  const Scratch scratch;
  const std::string sentence =
      sentence_of([&] { load_paper_tables(scratch.folder() / "none.json"); });
  EXPECT_THAT(sentence, testing::HasSubstr("paper file"));
  EXPECT_THAT(sentence, testing::HasSubstr("none.json"));
}

}  // namespace
}  // namespace contactcheck::reproduce
