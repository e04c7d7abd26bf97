#include "core/broad/spatial_hash.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/types/check.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using ::testing::UnorderedElementsAre;

std::int64_t key_of(double x, double cell_size) {
  const GridKey key = grid_key(Vec3(x, 0.0, 0.0), cell_size);
  EXPECT_EQ(key.y, 0);
  EXPECT_EQ(key.z, 0);
  return key.x;
}

TEST(GridKey, FloorsTowardsMinusInfinity) {
  EXPECT_EQ(key_of(0.4, 0.5), 0);
  EXPECT_EQ(key_of(-0.4, 0.5), -1);
  EXPECT_EQ(key_of(-0.6, 0.5), -2);
  EXPECT_EQ(key_of(-0x1p-1074, 0.5), -1);
  EXPECT_EQ(key_of(-0.0, 0.5), 0);
}

TEST(GridKey, ExactMultiplesBelongToTheUpperCell) {
  for (int k = -40; k <= 40; ++k) {
    EXPECT_EQ(key_of(0.25 * k, 0.25), k);
    EXPECT_EQ(key_of(std::nextafter(0.25 * k, -1e9), 0.25), k - 1) << k;
  }
}

TEST(GridKey, EachAxisHasItsOwnCoordinate) {
  EXPECT_EQ(grid_key({1.5, -2.5, 30.0}, 1.0), (GridKey{1, -3, 30}));
}

TEST(GridKey, IsClampedWhereNoIntegerFits) {
  constexpr std::int64_t kLimit = std::int64_t{1} << 62;
  EXPECT_EQ(key_of(1e300, 1e-3), kLimit);
  EXPECT_EQ(key_of(-1e300, 1e-3), -kLimit);
  EXPECT_EQ(key_of(1e300, 1e-300), kLimit);  // the quotient itself is infinite
  EXPECT_EQ(key_of(0x1p61, 1.0), std::int64_t{1} << 61);
}

TEST(GridKey, IsMonotone) {
  test::TriangleSource random(41);
  std::size_t equal = 0;
  for (int round = 0; round < 20000; ++round) {
    const double size = std::ldexp(1.0 + std::abs(random.unit()), random.below(8) - 4);
    double a = std::ldexp(random.unit(), random.below(80) - 4);
    double b = random.below(2) ? std::nextafter(a, 1e308) : std::ldexp(random.unit(), 3);
    if (a > b) std::swap(a, b);
    EXPECT_LE(key_of(a, size), key_of(b, size)) << a << " " << b << " " << size;
    equal += key_of(a, size) == key_of(b, size);
  }
  EXPECT_GT(equal, 5000u);
  EXPECT_LT(equal, 15000u);
}

struct Item {
  GridKey key;
  std::uint32_t id;
};

std::vector<Item> random_items(int count) {
  test::TriangleSource random(42);
  std::vector<Item> items;
  for (int i = 0; i < count; ++i) {
    GridKey key{random.below(7) - 3, random.below(7) - 3, random.below(3) - 1};
    if (i % 5 == 0) key.x *= std::int64_t{1} << 60;  // same low bits, other key
    items.push_back({key, static_cast<std::uint32_t>(i)});
  }
  return items;
}

std::vector<std::uint32_t> owners_at(const SpatialHash& hash, const GridKey& key) {
  std::vector<std::uint32_t> ids;
  hash.for_each(key, [&](std::uint32_t id) { ids.push_back(id); });
  std::sort(ids.begin(), ids.end());
  return ids;
}

TEST(SpatialHash, FindsTheSameAtEveryTableSize) {
  const std::vector<Item> items = random_items(300);
  for (std::uint32_t table : {0u, 1u, 2u, 3u, 1024u}) {
    SpatialHash hash(table);
    for (const Item& item : items) hash.insert(item.key, item.id);
    hash.build();
    EXPECT_EQ(hash.size(), items.size());
    std::size_t finds = 0;
    for (const Item& wanted : items) {
      std::vector<std::uint32_t> expected;
      for (const Item& item : items)
        if (item.key == wanted.key) expected.push_back(item.id);
      EXPECT_EQ(owners_at(hash, wanted.key), expected) << table;
      finds += expected.size();
    }
    EXPECT_GT(finds, 2 * items.size());
    EXPECT_TRUE(owners_at(hash, {99, 99, 99}).empty());
  }
}

TEST(SpatialHash, TableSizeIsRoundedUpToAPowerOfTwo) {
  for (const auto& [wanted, buckets] : {std::pair{1u, 1u}, {2u, 2u}, {3u, 4u}, {1000u, 1024u}}) {
    SpatialHash hash(wanted);
    hash.insert({0, 0, 0}, 1);
    hash.build();
    EXPECT_EQ(hash.bucket_count(), buckets);
  }
  SpatialHash by_entries;
  for (std::uint32_t i = 0; i < 5; ++i) by_entries.insert({i, 0, 0}, i);
  by_entries.build();
  EXPECT_EQ(by_entries.bucket_count(), 8u);
}

TEST(SpatialHash, BucketsHoldEveryEntryOnce) {
  SpatialHash hash(8);
  for (const Item& item : random_items(100)) hash.insert(item.key, item.id);
  hash.build();
  std::vector<std::uint32_t> ids;
  for (std::size_t b = 0; b < hash.bucket_count(); ++b)
    for (const SpatialHash::Entry& e : hash.bucket_at(b)) ids.push_back(e.id);
  std::sort(ids.begin(), ids.end());
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(ids[i], i);
}

TEST(SpatialHash, ClearAndRebuildForgets) {
  SpatialHash hash(4);
  hash.insert({1, 2, 3}, 7);
  hash.build();
  hash.clear();
  hash.insert({1, 2, 3}, 8);
  hash.insert({-1, -2, -3}, 9);
  hash.build();
  EXPECT_THAT(owners_at(hash, {1, 2, 3}), UnorderedElementsAre(8u));
}

TEST(SpatialHash, ClearTakesANewTableSize) {
  SpatialHash hash(1024);
  for (std::uint32_t table : {1u, 64u, 2u}) {
    hash.clear(table);
    hash.insert({5, 6, 7}, table);
    hash.build();
    EXPECT_EQ(hash.bucket_count(), table);
    EXPECT_THAT(owners_at(hash, {5, 6, 7}), UnorderedElementsAre(table));
  }
}

TEST(SpatialHash, EmptyTableFindsNothing) {
  for (std::uint32_t table : {0u, 16u}) {
    SpatialHash hash(table);
    hash.build();
    EXPECT_TRUE(owners_at(hash, {0, 0, 0}).empty());
  }
}

TEST(HashTableSize, IsAPowerOfTwoUpToTheLargestOf32Bits) {
  EXPECT_EQ(hash_table_size(0, 0), 1u);
  EXPECT_EQ(hash_table_size(0, 5), 8u);
  EXPECT_EQ(hash_table_size(3, 5), 4u);
  EXPECT_EQ(hash_table_size(0, kLargestHashTable - 1), kLargestHashTable);
  EXPECT_EQ(hash_table_size(0, kLargestHashTable), kLargestHashTable);
  EXPECT_EQ(hash_table_size(0, std::uint64_t{kLargestHashTable} + 1), kLargestHashTable);
  EXPECT_EQ(hash_table_size(kLargestHashTable + 1, 5), kLargestHashTable);
  EXPECT_EQ(hash_table_size(~0u, ~0u), kLargestHashTable);
}

TEST(HashTableSize, MoreEntriesThan32BitsNumberAreRefused) {
  EXPECT_NO_THROW(hash_table_size(1, 0xffffffff));
  EXPECT_THROW(hash_table_size(1, 0x100000000), RefusedInput);
}

}  // namespace
}  // namespace contactcheck
