#include "reference/suite/out_folder.h"

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "core/types/check.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = ".work";

// A run that was interrupted leaves its folder behind; its process is gone.
void remove_abandoned(const fs::path& parent) {
  for (const auto& entry : fs::directory_iterator(parent)) {
    const std::string name = entry.path().filename().string();
    const std::string digits = name.rfind(kPrefix, 0) == 0 ? name.substr(std::strlen(kPrefix)) : "";
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos) continue;
    std::error_code ignored;
    if (!fs::exists("/proc/" + digits)) fs::remove_all(entry.path(), ignored);
  }
}

// A case file of an earlier run: NNNN.json. Anything else in the folder is not ours.
bool is_case_file(const fs::path& file) {
  const std::string stem = file.stem().string();
  return file.extension() == ".json" && stem.size() >= 4 &&
         stem.find_first_not_of("0123456789") == std::string::npos;
}

void make_folder(const fs::path& parent, const char* name) {
  std::error_code error;
  fs::create_directories(parent / name, error);
  if (error) throw InputError("cannot write in " + parent.string() + ": " + error.message());
}

// From 1.
std::string case_name(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "cases/%04zu.json", number);
  return name;
}

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& parent)
    : path_(parent / (kPrefix + std::to_string(getpid()))) {
  remove_abandoned(parent);
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw InputError("cannot write in " + parent.string() + ": " + error.message());
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void make_out_folders(const fs::path& out) {
  for (const char* folder : {"cases", "contacts", "recordings"}) make_folder(out, folder);
}

void make_contacts_folder(const fs::path& scratch) { make_folder(scratch, "contacts"); }

void move_contacts(const fs::path& out, const fs::path& scratch,
                   const std::vector<results::Scene>& scenes) {
  for (const results::Scene& scene : scenes)
    if (!scene.contacts.empty()) rename_file(scratch / scene.contacts, out / scene.contacts);
}

void remove_old_cases(const fs::path& out) {
  std::error_code ignored;  // what stays is no longer named by any result
  for (const auto& entry : fs::directory_iterator(out / "cases"))
    if (entry.is_regular_file() && is_case_file(entry.path())) fs::remove(entry.path(), ignored);
}

std::vector<fs::path> number_cases(std::vector<results::Disagreement>& disagreements) {
  std::vector<fs::path> files;
  for (results::Disagreement& d : disagreements) {
    files.emplace_back(d.case_file);
    d.case_file = case_name(files.size());
  }
  return files;
}

void move_cases(const fs::path& out, const std::vector<fs::path>& files) {
  for (std::size_t i = 0; i < files.size(); ++i) rename_file(files[i], out / case_name(i + 1));
}

void copy_file_to(const fs::path& file, const fs::path& target) {
  std::error_code error;
  fs::copy_file(file, target, fs::copy_options::overwrite_existing, error);
  if (error) throw InputError("cannot write \"" + target.string() + "\": " + error.message());
}

void rename_file(const fs::path& file, const fs::path& target) {
  std::error_code error;
  fs::rename(file, target, error);
  if (error) throw InputError("cannot write \"" + target.string() + "\": " + error.message());
}

}  // namespace contactcheck::suite
