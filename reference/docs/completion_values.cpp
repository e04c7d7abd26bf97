#include "reference/docs/completion_values.h"

namespace contactcheck {

ValueKind kind_of(const OptionWords& option) {
  const std::string& name = option.flags.back();
  if (name == "targets" || name == "target") return ValueKind::kScenes;
  if (name == "families") return ValueKind::kFamilies;
  if (name == "--detector") return ValueKind::kDetectors;
  if (name == "--format") return ValueKind::kFormats;
  if (option.positional) return ValueKind::kFile;
  if (option.value.empty()) return ValueKind::kNothing;
  const std::string& value = option.value;
  const bool file = value == "FILE" || value == "RESULTS" || value == "DIR" ||
                    (value == "TEXT" && name != "--level" && name != "--kind");
  return file ? ValueKind::kFile : ValueKind::kWord;
}

ValueKind words_kind(const CommandWords& command) {
  ValueKind kind = ValueKind::kNothing;
  // Later ones are the more particular: `ab BASE HEAD [SUITE]`.
  for (const OptionWords& option : command.options)
    if (option.positional) kind = kind_of(option);
  return kind;
}

std::string names_command(ValueKind kind, const std::string& program) {
  const std::string first_words = "awk '/^  [^ ]/ {print $1}'";
  switch (kind) {
    case ValueKind::kScenes:
      return program + " list --suites --scenes 2>/dev/null | " + first_words;
    case ValueKind::kFamilies:
      return program + " list --families 2>/dev/null | " + first_words;
    case ValueKind::kDetectors:
      return program + " list 2>/dev/null | awk '/^Detectors/ {on=1} on && /^  [^ ]/ {print $1}'";
    case ValueKind::kFormats:
      return "printf '%s\\n' csv html md";
    default:
      return "";
  }
}

}  // namespace contactcheck
