#include "reference/plugin/pipe_detector.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/types/check.h"
#include "reference/plugin/pipe_messages.h"
#include "reference/plugin/pipe_process.h"
#include "reference/plugin/warm_up.h"
#include "reference/results/rerun.h"
#include "reference/text/counted.h"
#include "reference/text/printable.h"

namespace contactcheck::plugin {
namespace {

// A row keeps text::kLongestForeignText bytes of a sentence: of a long command the end is shown, so
// that what went wrong is kept as well.
constexpr std::size_t kLongestShownCommand = 200;

/// A command that has said hello.
class PipeObject {
 public:
  explicit PipeObject(const std::string& command)
      : name_("command \"" + text::end_of(command, kLongestShownCommand) + "\""),
        process_(command) {
    process_.send(hello_message());
    const Reply hello(process_.receive_line(), name_, "hello");
    hello.root().at("protocol").one_of({kPipeProtocol});
    declaration_ = read_declaration(hello.root());
  }

  /// @throws InputError if it calls itself otherwise than `id`
  void require_id(const std::string& id) const {
    if (declaration_.id != id)
      throw InputError(name_ + " calls itself \"" + declaration_.id +
                       "\" now; when the run began it was \"" + id + "\"");
  }

  const Declaration& declaration() const { return declaration_; }
  void change_semantics(const Semantics& now) { declaration_.semantics = now; }
  const std::string& name() const { return name_; }

  Reply ask(const std::string& message, const char* reply) {
    process_.send(message);
    return {process_.receive_line(), name_, reply};
  }
  std::string receive(std::size_t bytes) { return process_.receive(bytes); }
  PipeProcess& process() { return process_; }
  const PipeProcess& process() const { return process_; }

  // One that has gone astray must not go on while others are judged.
  template <typename Work>
  void or_kill(Work&& work) {
    try {
      work();
    } catch (...) {
      process_.kill();
      throw;
    }
  }

  std::vector<std::string> notes() {
    const std::string line = process_.first_error_line();
    std::vector<std::string> out;
    if (!line.empty()) out.push_back("wrote to standard error: \"" + line + "\"");
    if (const std::uint32_t frames = declaration_.warm_up; frames > 0)
      out.push_back("warmed up by " + text::counted(frames, "frame") +
                    " of contactcheck's own before the scene's bodies");
    return out;
  }

 private:
  std::string name_;
  PipeProcess process_;
  Declaration declaration_;
};

// What goes wrong here is no fault of the input that is judged.
template <typename Frame>
void warmed_up(std::uint32_t frames, Frame&& ask_about) {
  for (std::uint32_t frame = 0; frame < frames; ++frame) try {
      ask_about(frame);
    } catch (const std::exception& e) {
      throw std::runtime_error("in frame " + std::to_string(frame) + results::kOfWarmUp + ": " +
                               e.what());
    }
}

class PipeDetector : public Detector {
 public:
  PipeDetector(const std::string& command, const std::string& id, Options options)
      : object_(command),
        options_(std::move(options)),
        before_bodies_(object_.declaration().semantics) {
    object_.require_id(id);
  }

  const Semantics& semantics() const override { return object_.declaration().semantics; }
  bool needs_vertices() const override { return object_.declaration().needs_vertices; }

  void expect(const std::vector<Question>& questions) override { expected_ = questions; }

  void prepare(const std::vector<Body>& bodies) override {
    if (!warm_) warm_up();
    warm_ = true;
    give_bodies(bodies);
  }

  void update(const Frame& frame) override {
    object_.or_kill([&] {
      reported_ns_ = object_.ask(frame_message(frame, object_.declaration()), "done").reported_ns();
    });
  }

  void update_step(const Step& step) override {
    object_.or_kill([&] {
      reported_ns_ = object_.ask(step_message(step, object_.declaration()), "done").reported_ns();
    });
  }

  void query(Question question, ContactSet& out) override {
    object_.or_kill([&] {
      const Reply contacts = object_.ask(query_message(question), "contacts");
      check_contact_counts(contacts);
      StepAnswer steps;
      read_contacts(contacts, object_.receive(contacts.bytes()), out, steps);
      step_reader_.read(object_.name(), steps, out);
      if (question == Question::kSelf) read_self_answer(object_.name(), out);
      reported_ns_ = contacts.reported_ns();
    });
  }

  std::optional<double> reported_ns() const override { return reported_ns_; }
  std::vector<std::string> notes() override { return object_.notes(); }

  void pause() override { object_.process().pause(); }
  void resume() override { object_.process().resume(); }
  // One that lives in the caller of this run works where it cannot be seen.
  std::optional<std::uint64_t> bytes_elsewhere() const override {
    if (object_.declaration().unisolated || object_.declaration().transient) return std::nullopt;
    return object_.process().resident_bytes();
  }
  bool prepares_again() const override { return object_.declaration().prepares_again; }

 private:
  // A scale, and a margin with it, may be taken from the bodies: then it declares anew. What it
  // said of earlier bodies is not said of these.
  void give_bodies(const std::vector<Body>& bodies) {
    step_reader_.prepare(bodies);
    object_.change_semantics(before_bodies_);
    object_.or_kill([&] {
      const Reply ready = object_.ask(prepare_message(bodies, options_), "ready");
      if (!ready.root().has("semantics")) return;
      const Semantics now = read_semantics(ready.root().at("semantics"));
      require_same_claims(object_.name(), semantics(), now);
      object_.change_semantics(now);
    });
  }

  void warm_up() {
    const std::uint32_t frames = object_.declaration().warm_up;
    if (frames == 0) return;
    const WarmUpScene scene;
    warmed_up(frames, [&](std::uint32_t frame) {
      if (frame == 0) give_bodies(scene.bodies());
      warm_up(scene, frame);
    });
  }

  // Its answers are read, so that one that cannot be is an error, and forgotten.
  void warm_up(const WarmUpScene& scene, std::size_t frame) {
    const std::vector<Question>& questions = expected_.empty() ? semantics().questions : expected_;
    for (const bool steps : {false, true}) {
      if (std::ranges::count(questions, steps, is_of_steps) == 0) continue;
      if (steps) {
        update_step(scene.step(frame));
      } else {
        update(scene.frame(frame));
      }
      for (const Question question : questions) {
        ContactSet forgotten;
        if (is_of_steps(question) == steps) query(question, forgotten);
      }
    }
  }

  PipeObject object_;
  Options options_;
  Semantics before_bodies_;  ///< as it said hello
  std::vector<Question> expected_;
  bool warm_ = false;
  StepAnswerReader step_reader_;
  std::optional<double> reported_ns_;
};

class PipeImpacts final : public ImpactDetector {
 public:
  PipeImpacts(const std::string& command, const std::string& id, const Options& options)
      : object_(command) {
    object_.require_id(id);
    object_.or_kill([&] {
      const ImpactClaims before = object_.declaration().impacts.value();
      const Reply ready = object_.ask(prepare_message({}, options), "ready");
      tolerance_ = before.tolerance;
      if (!ready.root().has("impacts")) return;
      const ImpactClaims now = read_impact_claims(ready.root().at("impacts"));
      require_same_claims(object_.name(), before, now);
      tolerance_ = now.tolerance;
    });
    warm_up();
  }

  ImpactTolerance tolerance() const override { return tolerance_; }

  ReportedImpact query(const ImpactQuery& query) override {
    ReportedImpact out;
    try {
      out = read_impact(object_.ask(impact_message(query), "impact"));
    } catch (const RefusedInput&) {
      throw;  // this query alone
    } catch (...) {
      object_.or_kill([] { throw; });
    }
    return out;
  }

 private:
  void warm_up() {
    const std::uint32_t frames = object_.declaration().warm_up;
    if (frames == 0) return;
    const WarmUpScene scene;
    warmed_up(frames, [&](std::uint32_t frame) {
      for (const ImpactKind kind : object_.declaration().impacts->kinds) try {
          query(scene.query(frame, kind));
        } catch (const RefusedInput&) {  // that query alone
        }
    });
  }

  PipeObject object_;
  ImpactTolerance tolerance_;
};

}  // namespace

Declaration declare_command(const std::string& command) {
  return PipeObject(command).declaration();
}

std::unique_ptr<Detector> make_pipe_detector(const std::string& command, const std::string& id,
                                             const Options& options) {
  return std::make_unique<PipeDetector>(command, id, options);
}

std::unique_ptr<ImpactDetector> make_pipe_impact_detector(const std::string& command,
                                                          const std::string& id,
                                                          const Options& options) {
  return std::make_unique<PipeImpacts>(command, id, options);
}

}  // namespace contactcheck::plugin
