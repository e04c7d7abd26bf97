#include "reference/report/terminal.h"

#include <gmock/gmock.h>

#include "tests/reference/report/sample_results.h"

namespace contactcheck {
namespace {

using test::sample_results;

TEST(Terminal, PRINT) { std::puts(terminal_tables(sample_results(), false).c_str()); }

}  // namespace
}  // namespace contactcheck
