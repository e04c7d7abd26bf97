#include "reference/check/check_log.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "core/types/check.h"
#include "core/types/hash.h"
#include "reference/results/results.h"

namespace contactcheck::check {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "contactcheck-checked/1";

}  // namespace

CheckLog CheckLog::read(const fs::path& file) {
  CheckLog out;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  // A line without its end was being written when the program was killed.
  while (std::getline(in, line) && !in.eof()) {
    try {
      const Json json = Json::parse(line);
      if (out.empty()) {
        if (json.at("schema") != kSchema) return {};
        out.identity = json.at("identity").get<std::string>();
        out.command = json.at("command").get<std::string>();
      } else if (json.contains("exit_code")) {
        out.ended = true;
      } else {
        CheckedFrame frame = checked_frame(json);
        if (frame.frame != out.frames.size()) return out;
        out.frames.push_back(std::move(frame));
      }
    } catch (const Json::exception&) {
      return out;  // what follows damage may be of anything
    }
  }
  return out;
}

std::string stamp_of(const std::vector<fs::path>& files) {
  Fnv1a hash;
  for (const fs::path& file : files) {
    const std::string path = fs::absolute(file).string();
    hash.bytes(path.data(), path.size());
    std::error_code missing;  // whoever reads it reports it
    hash.value(static_cast<std::uint64_t>(fs::file_size(file, missing)));
    hash.value(
        static_cast<std::int64_t>(fs::last_write_time(file, missing).time_since_epoch().count()));
  }
  return results::hex(hash.digest());
}

CheckLogWriter::CheckLogWriter(const fs::path& file, const std::string& identity,
                               const std::string& command, const std::vector<CheckedFrame>& taken)
    : path_(file) {
  const fs::path fresh = file.string() + ".new";
  file_.reset(std::fopen(fresh.c_str(), "wb"));
  if (file_ == nullptr) fail();
  line({{"schema", kSchema}, {"identity", identity}, {"command", command}});
  for (const CheckedFrame& frame : taken) add(frame);
  if (std::rename(fresh.c_str(), file.c_str()) != 0) fail();
}

void CheckLogWriter::fail() const {
  throw InputError("\"" + path_.string() + "\" cannot be written: " + std::strerror(errno));
}

void CheckLogWriter::add(const CheckedFrame& frame) { line(to_json(frame)); }

void CheckLogWriter::end(int exit_code) { line({{"exit_code", exit_code}}); }

void CheckLogWriter::line(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() ||
      std::fflush(file_.get()) != 0)
    fail();
}

}  // namespace contactcheck::check
