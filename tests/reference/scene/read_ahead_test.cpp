#include "reference/scene/read_ahead.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <vector>

namespace contactcheck::scene {
namespace {

/// Counts what is read; frame f has a node (f, 0, 0).
struct Counted {
  std::shared_ptr<std::vector<int>> reads = std::make_shared<std::vector<int>>(10, 0);
  std::shared_ptr<std::atomic<int>> at_once = std::make_shared<std::atomic<int>>(0);

  FrameReader reader() const {
    return [*this](std::size_t frame) -> ReadAhead::Nodes {
      if (at_once->fetch_add(1) != 0) throw std::logic_error("two at once");
      ++(*reads)[frame];
      at_once->fetch_sub(1);
      if (frame == 7) throw std::runtime_error("damaged");
      return {{Vec3(static_cast<double>(frame), 0, 0)}};
    };
  }
};

double x_of(const ReadAhead::Nodes& nodes) { return nodes[0][0].x(); }

TEST(ReadAhead, ReadsEveryFrameOnceForFramesAndSteps) {
  const Counted counted;
  ReadAhead ahead(counted.reader(), 6);
  for (std::size_t f = 0; f < 6; ++f) {
    EXPECT_EQ(x_of(ahead(f)), static_cast<double>(f));
    if (f > 0) {
      EXPECT_EQ(x_of(ahead(f - 1)), static_cast<double>(f - 1));
    }
    EXPECT_EQ(x_of(ahead(f)), static_cast<double>(f));
  }
  for (std::size_t f = 0; f < 6; ++f) EXPECT_EQ((*counted.reads)[f], 1) << f;
  EXPECT_EQ((*counted.reads)[6], 0) << "there is none";
}

TEST(ReadAhead, AnswersForAnyFrame) {
  const Counted counted;
  ReadAhead ahead(counted.reader(), 10);
  for (const std::size_t f : {4u, 9u, 0u, 0u, 2u, 1u, 5u}) EXPECT_EQ(x_of(ahead(f)), double(f));
  EXPECT_EQ(*counted.reads, (std::vector<int>{1, 1, 1, 0, 1, 2, 0, 0, 0, 1}))
      << "after the first one nothing is read ahead";
}

TEST(ReadAhead, FailsAtTheFrameThatFails) {
  const Counted counted;
  ReadAhead ahead(counted.reader(), 10);
  EXPECT_EQ(x_of(ahead(6)), 6.0);
  EXPECT_THROW(ahead(7), std::runtime_error);
  EXPECT_EQ(x_of(ahead(6)), 6.0);
  EXPECT_THROW(ahead(7), std::runtime_error) << "again";
  EXPECT_EQ(x_of(ahead(8)), 8.0);
}

}  // namespace
}  // namespace contactcheck::scene
