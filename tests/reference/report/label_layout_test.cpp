#include "reference/report/pictures/label_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace contactcheck::report {
namespace {

using Places = std::vector<std::optional<LabelPlace>>;

constexpr Box kArea{50, 40, 800, 400};
constexpr double kRadius = 5.0;

double within(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
}

// Half of them in a heap.
std::vector<LabelledPoint> random_points(std::mt19937& random, std::size_t count) {
  std::vector<LabelledPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const bool heap = i % 2 == 0;
    points.push_back({heap ? within(random, 300, 320) : within(random, 60, 840),
                      heap ? 430.0 : within(random, 50, 430), within(random, 20, 140), 12});
  }
  return points;
}

Box marker_of(const LabelledPoint& p) {
  return {p.x - kRadius, p.y - kRadius, 2 * kRadius, 2 * kRadius};
}

void expect_apart(const std::vector<LabelledPoint>& points, const Places& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    const Box& box = places[i]->box;
    EXPECT_TRUE(box.x >= kArea.x && box.right() <= kArea.right() && box.y >= kArea.y &&
                box.bottom() <= kArea.bottom());
    for (const LabelledPoint& p : points) EXPECT_FALSE(overlap(box, marker_of(p))) << i;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(places[j] && overlap(box, places[j]->box)) << i << " and " << j;
  }
}

TEST(LabelLayout, NamesCoverNeitherEachOtherNorPointsNorTheEdge) {
  std::mt19937 random(5);
  std::size_t placed = 0;
  for (int round = 0; round < 4; ++round) {
    const auto points = random_points(random, 20);
    const Places places = place_labels(points, kArea, kRadius);
    ASSERT_EQ(places.size(), points.size());
    expect_apart(points, places);
    for (const auto& place : places) placed += place.has_value();
  }
  EXPECT_EQ(placed, 80u) << "there is room for all";
}

TEST(LabelLayout, KeepsTheSizeOfNames) {
  const Places places = place_labels({{400, 200, 77, 12}}, kArea, kRadius);
  EXPECT_EQ(places[0]->box.width, 77);
  EXPECT_EQ(places[0]->box.height, 12);
}

TEST(LabelLayout, SingleNameStandsBesideItsPointWithoutALeader) {
  const Places places = place_labels({{400, 200, 77, 12}}, kArea, kRadius);
  EXPECT_NEAR(places[0]->box.x, 400 + kRadius, 4);
  EXPECT_FALSE(places[0]->leader);
}

TEST(LabelLayout, LeadersJoinBoxesThatStandAway) {
  const std::vector<LabelledPoint> heap(6, {400, 200, 100, 12});
  for (const auto& place : place_labels(heap, kArea, kRadius)) {
    ASSERT_TRUE(place);
    const Box& b = place->box;
    const double dx = std::max({b.x - 400, 400 - b.right(), 0.0}),
                 dy = std::max({b.y - 200, 200 - b.bottom(), 0.0});
    EXPECT_EQ(place->leader.has_value(), std::hypot(dx, dy) > kRadius + 9);
    if (!place->leader) continue;
    EXPECT_NEAR(std::hypot(place->leader->x - 400, place->leader->y - 200), std::hypot(dx, dy),
                1e-9);
  }
}

TEST(LabelLayout, KeepsALineFree) {
  const PictureSegment line{{0, 200}, {900, 200}};
  const Places places = place_labels({{400, 200, 100, 12}}, kArea, kRadius, {line});
  EXPECT_TRUE(places[0]->box.bottom() < 200 || places[0]->box.y > 200);
}

TEST(LabelLayout, GivesNoPlaceWhereThereIsNoRoom) {
  EXPECT_FALSE(place_labels({{400, 200, 900, 12}}, kArea, kRadius)[0]);
  EXPECT_TRUE(place_labels({}, kArea, kRadius).empty());
}

TEST(LabelLayout, IsTheSameForTheSamePoints) {
  std::mt19937 random(9);
  const auto points = random_points(random, 16);
  const Places once = place_labels(points, kArea, kRadius),
               again = place_labels(points, kArea, kRadius);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(once[i]->box.x, again[i]->box.x);
    EXPECT_EQ(once[i]->box.y, again[i]->box.y);
  }
}

}  // namespace
}  // namespace contactcheck::report
