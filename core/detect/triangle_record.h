// Records of stages that keep pairs of triangles.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/detect/detector.h"

namespace contactcheck {

/// All pairs of triangles of different bodies, given each body's number of triangles.
inline std::uint64_t brute_force_pairs(const std::vector<std::uint64_t>& triangles) {
  std::uint64_t pairs = 0, before = 0;
  for (std::uint64_t count : triangles) {
    pairs += before * count;
    before += count;
  }
  return pairs;
}

/// What a stage let through out of `in` pairs, in any order, with repeats.
inline StageRecord triangle_record(std::string name, std::uint64_t in,
                                   std::vector<ElementPair> elements) {
  StageRecord record;
  record.name = std::move(name);
  record.unit = "triangle pairs";
  record.kind = StageRecord::Kind::kTriangles;
  record.in = in;
  record.elements = std::move(elements);
  canonicalize(record.elements);
  record.out = record.elements.size();
  return record;
}

}  // namespace contactcheck
