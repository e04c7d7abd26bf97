#include "reference/cli/completion.h"

#include <algorithm>
#include <sstream>

#include "reference/text/lists.h"

namespace contactcheck::cli {
ValueKind kind_of(const OptionWords& option) {
  const std::string& name = option.flags.back();
  if (name == "targets" || name == "target") return ValueKind::kScenes;
  if (name == "families") return ValueKind::kFamilies;
  if (name == "--detector") return ValueKind::kDetectors;
  if (name == "--format") return ValueKind::kFormats;
  if (option.positional) return ValueKind::kFile;
  if (option.value.empty()) return ValueKind::kNothing;
  const std::string& value = option.value;
  const bool file = value == "FILE" || value == "RESULTS" || value == "DIR" || value == "TEXT";
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

namespace {

constexpr ValueKind kNamed[] = {ValueKind::kScenes, ValueKind::kFamilies, ValueKind::kDetectors,
                                ValueKind::kFormats};

std::vector<std::string> command_names(const ProgramWords& program) {
  std::vector<std::string> names;
  for (const CommandWords& command : program.commands) names.push_back(command.name);
  return names;
}

std::vector<std::string> flags_of(const CommandWords& command) {
  std::vector<std::string> flags;
  for (const OptionWords& option : command.options)
    if (!option.positional) flags.insert(flags.end(), option.flags.begin(), option.flags.end());
  return flags;
}

// Collected over all commands: a flag means the same everywhere.
std::vector<std::string> flags_that_take(const ProgramWords& program, ValueKind kind) {
  std::vector<std::string> flags;
  for (const CommandWords& command : program.commands)
    for (const OptionWords& option : command.options)
      if (!option.positional && kind_of(option) == kind) flags.push_back(option.flags.back());
  std::sort(flags.begin(), flags.end());
  flags.erase(std::unique(flags.begin(), flags.end()), flags.end());
  return flags;
}

// Between a shell's single quotes, without the brackets and colons that zsh reads.
std::string plain(const std::string& help) {
  std::string out;
  for (const char c : help) {
    if (c == '\'')
      out += "\u2019";
    else if (c == '[')
      out += '(';
    else if (c == ']')
      out += ')';
    else if (c == ':')
      out += ',';
    else
      out += c;
  }
  return out;
}

void write_bash_values(std::ostream& out, const ProgramWords& program) {
  out << "  case $previous in\n";
  for (const ValueKind kind : kNamed) {
    const std::vector<std::string> flags = flags_that_take(program, kind);
    if (flags.empty()) continue;
    out << "    " << text::joined(flags, "|") << ")\n      mapfile -t COMPREPLY < <(compgen -W \"$("
        << names_command(kind, "\"${COMP_WORDS[0]}\"") << ")\" -- \"$word\")\n      return ;;\n";
  }
  out << "    " << text::joined(flags_that_take(program, ValueKind::kFile), "|") << ")\n"
      << "      mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n      return ;;\n"
      << "    " << text::joined(flags_that_take(program, ValueKind::kWord), "|") << ") return ;;\n"
      << "  esac\n";
}

void write_bash_commands(std::ostream& out, const ProgramWords& program) {
  out << "  case ${COMP_WORDS[1]} in\n";
  for (const CommandWords& command : program.commands) {
    out << "    " << command.name << ") flags=\"" << text::joined(flags_of(command), " ") << "\"";
    const std::string names = names_command(words_kind(command), "\"${COMP_WORDS[0]}\"");
    if (!names.empty()) out << "\n      [[ $word == -* ]] || names=$(" << names << ")";
    out << " ;;\n";
  }
  out << "  esac\n";
}

std::string zsh_action(ValueKind kind) {
  if (kind == ValueKind::kFile) return "_files";
  if (kind == ValueKind::kWord) return "";
  const std::string names = "compadd -- ${(f)\"$(" + names_command(kind, "$contactcheck") + ")\"}";
  std::string quoted;
  for (const char c : names) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "{" + quoted + "; _files}";
}

void write_zsh_option(std::ostream& out, const OptionWords& option) {
  const ValueKind kind = kind_of(option);
  if (option.positional) {
    out << " \\\n        '*:" << option.flags[0] << ":" << zsh_action(kind) << "'";
    return;
  }
  for (const std::string& flag : option.flags) {
    out << " \\\n        '*" << flag << "[" << plain(option.help) << "]";
    if (kind != ValueKind::kNothing) out << ":" << plain(option.value) << ":" << zsh_action(kind);
    out << "'";
  }
}

std::string fish_values(const OptionWords& option) {
  const ValueKind kind = kind_of(option);
  if (kind == ValueKind::kNothing) return "";
  if (kind == ValueKind::kWord) return " -x";
  const std::string names = names_command(kind, "contactcheck");
  if (names.empty()) return " -r -F";
  std::string quoted;
  for (const char c : names)
    quoted += c == '"' || c == '$' ? std::string("\\") + c : std::string(1, c);
  return " -r -a \"(" + quoted + ")\"";
}

void write_fish_option(std::ostream& out, const CommandWords& command, const OptionWords& option) {
  out << "complete -c contactcheck -n '__fish_seen_subcommand_from " << command.name << "'";
  if (option.positional) {
    const std::string values = fish_values(option);
    out << (values.starts_with(" -r") ? values.substr(3) : values) << "\n";
    return;
  }
  for (const std::string& flag : option.flags)
    out << (flag.starts_with("--") ? " -l " + flag.substr(2) : " -s " + flag.substr(1));
  out << fish_values(option) << " -d '" << plain(option.help) << "'\n";
}

}  // namespace

std::string bash_completion(const ProgramWords& program) {
  std::ostringstream out;
  out << "# bash completion for contactcheck\n_contactcheck() {\n"
      << "  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
      << "  local flags=\"\" names=\"\"\n  COMPREPLY=()\n"
      << "  if ((COMP_CWORD == 1)); then\n    mapfile -t COMPREPLY < <(compgen -W \""
      << text::joined(command_names(program), " ") << " "
      << text::joined(flags_of(program.own), " ") << "\" -- \"$word\")\n    return\n  fi\n";
  write_bash_values(out, program);
  write_bash_commands(out, program);
  out << "  if [[ $word == -* ]]; then\n"
      << "    mapfile -t COMPREPLY < <(compgen -W \"$flags\" -- \"$word\")\n  else\n"
      << "    mapfile -t COMPREPLY < <(compgen -W \"$names\" -- \"$word\"; compgen -f -- "
      << "\"$word\")\n  fi\n}\n"
      << "complete -o filenames -F _contactcheck contactcheck\n";
  return out.str();
}

std::string zsh_completion(const ProgramWords& program) {
  std::ostringstream out;
  out << "#compdef contactcheck\n_contactcheck() {\n  local contactcheck=$words[1]\n"
      << "  local -a commands=(\n";
  for (const CommandWords& command : program.commands)
    out << "    '" << command.name << ":" << plain(command.summary) << "'\n";
  out << "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
      << "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (const CommandWords& command : program.commands) {
    out << "    " << command.name << ")\n      _arguments";
    for (const OptionWords& option : command.options) write_zsh_option(out, option);
    out << " ;;\n";
  }
  out << "  esac\n}\n_contactcheck \"$@\"\n";
  return out.str();
}

std::string fish_completion(const ProgramWords& program) {
  std::ostringstream out;
  out << "# fish completion for contactcheck\n";
  for (const CommandWords& command : program.commands) {
    out << "complete -c contactcheck -n __fish_use_subcommand -f -a " << command.name << " -d '"
        << plain(command.summary) << "'\n";
    for (const OptionWords& option : command.options) write_fish_option(out, command, option);
  }
  return out.str();
}

}  // namespace contactcheck::cli
