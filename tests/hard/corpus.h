// The families of hard cases, with the ground truth of every case.
#pragma once

#include <string>
#include <vector>

#include "reference/scene/scene.h"
#include "reference/suite/family_truth.h"

namespace contactcheck::test {

struct HardFamily {
  scene::Scene scene;
  std::vector<suite::CaseTruth> truth;                   ///< per value
  std::vector<std::vector<std::vector<Vec3>>> vertices;  ///< [value][body]

  Frame frame(std::size_t value) const;
};

/// By id; read and judged when first asked for.
const HardFamily& hard_family(const std::string& id);

/// Sorted. Empty only where the corpus is missing.
std::vector<std::string> family_ids();

/// Expected answers as they are kept.
const suite::ExpectedFamilies& expected_families();

}  // namespace contactcheck::test
