#include "reference/plugin/library_trace.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>
#include <utility>

#include "reference/text/counted.h"
#include "reference/text/id_check.h"

namespace contactcheck::plugin {
namespace {

constexpr std::size_t kLongestName = 64, kMostItems = 64;
// In a frame: all pairs of two meshes of 100,000 triangles. Sums over the frames of a scene,
// 100,000 at most, stay whole numbers in every program that reads JSON (2^53).
constexpr std::uint64_t kMostOfFrame = 10'000'000'000;
constexpr double kMostMilliseconds = 1e9, kNanosecondsPerMillisecond = 1e6;

// One byte more than is allowed is enough to know that it is too long.
std::string bounded(const char* text) {
  return text == nullptr ? "" : std::string(text, strnlen(text, kLongestName + 1));
}

// It goes into tables, on terminals and into JSON.
bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= kLongestName &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

void check_number(std::uint64_t number, const std::string& of) {
  if (number > kMostOfFrame)
    fail(of + " is " + std::to_string(number) + "; allowed in a frame: up to " +
         std::to_string(kMostOfFrame));
}

/// The numbers and pairs of one stage against the bodies that there are.
void check_stage(const StageRecord& stage, std::span<const contactcheck_body> bodies) {
  const std::string name = "trace: stage \"" + stage.name + "\"";
  check_number(stage.in, name + ": in");
  check_number(stage.out, name + ": out");
  check_number(stage.visited, name + ": visited");
  if (stage.kind == StageRecord::Kind::kLabelCells)  // every true pair is looked up in the labels
    for (const contactcheck_body& body : bodies)
      if (body.lattice == nullptr)
        fail(name + " covers cells, and body \"" + body.name + "\" has none");

  const auto check_bodies = [&](std::uint32_t a, std::uint32_t b) {
    if (std::max(a, b) >= bodies.size())
      fail(name + " names body " + std::to_string(std::max(a, b)) + " of " +
           text::counted(bodies.size(), "body", "bodies"));
    if (a == b) fail(name + " names body \"" + bodies[a].name + "\" with itself");
  };
  const auto check_element = [&](std::uint32_t body, std::uint32_t id) {
    const bool triangles = stage.kind == StageRecord::Kind::kTriangles;
    const contactcheck_body& of = bodies[body];
    const std::uint32_t cells = of.lattice == nullptr ? 0 : of.lattice->cell_count;
    const std::uint32_t count = triangles ? of.triangle_count : cells;
    if (id >= count)
      fail(name + " names " + (triangles ? "triangle " : "cell ") + std::to_string(id) +
           " of body \"" + of.name + "\", which has " + std::to_string(count));
  };
  for (const BodyPair& pair : stage.bodies) check_bodies(pair.a, pair.b);
  for (const ElementPair& pair : stage.elements) {
    check_bodies(pair.body_a, pair.body_b);
    check_element(pair.body_a, pair.a);
    check_element(pair.body_b, pair.b);
  }
}

// A stage of owner cells asks for the owner of every triangle.
void check_owners(const StageTrace& trace, std::span<const contactcheck_body> bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const contactcheck_body& body = bodies[b];
    const std::string name = "body \"" + std::string(body.name) + "\"";
    const std::size_t said = b < trace.owner.size() ? trace.owner[b].size() : 0;
    if (said != body.triangle_count)
      fail("trace: a stage covers owner cells, and owners() gave " + std::to_string(said) +
           " of them for " + name + ", which has " + std::to_string(body.triangle_count) +
           " triangles");
    const std::uint32_t cells = body.lattice == nullptr ? 0 : body.lattice->cell_count;
    for (const std::uint32_t cell : trace.owner[b])
      if (cell >= cells)
        fail("trace: owners() names cell " + std::to_string(cell) + " of " + name + ", which has " +
             std::to_string(cells));
  }
}

}  // namespace

contactcheck_trace TraceCollector::sink() {
  frame_ = {};
  covers_.clear();
  bodies_of_owners_ = 0;
  too_many_ = false;
  return {this, add_stage, add_owners};
}

void TraceCollector::add_stage(void* host, const contactcheck_stage* stage) noexcept {
  auto& collector = *static_cast<TraceCollector*>(host);
  collector.too_many_ = collector.too_many_ || collector.frame_.stages.size() == kMostItems;
  if (collector.too_many_) return;
  StageRecord record;
  record.name = bounded(stage->name);
  record.unit = bounded(stage->unit);
  record.in = stage->in;
  record.out = stage->out;
  record.visited = stage->visited;
  record.visited_unit = bounded(stage->visited_unit);
  record.kind = static_cast<StageRecord::Kind>(std::min(stage->covers, 3u));
  const bool of_bodies = stage->covers == CONTACTCHECK_COVERS_BODIES;
  for (std::uint64_t i = 0; i < stage->count && of_bodies; ++i)
    record.bodies.push_back({stage->bodies[i].a, stage->bodies[i].b});
  for (std::uint64_t i = 0; i < stage->count && !of_bodies; ++i) {
    const contactcheck_element_pair& p = stage->pairs[i];
    record.elements.push_back({p.body_a, p.body_b, p.a, p.b});
  }
  collector.frame_.stages.push_back(std::move(record));
  collector.covers_.push_back(stage->covers);
}

void TraceCollector::add_owners(void* host, std::uint32_t body, const std::uint32_t* cells,
                                std::size_t count) noexcept {
  auto& collector = *static_cast<TraceCollector*>(host);
  collector.bodies_of_owners_ = std::max(collector.bodies_of_owners_, body + std::uint64_t{1});
  auto& owner = collector.frame_.owner;
  constexpr std::uint32_t kMostBodies = 1u << 20;  // an absurd number must not take the memory
  if (body >= kMostBodies) return;
  if (owner.size() <= body) owner.resize(body + std::size_t{1});
  owner[body].assign(cells, cells + count);
}

StageTrace TraceCollector::checked(std::span<const contactcheck_body> bodies) {
  if (too_many_) fail("trace: gives more than " + std::to_string(kMostItems) + " stages");
  if (bodies_of_owners_ > bodies.size())
    fail("trace: owners() names body " + std::to_string(bodies_of_owners_ - 1) + " of " +
         text::counted(bodies.size(), "body", "bodies"));
  check_shape();
  bool owners = false;
  for (std::size_t i = 0; i < frame_.stages.size(); ++i) {
    StageRecord& stage = frame_.stages[i];
    if (covers_[i] > CONTACTCHECK_COVERS_TRIANGLES)
      fail("trace: stage \"" + stage.name + "\" covers what does not exist (" +
           std::to_string(covers_[i]) + ")");
    check_stage(stage, bodies);
    canonicalize(stage.elements);
    for (BodyPair& pair : stage.bodies)
      if (pair.a > pair.b) std::swap(pair.a, pair.b);
    std::sort(stage.bodies.begin(), stage.bodies.end());
    owners = owners || stage.kind == StageRecord::Kind::kOwnerCells;
  }
  if (owners) check_owners(frame_, bodies);
  return std::exchange(frame_, {});
}

// Sums over frames are made stage by stage.
void TraceCollector::check_shape() {
  std::vector<std::string> shape;
  for (const StageRecord& stage : frame_.stages) {
    const bool counted = !stage.visited_unit.empty();
    if (!is_name(stage.name) || !is_name(stage.unit) || (counted && !is_name(stage.visited_unit)))
      fail("trace: a stage's name and units must be one line of ASCII, " +
           std::to_string(kLongestName) + " bytes at most");
    shape.push_back(stage.name + '\n' + stage.unit + '\n' + stage.visited_unit);
  }
  if (has_shape_ && shape != shape_)
    fail("trace: the stages or their units are not those of the frame before");
  shape_ = std::move(shape);
  has_shape_ = true;
}

contactcheck_counts CountsCollector::sink() {
  frame_.clear();
  return {this, add};
}

void CountsCollector::add(void* host, const char* name, std::uint64_t value) noexcept {
  auto& frame = static_cast<CountsCollector*>(host)->frame_;
  if (frame.size() <= kMostItems) frame.push_back({bounded(name), value});
}

std::vector<Count> CountsCollector::checked() {
  if (frame_.size() > kMostItems)
    fail("counts: gives more than " + std::to_string(kMostItems) + " counters");
  std::vector<std::string> names;
  for (const Count& count : frame_) {
    if (!text::is_id(count.name))
      fail("counts: a counter's name must be letters, digits, '-', '_' and '.', " +
           std::to_string(kLongestName) + " at most");
    check_number(count.value, "counts: " + count.name);
    names.push_back(count.name);
  }
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
    fail("counts: gives a counter twice");
  if (has_names_ && names != names_) fail("counts: the counters are not those of the frame before");
  names_ = std::move(names);
  has_names_ = true;
  return std::exchange(frame_, {});
}

std::optional<double> reported_ns_of(double milliseconds) {
  if (!(milliseconds <= kMostMilliseconds))
    fail("own_ms gave " + std::to_string(milliseconds) + " ms; allowed: up to " +
         std::to_string(static_cast<long>(kMostMilliseconds)) + ", or below 0 for none");
  if (milliseconds < 0.0) return std::nullopt;
  return kNanosecondsPerMillisecond * milliseconds;
}

}  // namespace contactcheck::plugin
