#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/types/check.h"
#include "reference/plugin/library_told.h"
#include "reference/plugin/library_views.h"
#include "reference/plugin/plugin_library.h"

namespace contactcheck::plugin {
namespace {

class LibraryDetector : public Detector {
 public:
  LibraryDetector(const PluginLibrary& library, const Options& options) : library_(library) {
    create(options);
    declare();
  }

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return needs_vertices_; }

  void prepare(const std::vector<Body>& bodies) override {
    views_.clear();
    for (const Body& body : bodies) views_.push_back(std::make_unique<BodyView>(body));
    bodies_.clear();
    for (const auto& view : views_) bodies_.push_back(view->body());
    states_.resize(bodies.size());
    stages_ = {};
    counts_ = {};
    check(table().prepare(detector_.get(), bodies_.data(), count(bodies_), message_.data()),
          "prepare");
    declare_again();
  }

  void update(const Frame& frame) override {
    CONTACTCHECK_INVARIANT(frame.bodies.size() == states_.size(), "one state per prepared body");
    for (std::size_t b = 0; b < states_.size(); ++b)
      states_[b] = {numbers(frame.bodies[b].nodes),
                    needs_vertices_ ? numbers(frame.bodies[b].vertices) : nullptr};
    const contactcheck_frame own = {frame.index, frame.time, count(states_), 0, states_.data()};
    check(table().update(detector_.get(), &own, message_.data()), "update");
  }

  void query(Question question, ContactSet& out) override {
    const contactcheck_answer answer = answer_into(out);
    check(table().query(detector_.get(), number_of(question), &answer, message_.data()), "query");
  }

  StageTrace trace() override {
    if (table().trace == nullptr) return {};
    const contactcheck_trace sink = stages_.sink();
    check(table().trace(detector_.get(), &sink, message_.data()), "trace");
    return stages_.checked(bodies_);
  }

  std::vector<Count> counts() override {
    if (table().counts == nullptr) return {};
    const contactcheck_counts sink = counts_.sink();
    check(table().counts(detector_.get(), &sink, message_.data()), "counts");
    return counts_.checked();
  }

  std::optional<double> reported_ns() const override {
    if (table().own_ms == nullptr) return std::nullopt;
    return told_ns(table().own_ms(detector_.get()));
  }

 private:
  struct Destroy {
    void (*function)(void*);
    void operator()(void* detector) const { function(detector); }
  };

  const contactcheck_plugin& table() const { return library_.table(); }

  template <typename Items>
  static std::uint32_t count(const Items& items) {
    return static_cast<std::uint32_t>(items.size());
  }

  void create(const Options& options) {
    std::vector<contactcheck_setting> settings;
    for (std::uint32_t i = 0; i < table().option_count; ++i) {
      const char* const name = table().options[i].name;
      settings.push_back({name, options.at(name).c_str()});
    }
    void* made = nullptr;
    check(table().create(settings.data(), count(settings), &made, message_.data()), "create");
    detector_ = {made, Destroy{table().destroy}};
  }

  void declare() {
    contactcheck_semantics said = default_semantics();
    check(table().declare(detector_.get(), &said, message_.data()), "declare");
    try {
      semantics_ = semantics_of(said);
    } catch (const InputError& e) {
      throw InputError(library_.name() + " " + e.what());
    }
    needs_vertices_ = said.needs_vertices != 0;
  }

  void declare_again() {
    const Semantics before = semantics_;
    const bool needed_vertices = needs_vertices_;
    declare();
    require_same_claims(library_.name(), before, semantics_);
    if (needed_vertices != needs_vertices_) refuse_change(library_.name(), "needs_vertices");
  }

  void check(std::int32_t status, const char* function) {
    message_.back() = '\0';
    const std::string said = message_.data();
    message_.front() = '\0';
    if (status == CONTACTCHECK_OK) return;
    if (status == CONTACTCHECK_REFUSED && !said.empty()) throw RefusedInput(said);
    const std::string text = std::string(function) + " failed" + (said.empty() ? "" : ": " + said);
    if (status == CONTACTCHECK_REFUSED) throw RefusedInput(text);
    throw std::runtime_error(text);
  }

  const PluginLibrary library_;
  std::array<char, CONTACTCHECK_MESSAGE_SIZE> message_ = {};
  Semantics semantics_;
  bool needs_vertices_ = true;
  std::vector<std::unique_ptr<BodyView>> views_;  ///< what bodies_ point into
  std::vector<contactcheck_body> bodies_;
  std::vector<contactcheck_body_state> states_;
  ToldStages stages_;
  ToldCounts counts_;
  // Last, so that it goes first: destroy() may still read the bodies. A null detector has nothing
  // to destroy.
  std::unique_ptr<void, Destroy> detector_{nullptr, Destroy{nullptr}};
};

}  // namespace

std::unique_ptr<Detector> make_library_detector(const PluginLibrary& library,
                                                const Options& options) {
  return std::make_unique<LibraryDetector>(library, options);
}

}  // namespace contactcheck::plugin
