#include "reference/report/markdown.h"

#include <gmock/gmock.h>

#include "tests/reference/report/sample_results.h"

namespace contactcheck {
namespace {

using test::sample_results;
using testing::HasSubstr;
using testing::Not;

TEST(Markdown, PRINT) { std::puts(markdown_report(sample_results()).c_str()); }

}  // namespace
}  // namespace contactcheck
