// Fuzz target: recordings, once as the bytes are and once with their hashes mended, so that damage
// behind a right hash is tried too. Whatever is accepted can be mapped, and what is written of it
// is read again as the same.

#include <string>
#include <vector>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "tests/fuzz/fuzzed_file.h"
#include "tests/fuzz/recording_repair.h"

namespace contactcheck::test {
namespace {

constexpr std::size_t kSmallestRepaired = 40;

void map_all(const Recording& recording) {
  for (const auto& frame : recording.frames) {
    require(frame.size() == recording.bodies.size(), "a frame has the nodes of every body");
    for (std::size_t b = 0; b < frame.size(); ++b) {
      const BodyShape& shape = *recording.bodies[b].shape;
      require(frame[b].size() == shape.node_count(), "a body has a position for every node");
      std::vector<Vec3> vertices(shape.mesh.vertices.size());
      map_body(shape, frame[b], vertices);
    }
  }
}

// Equal shapes are written once, so only what has been written comes back byte for byte.
void check_round_trip(const Recording& recording) {
  const std::string once = recording_bytes(recording, "once.ccr");
  const std::string twice = recording_bytes(read_recording_bytes(once, "once.ccr"), "twice.ccr");
  require(once == twice, "a recording that is written and read is the same");
}

void check(const std::string& bytes) {
  Recording recording;
  try {
    recording = read_recording_bytes(bytes, "fuzzed.ccr");
  } catch (const InputError& refusal) {
    require_sentence(refusal.what());
    return;
  }
  map_all(recording);
  check_round_trip(recording);
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(recording) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  contactcheck::test::check(bytes);
  if (size >= contactcheck::test::kSmallestRepaired)
    contactcheck::test::check(contactcheck::test::repaired_recording(bytes));
  return 0;
}
