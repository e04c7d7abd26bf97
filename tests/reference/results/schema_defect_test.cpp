#include "reference/results/schema_defect.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

namespace contactcheck::results {
namespace {

using Json = nlohmann::ordered_json;

const Json& schema() {
  static const Json schema = [] {
    std::ifstream in(CONTACTCHECK_FIXTURES "/results.schema.json");
    return Json::parse(in);
  }();
  return schema;
}

TEST(SchemaDefect, DocumentOfAnotherKind) {
  EXPECT_EQ(schema_defect(schema(), Json::array()),
            "the document is an array of 0; it must be of type object");
}

TEST(SchemaDefect, ConstantThatIsAnother) {
  EXPECT_EQ(schema_defect({{"properties", {{"schema", {{"const", "a/2"}}}}}}, {{"schema", "else"}}),
            "schema is \"else\"; it must be \"a/2\"");
}

TEST(SchemaDefect, KeywordThatNothingChecksIsRefusedWhereverItStands) {
  const Json wrong[] = {{{"maxItems", 3}},
                        {{"items", {{"pattern", "a"}}}},
                        {{"properties", {{"a", {{"format", "b"}}}}}},
                        {{"anyOf", {{{"not", true}}}}},
                        {{"$defs", {{"unused", {{"multipleOf", 2}}}}}}};
  for (const Json& schema : wrong)
    EXPECT_THROW(schema_defect(schema, Json::array()), std::invalid_argument) << schema;
  EXPECT_EQ(schema_defect({{"properties", {{"format", {{"type", "string"}}}}}},
                          {{"format", "a member, and no keyword"}}),
            "");
}

}  // namespace
}  // namespace contactcheck::results
