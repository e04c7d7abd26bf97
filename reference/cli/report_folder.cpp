#include "reference/cli/report_folder.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/report/formats/csv.h"
#include "reference/report/formats/html.h"
#include "reference/report/formats/markdown.h"
#include "reference/report/formats/view_bytes.h"
#include "reference/reproduce/reproduction_report.h"
#include "reference/results/results_file.h"
#include "reference/text/file_text.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

bool wanted(const std::string& format, const std::vector<std::string>& formats) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

// No other files: the folder is the user's.
void remove_old_plots(const fs::path& plots) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(plots, error))
    if (entry.path().extension() == ".svg") fs::remove(entry.path(), error);
  fs::remove(plots, error);  // where nothing is left
}

// Before anything is written: no report is better than a part of one.
void check_places(const fs::path& folder, const std::map<std::string, std::string>& files) {
  for (const auto& [name, text] : files) {
    std::error_code error;  // is told by the write
    if (fs::is_directory(folder / name, error))
      throw InputError("cannot write \"" + (folder / name).string() + "\": Is a directory.");
  }
}

}  // namespace

std::vector<std::string> all_report_formats() { return {"csv", "html", "md"}; }

void check_report_formats(const std::vector<std::string>& formats) {
  for (const std::string& format : formats)
    if (!wanted(format, all_report_formats()))
      throw InputError("--format \"" + format + "\" is not known; allowed: csv, html, md");
}

std::map<std::string, std::string> report_texts(const results::Results& results,
                                                const fs::path& folder,
                                                const std::vector<std::string>& formats,
                                                const std::optional<report::PaperPart>& paper) {
  std::map<std::string, std::string> files;
  if (wanted("md", formats)) files = report::report_files(results);
  if (wanted("csv", formats)) files["report.csv"] = report::csv_report(results);
  if (wanted("html", formats) && report::has_html_report())
    files["report.html"] = report::html_report(results, paper, report::view_bytes(results, folder));
  return files;
}

std::optional<report::PaperPart> paper_part_in(const fs::path& folder,
                                               const results::Results& results) {
  const fs::path file = folder / "reproduction.json";
  if (!fs::exists(file)) return std::nullopt;
  const std::string bytes = text::read_file_bytes(file, "reproduction file");
  const auto reproduction = nlohmann::ordered_json::parse(bytes, nullptr, false);
  if (!reproduction.is_object())
    throw InputError("\"" + file.string() + "\" is no JSON object: write it again, or remove it.");
  results::check_json_depth(bytes, file);
  // Another run into the same folder leaves the file of an earlier one there.
  const auto command = reproduction.find("command");
  if (command == reproduction.end() || *command != results.command) return std::nullopt;
  try {
    return reproduce::paper_part(reproduction);
  } catch (const nlohmann::json::exception&) {
    throw InputError("\"" + file.string() +
                     "\" is no reproduction as this version writes it: write it again, or remove "
                     "it.");
  }
}

std::string report_paths(const fs::path& folder, const std::map<std::string, std::string>& files) {
  std::string paths;
  for (const auto& [name, text] : files)
    if (name.starts_with("report."))
      paths += (paths.empty() ? "" : "  ") + (folder / name).string();
  if (!report::has_html_report()) paths += "  (no report.html: this program was built without npm)";
  return paths;
}

void write_report(const fs::path& folder, const std::map<std::string, std::string>& files) {
  check_places(folder, files);
  remove_old_plots(folder / "plots");
  for (const auto& [name, text] : files) {
    std::error_code error;  // is told by the write
    fs::create_directories((folder / name).parent_path(), error);
    write_file_atomically(folder / name, text);
  }
}

}  // namespace contactcheck::cli
