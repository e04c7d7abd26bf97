// Results written by hand: one scene, runs of every status.
#pragma once

#include <nlohmann/json.hpp>

namespace contactcheck::test {

/// Scene "hello" with fcl-aabb (exact, timed), ffd-aabb (misses, timed), one run in `error`, one
/// `absent` and one `refused`.
nlohmann::ordered_json sample_results();

}  // namespace contactcheck::test
