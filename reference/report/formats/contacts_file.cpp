#include "reference/report/formats/contacts_file.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/types/check.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "contactcheck-contacts/1";

// Vertices are numbered as they were given.
std::int64_t element_count(const BodyShape& shape, Element kind) {
  switch (kind) {
    case Element::kTriangle:
      return static_cast<std::int64_t>(shape.mesh.triangles.size());
    case Element::kCell:
      return shape.lattice ? static_cast<std::int64_t>(shape.lattice->cells.size()) : 0;
    case Element::kVertex:
      return static_cast<std::int64_t>(shape.given_vertex_count());
    case Element::kEdge:  // fewer than corners of triangles
      return static_cast<std::int64_t>(3 * shape.mesh.triangles.size());
    case Element::kNone:
      break;
  }
  return 0;
}

void check_contacts(const Json& contacts, const Recording& recording) {
  if (contacts.at("schema") != kSchema)
    throw InputError("its schema is not \"" + std::string(kSchema) + "\"");
  if (contacts.at("scene") != recording.scene)
    throw InputError("it is not of the scene \"" + recording.scene + "\"");

  const auto check_frame = [&](const Json& frame) {
    const auto number = frame.at("frame").get<std::uint64_t>();
    if (number >= recording.frames.size())
      throw InputError("frame " + std::to_string(number) + " is not among the " +
                       std::to_string(recording.frames.size()) + " recorded ones");
  };
  for (const Json& frame : contacts.at("truth")) check_frame(frame);
  for (const Json& detector : contacts.at("detectors")) {
    detector.at("detector").get<std::string>();
    for (const Json& frame : detector.at("frames")) check_frame(frame);
  }
  visit_elements(contacts, [&](std::int64_t body, std::int64_t element, Element kind) {
    if (body < 0 || body >= static_cast<std::int64_t>(recording.bodies.size()))
      throw InputError("body " + std::to_string(body) + " is not recorded");
    if (kind == Element::kNone && element == -1) return;
    const BodyShape& shape = *recording.bodies[static_cast<std::size_t>(body)].shape;
    const auto dropped = [&] {
      return kind == Element::kVertex &&
             !shape.given.vertex_of(static_cast<std::uint32_t>(element)).has_value();
    };
    if (element < 0 || element >= element_count(shape, kind) || dropped())
      throw InputError("body " + std::to_string(body) + " has no element " +
                       std::to_string(element));
  });
}

}  // namespace

// `missed` and `spurious` at a level are explained in fixtures/README.md, "Contacts".
NamedElements elements_at(const std::string& level, bool missed) {
  const std::optional<Level> known = level_from_name(level);
  if (!known) throw InputError("the level \"" + level + "\" is not known");
  return named_elements(*known, missed);
}

void visit_elements(
    const Json& contacts,
    const std::function<void(std::int64_t body, std::int64_t element, Element kind)>& visit) {
  const auto visit_pairs = [&](const Json& listed, NamedElements kind) {
    listed.at("count").get<std::uint64_t>();
    const auto pairs = listed.at("pairs").get<std::vector<std::int64_t>>();
    if (pairs.size() % 4 != 0)
      throw InputError("a list of pairs has " + std::to_string(pairs.size()) +
                       " numbers, which is no multiple of 4");
    for (std::size_t i = 0; i < pairs.size(); i += 4) {
      visit(pairs[i], pairs[i + 1], kind.first);
      visit(pairs[i + 2], pairs[i + 3], kind.second);
    }
  };
  for (const Json& frame : contacts.at("truth")) visit_pairs(frame, elements_at("triangle", true));
  for (const Json& detector : contacts.at("detectors")) {
    const auto level = detector.at("level").get<std::string>();
    for (const Json& frame : detector.at("frames")) {
      visit_pairs(frame.at("missed"), elements_at(level, true));
      visit_pairs(frame.at("spurious"), elements_at(level, false));
    }
  }
}

Json read_contacts(const std::string& text, const std::string& name, const Recording& recording) {
  std::string fault;
  try {
    Json contacts = Json::parse(text);
    check_contacts(contacts, recording);
    return contacts;
  } catch (const Json::parse_error& e) {  // its words repeat the bytes, whatever they are
    fault = "it is no JSON (at byte " + std::to_string(e.byte) + ")";
  } catch (const Json::exception& e) {
    fault = e.what();
  } catch (const InputError& e) {
    fault = e.what();
  }
  throw InputError("contacts \"" + name + "\": " + fault + ".");
}

}  // namespace contactcheck::report
