#include "core/types/count.h"

#include <gmock/gmock.h>

namespace contactcheck {
namespace {

TEST(In32Bits, KeepsWhatFitsAndRefusesTheNextCount) {
  EXPECT_EQ(in_32_bits<InputError>(0, "cells"), 0u);
  EXPECT_EQ(in_32_bits<InputError>(kMostNumbered - 1, "cells"), 4294967294u);
  EXPECT_EQ(in_32_bits<InputError>(kMostNumbered, "cells"), 4294967295u);
  EXPECT_THROW(in_32_bits<InputError>(kMostNumbered + 1, "cells"), InputError);
  EXPECT_THROW(in_32_bits<RefusedInput>(~std::uint64_t{0}, "cells"), RefusedInput);
}

TEST(In32Bits, NamesCountAndLimit) {
  try {
    in_32_bits<InputError>(kMostNumbered + 1, "cells in the labels of triangles");
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "there are 4294967296 cells in the labels of triangles; at most 4294967295 can be "
                 "numbered");
  }
}

}  // namespace
}  // namespace contactcheck
