#include "reference/text/printable.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace contactcheck::text {
namespace {

TEST(PrintableLine, KeepsPlainTextAsItIs) {
  EXPECT_EQ(printable_line("a plain \"line\" ~"), "a plain \"line\" ~");
  EXPECT_EQ(printable_line(""), "");
}

TEST(PrintableLine, TakesTheFirstLineThatIsNotBlank) {
  EXPECT_EQ(printable_line("\n  \r\n\tone\ntwo"), "one");
  EXPECT_EQ(printable_line(" \n\n"), "");
}

TEST(PrintableLine, DropsControlCharactersAndReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printable_line("a\x07"
                           "b\x1b[0m\x7f"
                           "c\td"),
            "ab[0mcd");
  EXPECT_EQ(printable_line("caf\xc3\xa9 \xff \xe9 \xc3"), "caf\xc3\xa9 ? ? ?");
  EXPECT_EQ(printable_line("a\xc2\x9b"
                           "1mb\xc2\xa0"
                           "c"),
            "a1mb\xc2\xa0"
            "c");
  EXPECT_EQ(printable_line(std::string_view("a\0b", 3)), "ab");
}

TEST(PrintableLine, CutsWhatIsTooLong) {
  EXPECT_EQ(printable_line("abcdef", 6), "abcdef");
  EXPECT_EQ(printable_line("abcdefg", 6), "abcdef...");
  EXPECT_EQ(printable_line("abcd\xc3\xa9 f", 5), "abcd...") << "between characters";
  EXPECT_EQ(printable_line(std::string(100'000, 'x')).size(), kLongestForeignText + 3);
}

template <typename Thrown>
std::string text_of(const Thrown& thrown) {
  try {
    throw thrown;
  } catch (...) {
    return current_exception_text();
  }
}

struct Wordless : std::exception {
  const char* what() const noexcept override { return nullptr; }
};

TEST(EndOf, CutsWhatIsTooLongBetweenCharacters) {
  EXPECT_EQ(end_of("abcd", 5), "abcd");
  EXPECT_EQ(end_of("abcde", 5), "abcde");
  EXPECT_EQ(end_of("abcdef", 5), "...bcdef");
  EXPECT_EQ(end_of("ab\u00e9de", 4), "...\u00e9de");
  EXPECT_EQ(end_of("ab\u00e9de", 3), "...de");
}

TEST(CurrentExceptionText, IsWhatTheExceptionSays) {
  EXPECT_EQ(text_of(std::runtime_error("no room\nat all")), "no room");
}

TEST(CurrentExceptionText, NamesTheTypeWhereThereAreNoWords) {
  EXPECT_EQ(text_of(std::runtime_error("")), "threw std::runtime_error without a word");
  EXPECT_EQ(text_of(Wordless{}),
            "threw contactcheck::text::(anonymous namespace)::Wordless without a word");
}

TEST(CurrentExceptionText, NamesTheTypeOfWhatIsNoException) {
  EXPECT_EQ(text_of(1.5), "threw double, which is no std::exception");
  const char* const text = "text";
  EXPECT_EQ(text_of(text), "threw char const*, which is no std::exception");
}

}  // namespace
}  // namespace contactcheck::text
