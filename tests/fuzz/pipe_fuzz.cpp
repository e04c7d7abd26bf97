// Fuzz target: what a detector writes into its pipe: a line of JSON, as each of the messages that
// it may be, and the bytes behind it. A declaration that is accepted is the same once it is written
// and read again; contacts are as many as the line announces.

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/types/check.h"
#include "reference/plugin/declaration.h"
#include "reference/plugin/pipe_messages.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

void check_declaration(const plugin::Reply& hello) {
  const plugin::Declaration declaration = plugin::read_declaration(hello.root());
  require(plugin::semantics_fault(declaration.semantics).empty(), "what it claims fits together");
  const std::string once = plugin::to_json(declaration).dump();
  const std::string document = "declaration";
  const text::JsonValue value = text::parse_json(once, document);
  const plugin::Declaration again = plugin::read_declaration({value, document});
  require(once == plugin::to_json(again).dump(), "a declaration that is written is read the same");
  plugin::require_same_claims(document, declaration.semantics, again.semantics);
}

std::size_t announced(const plugin::Reply& reply, const char* list) {
  return reply.root().has(list) ? reply.root().at(list).whole(0, plugin::kLargestAnswer) : 0;
}

void check_contacts(const plugin::Reply& reply, std::string_view bytes) {
  plugin::check_contact_counts(reply);
  if (bytes.size() < reply.bytes()) return;  // it would be waited for
  ContactSet out;
  plugin::StepAnswer steps;
  plugin::read_contacts(reply, bytes.substr(0, reply.bytes()), out, steps);
  require(out.bodies.size() == announced(reply, "bodies") &&
              out.triangles.size() == announced(reply, "triangles") &&
              out.cells.size() == announced(reply, "cells") &&
              out.vertices.size() == announced(reply, "vertices") &&
              out.near.size() == announced(reply, "near") &&
              out.piece_contacts.size() == announced(reply, "piece_contacts") &&
              out.vertex_contacts.size() == announced(reply, "vertex_contacts"),
          "contacts are as many as were announced");
}

void check_as(const char* message, const std::string& line, std::string_view bytes) {
  try {
    const plugin::Reply reply(line, "command \"fuzzed\"", message);
    const std::string kind = message;
    if (kind == "hello") check_declaration(reply);
    if (kind == "ready" && reply.root().has("semantics"))
      plugin::read_semantics(reply.root().at("semantics"));
    if (kind == "contacts") check_contacts(reply, bytes);
    const std::optional<double> time = reply.reported_ns();
    require(!time || (std::isfinite(*time) && *time >= 0.0), "a time is a number from 0 on");
  } catch (const InputError& refusal) {
    require_sentence(refusal.what());
  } catch (const std::runtime_error&) {  // what the other side says of itself: its own words
  }
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(pipe) {
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t end = all.find('\n');
  const std::string line(all.substr(0, end));
  const std::string_view bytes = end == all.npos ? std::string_view() : all.substr(end + 1);
  for (const char* message : {"hello", "ready", "done", "contacts"})
    contactcheck::test::check_as(message, line, bytes);
  return 0;
}
