#include "reference/reduce/channel.h"

#include <gtest/gtest.h>

#include <optional>
#include <thread>

namespace contactcheck::reduce {
namespace {

TEST(Channel, CarriesMessagesInOrderWhateverTheyHold) {
  auto [a, b] = Channel::pair();
  const std::string zeros("\0x\0", 3);
  EXPECT_TRUE(a.send(zeros) && a.send("") && a.send("last"));
  EXPECT_EQ(b.receive(), zeros);
  EXPECT_EQ(b.receive(), "");
  EXPECT_EQ(b.receive(), "last");
}

TEST(Channel, CarriesMoreThanASocketHolds) {
  auto ends = Channel::pair();
  const std::string large(std::size_t{8} << 20, 'x');
  std::thread sender([&] { ends.first.send(large); });
  EXPECT_EQ(ends.second.receive(), large);
  sender.join();
}

TEST(Channel, WaitsForAMessageAndNoLonger) {
  auto [a, b] = Channel::pair();
  EXPECT_FALSE(b.waits(std::chrono::milliseconds(1)));
  a.send("x");
  EXPECT_TRUE(b.waits(std::chrono::milliseconds(1000)));
}

TEST(Channel, SaysThatTheOtherSideIsGone) {
  std::optional<Channel> own;
  {
    auto [a, b] = Channel::pair();
    own.emplace(std::move(b));
  }
  EXPECT_TRUE(own->waits(std::chrono::milliseconds(1000)));
  EXPECT_EQ(own->receive(), std::nullopt);
  EXPECT_FALSE(own->send("x"));
}

}  // namespace
}  // namespace contactcheck::reduce
