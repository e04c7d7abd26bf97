// Each test points the process's own standard streams at files, as the supervisor does.
#include "reference/process/surroundings.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace contactcheck::process {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class OutputWatchTest : public testing::Test {
 protected:
  void SetUp() override {
    std::fflush(nullptr);
    for (int i = 0; i < 2; ++i) {
      saved_[i] = dup(i + 1);
      const int file = memfd_create("stream", 0);
      fcntl(file, F_SETFL, O_APPEND);
      dup2(file, i + 1);
      close(file);
    }
  }
  void TearDown() override {
    std::fflush(nullptr);
    for (int i = 0; i < 2; ++i) {
      dup2(saved_[i], i + 1);
      close(saved_[i]);
    }
  }
  static off_t size_of(int descriptor) {
    struct stat status = {};
    return fstat(descriptor, &status) == 0 ? status.st_size : -1;
  }

  int saved_[2] = {-1, -1};
};

TEST_F(OutputWatchTest, SilenceIsNothing) {
  OutputWatch watch(true);
  EXPECT_THAT(watch.take(), IsEmpty());
}

TEST_F(OutputWatchTest, GivesTheFirstLineOfEachStreamOnce) {
  OutputWatch watch(true);
  std::printf("one\ntwo\n");  // still in the buffer
  std::cerr << "three\n";
  EXPECT_THAT(watch.take(), ElementsAre("wrote to standard output: \"one\"",
                                        "wrote to standard error: \"three\""));
  EXPECT_THAT(watch.take(), IsEmpty());
  EXPECT_EQ(size_of(STDOUT_FILENO), 0);
}

TEST_F(OutputWatchTest, WhatComesNextStandsAtTheBeginning) {
  OutputWatch watch(true);
  std::cout << "first";
  watch.take();
  if (write(STDOUT_FILENO, "second", 6) != 6) FAIL();
  EXPECT_THAT(watch.take(), ElementsAre("wrote to standard output: \"second\""));
}

TEST_F(OutputWatchTest, TextWithoutAPrintableByteIsSaidToBeThat) {
  OutputWatch watch(true);
  std::printf("\x01\x02\n\n");
  EXPECT_THAT(watch.take(),
              ElementsAre("wrote to standard output: \"(nothing that can be printed)\""));
}

TEST_F(OutputWatchTest, ClosedDescriptorIsOpenedAgain) {
  OutputWatch watch(true);
  close(STDERR_FILENO);
  EXPECT_THAT(watch.take(), ElementsAre("closed or replaced standard error"));
  std::fputs("back\n", stderr);
  EXPECT_THAT(watch.take(), ElementsAre("wrote to standard error: \"back\""));
}

TEST_F(OutputWatchTest, ReplacedDescriptorIsPutBack) {
  OutputWatch watch(true);
  const int null = open("/dev/null", O_WRONLY);
  dup2(null, STDOUT_FILENO);
  close(null);
  EXPECT_THAT(watch.take(), ElementsAre("closed or replaced standard output"));
  std::printf("back\n");
  EXPECT_THAT(watch.take(), ElementsAre("wrote to standard output: \"back\""));
}

TEST_F(OutputWatchTest, LosingTheSecondDescriptorTooLeavesNoNumberFree) {
  OutputWatch watch(true);
  for (int fd = 100; fd < 110; ++fd) close(fd);
  close(STDERR_FILENO);
  EXPECT_THAT(watch.take(), ElementsAre("closed or replaced standard error"));
  EXPECT_GE(fcntl(STDERR_FILENO, F_GETFD), 0);
  std::printf("still watched\n");
  EXPECT_THAT(watch.take(), ElementsAre("wrote to standard output: \"still watched\""));
}

TEST_F(OutputWatchTest, InactiveWatchTouchesNothing) {
  OutputWatch watch(false);
  std::printf("mine\n");
  EXPECT_THAT(watch.take(), IsEmpty());
  std::fflush(stdout);
  EXPECT_EQ(size_of(STDOUT_FILENO), 5);
}

}  // namespace
}  // namespace contactcheck::process
