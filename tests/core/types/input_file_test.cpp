#include "core/types/input_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <iterator>
#include <string>

#include "core/types/check.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using testing::StrEq;
using testing::ThrowsMessage;

class InputFile : public testing::Test {
 protected:
  InputFile() {
    std::string name = (fs::temp_directory_path() / "contactcheck-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    folder_ = name;
    std::ofstream(folder_ / "file") << "text";
  }
  ~InputFile() override { fs::remove_all(folder_); }

  std::string fault(const char* name) const { return input_file_fault(folder_ / name); }
  std::string text(const char* name) const {
    std::ifstream in = open_input_file(folder_ / name, "thing");
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  fs::path folder_;
};

TEST_F(InputFile, RegularFilesAndLinksToThemAreOpened) {
  fs::create_symlink("file", folder_ / "link");
  for (const char* name : {"file", "link"}) {
    EXPECT_EQ(fault(name), "");
    EXPECT_EQ(text(name), "text");
  }
}

TEST_F(InputFile, WhatIsMissingIsSaid) {
  fs::create_symlink("nowhere", folder_ / "dangling");
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_EQ(fault("none"), " does not exist");
  EXPECT_EQ(fault("file/none"), " does not exist");
  EXPECT_EQ(fault("dangling"), " does not exist");
  EXPECT_EQ(fault("circle"), " cannot be read: Too many levels of symbolic links");
}

// The pipe has no writer: opening it would block.
TEST_F(InputFile, WhatIsNoRegularFileIsNamedAndNotOpened) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder_ / "link");
  fs::create_directory(folder_ / "folder");
  fs::create_symlink("/dev/zero", folder_ / "zeros");
  const int socket_fd = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  // A socket's path has at most 107 bytes, however long the folder's is.
  const int folder_fd = open(folder_.c_str(), O_PATH | O_DIRECTORY);
  const std::string path = "/proc/self/fd/" + std::to_string(folder_fd) + "/socket";
  path.copy(address.sun_path, path.size());
  ASSERT_EQ(bind(socket_fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  close(socket_fd);
  close(folder_fd);
  EXPECT_EQ(fault("pipe"), " is a pipe, not a regular file");
  EXPECT_EQ(fault("link"), " is a pipe, not a regular file");
  EXPECT_EQ(fault("folder"), " is a folder, not a regular file");
  EXPECT_EQ(fault("zeros"), " is a device, not a regular file");
  EXPECT_EQ(fault("socket"), " is a socket, not a regular file");
  EXPECT_THAT([&] { text("pipe"); },
              ThrowsMessage<InputError>(StrEq("thing is a pipe, not a regular file.")));
}

// Root may read everything, so root becomes another user for the attempt.
TEST_F(InputFile, WhatMayNotBeReadIsSaid) {
  fs::permissions(folder_, fs::perms::all);
  fs::permissions(folder_ / "file", fs::perms::none);
  const uid_t user = geteuid();
  if (user == 0) {
    ASSERT_EQ(seteuid(65534), 0);
  }
  EXPECT_THAT([&] { text("file"); },
              ThrowsMessage<InputError>(StrEq("thing cannot be read: Permission denied.")));
  ASSERT_EQ(seteuid(user), 0);
}

}  // namespace
}  // namespace contactcheck
