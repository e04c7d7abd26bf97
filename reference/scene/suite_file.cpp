#include "reference/scene/suite_file.h"

#include <algorithm>

#include "reference/scene/file_text.h"
#include "reference/scene/id_check.h"
#include "reference/scene/json_field.h"

namespace contactcheck {
namespace {

std::vector<std::string> parse_names(const JsonField& field, bool ids) {
  std::vector<std::string> names;
  for (const JsonField& item : field.items(1)) {
    const std::string name = ids ? parse_id(item) : item.text();
    if (std::find(names.begin(), names.end(), name) != names.end()) item.refuse("named once only");
    names.push_back(name);
  }
  return names;
}

}  // namespace

Suite load_suite(const std::filesystem::path& file) {
  const std::string document = "suite file " + in_quotes(file.string());
  const JsonValue value = parse_json(read_file_bytes(file, "suite file"), document);
  const JsonField root(value, document);
  root.only_keys({"id", "title", "scenes", "detectors"});
  Suite suite;
  suite.id = parse_id(root.at("id"));
  suite.title = root.has("title") ? root.at("title").text() : suite.id;
  suite.scenes = parse_names(root.at("scenes"), true);
  suite.detectors = parse_names(root.at("detectors"), false);
  return suite;
}

}  // namespace contactcheck
