#include "reference/plugin/pipe_detector.h"

#include <optional>
#include <utility>

#include "core/types/check.h"
#include "reference/plugin/pipe_messages.h"
#include "reference/plugin/pipe_process.h"
#include "reference/text/printable.h"

namespace contactcheck::plugin {
namespace {

// A row keeps text::kLongestForeignText bytes of a sentence: of a long command the end is shown, so
// that what went wrong is kept as well.
constexpr std::size_t kLongestShownCommand = 200;

class PipeDetector : public Detector {
 public:
  PipeDetector(const std::string& command, const Options& options)
      : name_("command \"" + text::end_of(command, kLongestShownCommand) + "\""),
        options_(options),
        process_(command) {
    process_.send(hello_message());
    const Reply hello(process_.receive_line(), name_, "hello");
    hello.root().at("protocol").one_of({kPipeProtocol});
    declaration_ = read_declaration(hello.root());
  }

  const Declaration& declaration() const { return declaration_; }
  const std::string& name() const { return name_; }

  const Semantics& semantics() const override { return declaration_.semantics; }
  bool needs_vertices() const override { return declaration_.needs_vertices; }

  // A scale, and a margin with it, may be taken from the bodies: then it declares anew.
  void prepare(const std::vector<Body>& bodies) override {
    or_kill([&] {
      const Reply ready = ask(prepare_message(bodies, options_), "ready");
      if (!ready.root().has("semantics")) return;
      const Semantics now = read_semantics(ready.root().at("semantics"));
      require_same_claims(name_, declaration_.semantics, now);
      declaration_.semantics = now;
    });
  }

  void update(const Frame& frame) override {
    or_kill([&] { reported_ns_ = ask(frame_message(frame, declaration_), "done").reported_ns(); });
  }

  void query(Question question, ContactSet& out) override {
    or_kill([&] {
      const Reply contacts = ask(query_message(question), "contacts");
      check_contact_counts(contacts);
      read_contacts(contacts, process_.receive(contacts.bytes()), out);
      if (question == Question::kSelf) read_self_answer(name_, out);
      reported_ns_ = contacts.reported_ns();
    });
  }

  std::optional<double> reported_ns() const override { return reported_ns_; }

  std::vector<std::string> notes() override {
    const std::string line = process_.first_error_line();
    if (line.empty()) return {};
    return {"wrote to standard error: \"" + line + "\""};
  }

 private:
  Reply ask(const std::string& message, const char* reply) {
    process_.send(message);
    return {process_.receive_line(), name_, reply};
  }

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

  std::string name_;
  Options options_;
  PipeProcess process_;
  Declaration declaration_;
  std::optional<double> reported_ns_;
};

}  // namespace

Declaration declare_command(const std::string& command) {
  return PipeDetector(command, {}).declaration();
}

std::unique_ptr<Detector> make_pipe_detector(const std::string& command, const std::string& id,
                                             const Options& options) {
  auto detector = std::make_unique<PipeDetector>(command, options);
  if (detector->declaration().id != id)
    throw InputError(detector->name() + " calls itself \"" + detector->declaration().id +
                     "\" now; when the run began it was \"" + id + "\"");
  return detector;
}

}  // namespace contactcheck::plugin
