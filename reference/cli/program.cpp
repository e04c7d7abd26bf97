#include "reference/cli/program.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "core/types/suggestion.h"
#include "reference/cli/arguments.h"
#include "reference/process/exit_codes.h"
#include "reference/process/interrupts.h"
#include "reference/suite/worker.h"
#include "reference/text/printable.h"
#include "reference/text/shell_word.h"

namespace contactcheck::cli {
namespace {

// For the record, to be run again.
std::string join_command_line(int argc, char** argv) {
  std::string text = "contactcheck";
  for (int i = 1; i < argc; ++i) text += " " + text::in_shell(argv[i]);
  return text;
}

// One line, whatever the input that it quotes holds.
void say(const std::string& sentence) {
  std::string line = sentence;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  std::fprintf(stderr, "contactcheck: %s\n", line.c_str());
}

// Paths and names go into JSON, which takes UTF-8 alone.
void require_utf8(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) try {
      nlohmann::json(argv[i]).dump();
    } catch (const nlohmann::json::exception&) {
      throw InputError("word " + std::to_string(i) + " of the command line is not UTF-8: \"" +
                       text::printable_line(argv[i]) + "\"");
    }
}

// A file that is opened while a standard stream is closed would take the stream's number, and what
// is printed would go into that file. These descriptors take the numbers and refuse to be used.
void keep_numbers_of_closed_streams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(fd, F_GETFD) < 0) open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// A full disk, a closed stream: a list that is cut short is no list.
void require_output_written() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  // A write that failed earlier has left no reason behind; one more brings it back.
  const bool works_again = errno == 0 && write(STDOUT_FILENO, "\n", 1) == 1;
  throw InputError(std::string("cannot write to standard output: ") +
                   (works_again ? "an earlier write failed" : std::strerror(errno)));
}

// What may have been meant by a flag: one that differs little, or of which it is a longer form.
std::string flag_suggestion(const std::string& word, const CLI::App& command) {
  const std::string flag = word.substr(0, word.find('='));
  std::vector<std::string> flags;
  std::string shorter;
  for (const CLI::Option* const option : command.get_options())
    for (const std::string& name : option->get_lnames()) {
      flags.push_back("--" + name);
      if (flag.starts_with(flags.back()) && flags.back().size() > shorter.size())
        shorter = flags.back();
    }
  const std::string near = suggestion(flag, flags);
  return near.empty() && !shorter.empty() ? "did you mean " + shorter + "? " : near;
}

int refuse(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::vector<std::string> rest = command.remaining();
  // CLI11 would say that a subcommand is missing, and not which word it does not know.
  if (!rest.empty() && rest.front().starts_with("-")) {
    say("unknown flag \"" + rest.front() + "\"; " + flag_suggestion(rest.front(), command) +
        "contactcheck " + (chosen.empty() ? "" : command.get_name() + " ") + "--help names all");
  } else if (chosen.empty() && !rest.empty()) {
    std::vector<std::string> names;
    for (const CLI::App* const one : app.get_subcommands([](const CLI::App*) { return true; }))
      if (!one->get_group().empty()) names.push_back(one->get_name());
    say("unknown command \"" + rest.front() + "\"; " + suggestion(rest.front(), names) +
        "contactcheck --help names all");
  } else if (error.get_name() == "RequiredError") {
    say(chosen.empty() ? "which command? contactcheck --help names all"
                       : std::string(error.what()) + "; contactcheck " +
                             chosen.front()->get_name() + " --help says more");
  } else {
    say(error.what());
  }
  return process::kExitBadInput;
}

int parse_and_dispatch(int argc, char** argv, const DetectorCatalog& catalog) {
  CLI::App app;
  CommandLine line{app, catalog, join_command_line(argc, argv), {}};
  describe_program(line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code() == 0 ? app.exit(e) : refuse(app, e);
  }
  return line.chosen();
}

// A worker's streams are its supervisor's to look after.
bool is_worker(int argc, char** argv) {
  constexpr const char* kHidden[] = {"worker", "probe", "examine", "query-worker"};
  return argc > 1 && std::any_of(std::begin(kHidden), std::end(kHidden),
                                 [&](const char* name) { return std::strcmp(argv[1], name) == 0; });
}

int main_with_errors(int argc, char** argv, const DetectorCatalog& catalog) {
  keep_numbers_of_closed_streams();
  // A file that meets a limit is a failed write with a sentence of its own, and no death.
  signal(SIGXFSZ, SIG_IGN);
  try {
    require_utf8(argc, argv);
    const int code = parse_and_dispatch(argc, argv, catalog);
    if (!is_worker(argc, argv)) require_output_written();
    return code;
  } catch (const InputError& e) {
    say(e.what());
  } catch (const std::filesystem::filesystem_error& e) {
    say(e.path1().string() + ": " + e.code().message());
  }
  return process::kExitBadInput;
}

}  // namespace

int contactcheck_main(int argc, char** argv, const DetectorCatalog& catalog) {
  try {
    return main_with_errors(argc, argv, catalog);
  } catch (const process::Interrupted& e) {
    process::die_of(e);
  } catch (const std::bad_alloc&) {
    say("memory ran out: this takes more than the process may have");
    return process::kExitBadInput;
  } catch (const std::exception& e) {
    say(std::string("internal error: ") + e.what());
    return process::kExitInternal;
  }
}

}  // namespace contactcheck::cli
