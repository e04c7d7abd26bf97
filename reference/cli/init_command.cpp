#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "init_files.h"
#include "reference/cli/commands.h"
#include "reference/text/file_text.h"
#include "reference/text/lists.h"
#include "reference/text/shell_word.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

/// A language that a detector can be begun in.
struct Language {
  const char* name;
  const char* file;      ///< of init_files, and in the folder
  const char* build;     ///< a command; empty: none
  const char* detector;  ///< words of `run`
};

constexpr const char* kHeader = "contactcheck_plugin.h";
constexpr Language kLanguages[] = {
    {"python", "detector.py", "", "--detector-cmd \"python3 detector.py\""},
    {"c", "detector.c", "cc -O2 -shared -fPIC detector.c -o libdetector.so",
     "--detector ./libdetector.so"},
    {"c++", "detector.cpp", "c++ -O2 -shared -fPIC detector.cpp -o libdetector.so",
     "--detector ./libdetector.so"},
    {"javascript", "detector.mjs", "", "--detector-cmd \"node detector.mjs\""}};

std::string text_of(std::string_view name) {
  for (const InitFile& file : kInitFiles)
    if (file.name == name) return std::string(file.text);
  CONTACTCHECK_INVARIANT(false, "all files of init are built in");
  return "";
}

void replace(const std::string& word, const std::string& by, std::string& text) {
  text.replace(text.find(word), word.size(), by);
}

std::string workflow(const Language& language) {
  std::string text = text_of("contactcheck.yml");
  const std::string build = language.build;
  replace("BUILD", build.empty() ? "" : "      - run: " + build + "\n", text);
  replace("DETECTOR", language.detector, text);
  return text;
}

const Language& language_of(const std::string& name) {
  for (const Language& language : kLanguages)
    if (name == language.name) return language;
  throw InputError("--language: " + text::in_quotes(name) + " is not one of " +
                   text::joined(kLanguages, [](const Language& l) { return std::string(l.name); }));
}

}  // namespace

int init_command(const fs::path& folder, const std::string& language_name) {
  const Language& language = language_of(language_name);
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error))
    throw InputError(text::in_quotes(folder.string()) +
                     " is there already and is not written over");
  const bool compiled = *language.build != '\0';
  std::vector<std::pair<fs::path, std::string>> files = {
      {"scene.json", text_of("scene.json")},
      {language.file, text_of(language.file)},
      {"policy.json", text_of("policy.json")},
      {".github/workflows/contactcheck.yml", workflow(language)}};
  if (compiled) files.emplace_back(kHeader, text_of(kHeader));
  for (const auto& [name, text] : files) {
    fs::create_directories((folder / name).parent_path(), error);
    if (error) throw InputError("cannot write in " + folder.string() + ": " + error.message());
    write_file_atomically(folder / name, text);
    std::printf("%s\n", (folder / name).c_str());
  }
  // Where it was called by a path, that path: after a build it is on no other.
  fs::path program = program_invocation_name;
  if (program.has_parent_path()) program = fs::absolute(program).lexically_normal();
  const std::string called = text::in_shell(program.string());
  std::printf(
      "\nThe detector compares boxes, which is wrong: the gate is red until it looks closer.\n"
      "next:\n  cd %s\n%s  %s run scene.json %s --detector fcl-aabb\n"
      "  %s gate out/results.json --policy policy.json\n",
      text::in_shell(folder.string()).c_str(),
      compiled ? ("  " + std::string(language.build) + "\n").c_str() : "", called.c_str(),
      language.detector, called.c_str());
  return 0;
}

}  // namespace contactcheck::cli
