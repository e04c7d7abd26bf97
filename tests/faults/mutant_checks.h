// What the judge of the mutants asks of core. Each check records every fault that it finds.
#pragma once

#include <span>
#include <vector>

#include "core/deform/body.h"
#include "tests/faults/mutant_findings.h"
#include "tests/faults/mutant_scenes.h"

namespace contactcheck::test {

/// The mapping written down once more, after the README of the format: trilinear, first along s,
/// then t, then u, each blend a * (1 - w) + b * w. Without a lattice the nodes themselves.
std::vector<Vec3> plainly_mapped(const BodyShape& shape, std::span<const Vec3> nodes);

/// Every exact detector of the catalogue that takes the scene's bodies, against the oracle: pairs
/// of triangles and of bodies, frames forth and back with one detector.
void check_detectors(const MutantScene& scene, MutantFindings& out);
/// What the trees, boxes and spheres of the frame promise to hold.
void check_bounds(const MutantScene& scene, MutantFindings& out);
/// Mapped vertices, boxes and leaves, bit by bit.
void check_mapping(const MutantScene& scene, MutantFindings& out);
/// The paper's reading, against a node-plane test and a grid written down once more.
void check_paper_reading(const MutantScene& scene, MutantFindings& out);
/// Vertices in the ground, with the plane through one of them.
void check_ground(const MutantScene& scene, MutantFindings& out);

/// Predicates and the test of two triangles against rational arithmetic.
void check_triangle_pairs(MutantFindings& out);
/// Labels of triangles against rational arithmetic.
void check_labels(MutantFindings& out);
/// Moving elements against the oracle.
void check_impacts(MutantFindings& out);
/// Contact within steps: detectors against the oracle, and what their bounds promise.
void check_steps(MutantFindings& out);
/// Sets of contacts, the hash grid and what a mesh is.
void check_small_parts(MutantFindings& out);

}  // namespace contactcheck::test
