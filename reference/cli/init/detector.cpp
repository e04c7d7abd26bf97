// A beginning that is wrong: it says that two bodies touch where their boxes do. To answer with
// pairs of triangles, add CONTACTCHECK_LEVEL_TRIANGLE and the question CONTACTCHECK_ASK_TRIANGLES
// in declare(), and give the pairs to answer.triangles. What each function is for:
// contactcheck_plugin.h.
#include "contactcheck_plugin.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <iterator>
#include <vector>

namespace {

struct Box {
  std::array<double, 3> low, high;

  bool overlaps(const Box& other) const {
    for (int k = 0; k < 3; ++k)
      if (high[k] < other.low[k] || other.high[k] < low[k]) return false;
    return true;
  }
};

Box box_of(const double* vertices, uint32_t count) {
  Box box = {{vertices[0], vertices[1], vertices[2]}, {vertices[0], vertices[1], vertices[2]}};
  for (uint32_t v = 1; v < count; ++v)
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], vertices[3 * v + k]);
      box.high[k] = std::max(box.high[k], vertices[3 * v + k]);
    }
  return box;
}

class Detector {
 public:
  /// What it claims, and so is judged by.
  void declare(contactcheck_semantics& semantics) const {
    semantics.levels = CONTACTCHECK_LEVEL_BODY;
    semantics.question_count = 1;
    semantics.questions[0] = CONTACTCHECK_ASK_BODY;
  }

  /// Once per scene, not timed. The bodies stay where they are until the end.
  void prepare(const contactcheck_body* bodies, uint32_t count) {
    bodies_.assign(bodies, bodies + count);
    boxes_.resize(count);
  }

  /// Once per frame.
  void update(const contactcheck_frame& frame) {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      boxes_[b] = box_of(frame.bodies[b].vertices, bodies_[b].vertex_count);
  }

  void query(uint32_t /*question*/, const contactcheck_answer& answer) const {
    for (uint32_t b = 0; b < boxes_.size(); ++b)
      for (uint32_t a = 0; a < b; ++a)
        if (boxes_[a].overlaps(boxes_[b])) {
          const contactcheck_body_pair pair = {a, b};
          answer.bodies(answer.host, &pair, 1);
        }
  }

 private:
  std::vector<contactcheck_body> bodies_;
  std::vector<Box> boxes_;  // of each body, in the frame of the last update
};

// No exception may leave a function that C calls.
template <typename Call>
int32_t guarded(char* message, Call call) {
  try {
    call();
    return CONTACTCHECK_OK;
  } catch (const std::exception& e) {
    std::snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "%s", e.what());
  } catch (...) {
    std::snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "unknown exception");
  }
  return CONTACTCHECK_ERROR;
}

Detector& of(void* self) { return *static_cast<Detector*>(self); }

contactcheck_plugin make_table() {
  constexpr uint32_t sizes[] = CONTACTCHECK_STRUCT_SIZES;
  contactcheck_plugin table = {};
  table.abi_version = CONTACTCHECK_PLUGIN_ABI;
  std::copy(std::begin(sizes), std::end(sizes), table.struct_sizes);
  table.id = "mine";
  table.summary = "compares boxes of bodies";
  table.version = "0.1";
  table.create = [](const contactcheck_setting*, uint32_t, void** self, char* message) {
    return guarded(message, [&] { *self = new Detector; });
  };
  table.destroy = [](void* self) { delete &of(self); };
  table.declare = [](void* self, contactcheck_semantics* semantics, char* message) {
    return guarded(message, [&] { of(self).declare(*semantics); });
  };
  table.prepare = [](void* self, const contactcheck_body* bodies, uint32_t count, char* message) {
    return guarded(message, [&] { of(self).prepare(bodies, count); });
  };
  table.update = [](void* self, const contactcheck_frame* frame, char* message) {
    return guarded(message, [&] { of(self).update(*frame); });
  };
  table.query = [](void* self, uint32_t question, const contactcheck_answer* answer,
                   char* message) {
    return guarded(message, [&] { of(self).query(question, *answer); });
  };
  return table;
}

}  // namespace

const contactcheck_plugin* contactcheck_plugin_entry(void) {
  static const contactcheck_plugin table = make_table();
  return &table;
}
