// Results written by hand (sample.json): one scene, runs of every status.
#pragma once

#include <nlohmann/json.hpp>

namespace contactcheck::test {

/// Scene "hello" with fcl-aabb (exact, timed), ffd-aabb (misses, timed), one run in `error`, one
/// `absent` and one `refused`.
nlohmann::ordered_json sample_results();

/// The sample's scene, drawn `count` times as drawn-7-1 and on, with fcl-aabb alone. Every second
/// one has contact.
nlohmann::ordered_json drawn_sample_results(std::size_t count);

}  // namespace contactcheck::test
