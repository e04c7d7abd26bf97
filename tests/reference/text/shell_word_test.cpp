#include "reference/text/shell_word.h"

#include <gmock/gmock.h>

namespace contactcheck::text {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(InShell, WordIsQuotedOnlyWhereItHasToBe) {
  EXPECT_EQ(in_shell("ffd-aabb:cell=3"), "ffd-aabb:cell=3");
  EXPECT_EQ(in_shell("two words"), "'two words'");
  EXPECT_EQ(in_shell("it's"), "'it'\\''s'");
  EXPECT_EQ(in_shell(""), "''");
}

TEST(ShellWords, OfAQuotedWordAreThatWord) {
  for (const std::string word :
       {"plain", "two words", "it's", "", "\"", "a\\b\\\\", "$HOME `id` $(id)", "/srv/Größe/x.py",
        " leading and trailing ", "line\nbreak", "'\"'\"'"})
    EXPECT_THAT(shell_words("run " + in_shell(word) + " " + in_shell(word)),
                ElementsAre("run", word, word));
}

TEST(ShellWords, AreThoseOfAShell) {
  EXPECT_THAT(shell_words(" python3\t-B  mine.py\n"), ElementsAre("python3", "-B", "mine.py"));
  EXPECT_THAT(shell_words(R"(a\ b "c d"'e f'g "\"\\\$\a" '\')"),
              ElementsAre("a b", "c de fg", R"("\$\a)", "\\"));
  EXPECT_THAT(shell_words("python3 '' mine.py"), ElementsAre("python3", "", "mine.py"));
  EXPECT_THAT(shell_words("  "), IsEmpty());
}

TEST(ShellWords, OfWhatNoShellTakesEndWithTheText) {
  EXPECT_THAT(shell_words("a 'b c"), ElementsAre("a", "b c"));
  EXPECT_THAT(shell_words("a b\\"), ElementsAre("a", "b\\"));
}

}  // namespace
}  // namespace contactcheck::text
