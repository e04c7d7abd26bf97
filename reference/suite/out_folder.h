// The folder that a run writes to.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::suite {

/// A folder of its own for jobs and answers, removed at the end whatever happens. Those that an
/// interrupted run has left behind are removed too.
class ScratchFolder {
 public:
  /// @throws InputError when `parent` cannot be written
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Makes the folders of cases, contacts and recordings. @throws InputError when `out` cannot be
/// written
void make_out_folders(const std::filesystem::path& out);

/// Where contacts/SCENE.json waits until the run is complete. @throws InputError
void make_contacts_folder(const std::filesystem::path& scratch);

/// Moves what `scenes` name from the scratch folder.
void move_contacts(const std::filesystem::path& out, const std::filesystem::path& scratch,
                   const std::vector<results::Scene>& scenes);

/// Removes the case files of earlier runs and nothing else.
void remove_old_cases(const std::filesystem::path& out);

/// Gives the case files that workers have written running numbers over the whole suite: in
/// `disagreements` they are named as move_cases will name them. Returns where they still stand.
std::vector<std::filesystem::path> number_cases(std::vector<results::Disagreement>& disagreements);
void move_cases(const std::filesystem::path& out, const std::vector<std::filesystem::path>& files);

/// Replaces a file that is there. @throws InputError when it cannot be
void copy_file_to(const std::filesystem::path& file, const std::filesystem::path& target);

/// @throws InputError when it cannot be
void rename_file(const std::filesystem::path& file, const std::filesystem::path& target);

}  // namespace contactcheck::suite
