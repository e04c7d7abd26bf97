#include "reference/cli/man_page.h"

#include <sstream>

#include "reference/text/lists.h"

namespace contactcheck::cli {
namespace {

// A dash that is typed, a backslash, and a dot or quote that must not be a request.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  if (!out.empty() && (out[0] == '.' || out[0] == '\'')) out.insert(0, "\\&");
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string slanted(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string option_heading(const OptionWords& option) {
  std::string heading = text::joined(option.flags, [&](const std::string& flag) {
    return option.positional ? slanted(flag) : bold(flag);
  });
  if (!option.value.empty()) heading += " " + slanted(option.value);
  return heading;
}

void write_option(std::ostream& out, const OptionWords& option) {
  out << ".TP\n" << option_heading(option) << "\n" << escaped(option.help);
  if (option.required) out << " (required)";
  out << "\n";
}

// Sentences as they run, examples line by line.
void write_footer(std::ostream& out, const std::string& footer) {
  std::istringstream lines(footer);
  bool examples = false;
  for (std::string line; std::getline(lines, line);) {
    const bool example = line.starts_with("  ");
    if (example && !examples) out << ".PP\n.RS\n.nf\n";
    if (!example && examples) out << ".fi\n.RE\n";
    if (!example) out << ".PP\n";
    out << escaped(example ? line.substr(2) : line) << "\n";
    examples = example;
  }
  if (examples) out << ".fi\n.RE\n";
}

std::string synopsis(const ProgramWords& program, const CommandWords& command) {
  std::string line = bold(program.name) + " " + bold(command.name);
  bool optional = false;
  for (const OptionWords& option : command.options) {
    if (!option.positional)
      optional = true;
    else
      line += " " + (option.required ? slanted(option.flags[0])
                                     : "[" + slanted(option.flags[0]) + "...]");
  }
  return optional ? line + " [" + slanted("options") + "]" : line;
}

void write_command(std::ostream& out, const ProgramWords& program, const CommandWords& command) {
  out << ".SS " << synopsis(program, command) << "\n" << escaped(command.summary) << ".\n";
  for (const OptionWords& option : command.options)
    if (option.flags.back() != "--help") write_option(out, option);
  write_footer(out, command.footer);
}

constexpr const char* kSurroundings =
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBCONTACTCHECK_FIXTURES\\fR\n"
    "Folder of scenes, suites, hard cases, policies and baselines, in place of the installed one.\n"
    ".TP\n\\fBCONTACTCHECK_DATA\\fR\n"
    "Folder that stands for / when the meshes of Debian's packages libcgal\\-demo and\n"
    "povray\\-examples are looked for.\n"
    ".TP\n\\fBXDG_CACHE_HOME\\fR\n"
    "Where these packages were unpacked, in its folder contactcheck (default ~/.cache).\n"
    ".SH FILES\n"
    ".TP\n\\fIout/results.json\\fR\n"
    "What a run found; report, gate, diff and accept read it.\n"
    ".TP\n\\fIout/report.html\\fR, \\fIout/report.md\\fR, \\fIout/report.csv\\fR\n"
    "The same for people.\n"
    ".TP\n\\fIout/cases/\\fR, \\fIout/recordings/\\fR, \\fIout/contacts/\\fR\n"
    "Disagreements one by one, every frame of every scene, and all contacts.\n";

}  // namespace

std::string man_page(const ProgramWords& program) {
  std::ostringstream out;
  out << ".TH CONTACTCHECK 1 \"\" \"" << program.name << " " << program.version << "\" \"\"\n"
      << ".SH NAME\n"
      << program.name << " \\- judges collision detectors of deformable bodies\n"
      << ".SH SYNOPSIS\n"
      << bold(program.name) << " " << slanted("command") << " [" << slanted("options") << "]\n"
      << ".SH DESCRIPTION\n"
      << escaped(program.own.summary) << "\n";
  for (const OptionWords& option : program.own.options) write_option(out, option);
  out << ".SH COMMANDS\n";
  for (const CommandWords& command : program.commands) write_command(out, program, command);
  out << ".SH EXIT STATUS\n";
  write_footer(out, program.own.footer);
  out << kSurroundings;
  return out.str();
}

}  // namespace contactcheck::cli
