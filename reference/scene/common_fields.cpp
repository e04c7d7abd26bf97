#include "reference/scene/common_fields.h"

#include <algorithm>

#include "core/deform/name_check.h"
#include "reference/mesh/mesh_file.h"

namespace contactcheck::scene {

std::vector<Level> parse_levels(const text::JsonField& field) {
  std::vector<Level> levels;
  for (const text::JsonField& item : field.items(1)) {
    const Level level = *level_from_name(item.one_of(level_names()));
    if (std::find(levels.begin(), levels.end(), level) != levels.end()) {
      item.refuse("named once only");
    }
    levels.push_back(level);
  }
  return levels;
}

std::string shape_notes(const BodyShape& shape, std::string notes) {
  mesh::add_note_of_dropped(notes, shape.given.dropped);
  mesh::add_note(notes, describe(shape.topology));
  return notes;
}

std::string parse_body_name(const text::JsonField& field, const std::vector<Body>& bodies) {
  std::string name = field.text();
  const std::string fault = name_fault(name);
  if (!fault.empty()) field.fail(fault + " and cannot be a name");
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].name != name) continue;
    field.refuse("different from bodies[" + std::to_string(b) + "].name");
  }
  return name;
}

}  // namespace contactcheck::scene
