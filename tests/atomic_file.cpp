#include "image/atomic_file.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>
#include <vector>

#include "error.h"
#include "image/read_file.h"
#include "support/error_of.h"
#include "support/folder.h"

using namespace airlight;
using airlight::test::error_of;
using testing::AnyOf;
using testing::EndsWith;

namespace {

/// While it lives, no file of this process grows beyond `bytes`: a full disk for everybody.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

}  // namespace

TEST(AtomicFile, appears_with_its_commit) {
  const test::Folder folder;
  AtomicFile file(folder / "a.txt");
  file.write("hello ");
  file.write("fog");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  file.commit();
  EXPECT_EQ(read_text(folder / "a.txt"), "hello fog");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, leaves_the_old_file_without_a_commit) {
  const test::Folder folder;
  write_text(folder / "a.txt", "old");
  {
    AtomicFile file(folder / "a.txt");
    file.write(std::string(1 << 20, 'x'));
  }
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, seeks_back_and_forth) {
  const test::Folder folder;
  AtomicFile file(folder / "a.bin");
  std::string expected(1'000'000, 'b');
  file.write(expected);
  file.write("end");
  EXPECT_EQ(file.position(), 1'000'003U);
  file.seek(5);
  file.write("XYZ");
  EXPECT_EQ(file.position(), 8U);
  file.seek(1'000'003);
  file.write("!");
  file.commit();
  expected.replace(5, 3, "XYZ");
  EXPECT_EQ(read_text(folder / "a.bin"), expected + "end!");
}

TEST(AtomicFile, has_the_permissions_of_an_ordinary_file_or_of_the_old_one) {
  const test::Folder folder;
  const auto mode = [](const std::filesystem::path& path) {
    struct stat status {};
    ::stat(path.c_str(), &status);
    return status.st_mode & 07777U;
  };
  const mode_t mask = ::umask(022);
  write_text(folder / "new", "");
  ::umask(mask);
  EXPECT_EQ(mode(folder / "new"), 0644U);
  ::chmod((folder / "new").c_str(), 0640);
  write_text(folder / "new", "again");
  EXPECT_EQ(mode(folder / "new"), 0640U);
}

TEST(AtomicFile, follows_links) {
  const test::Folder folder;
  std::filesystem::create_directory(folder / "there");
  std::filesystem::create_symlink("there/file", folder / "link");
  for (const char* text : {"made", "replaced"}) {
    write_text(folder / "link", text);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(read_text(folder / "there/file"), text);
  }
}

TEST(AtomicFile, does_not_replace_a_device) {
  write_text("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, writes_into_a_pipe_behind_a_link) {
  const test::Folder folder;
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(pipe[1]), folder / "a.txt");
  write_text(folder / "a.txt", "through");
  char read[16] = {};
  EXPECT_EQ(::read(pipe[0], read, sizeof read), 7);
  EXPECT_STREQ(read, "through");
  EXPECT_EQ(folder.files(), 1U);
  ::close(pipe[0]), ::close(pipe[1]);
}

TEST(AtomicFile, says_why_a_target_will_not_do) {
  const test::Folder folder;
  const std::string name = folder.path().string();
  EXPECT_EQ(error_of([&] { check_writable(folder / "no/a.txt"); }),
            name + "/no/a.txt: cannot be written: there is no folder " + name + "/no");
  EXPECT_EQ(error_of([&] { check_writable(folder.path()); }),
            name + ": cannot be written: it is a folder");
  EXPECT_EQ(error_of([&] { check_writable(name + "/"); }),
            name + "/: cannot be written: it is a folder");
  EXPECT_EQ(error_of([&] { check_writable(""); }),
            ": cannot be written: No such file or directory");
  write_text(folder / "file", "");
  EXPECT_EQ(error_of([&] { check_writable(folder / "file/a.txt"); }),
            name + "/file/a.txt: cannot be written: Not a directory");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, respects_what_is_read_only) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anything";
  const test::Folder folder;
  write_text(folder / "a.txt", "kept");
  ::chmod((folder / "a.txt").c_str(), 0444);
  EXPECT_THAT(error_of([&] { check_writable(folder / "a.txt"); }), EndsWith("Permission denied"));
  ::chmod(folder.path().c_str(), 0555);
  EXPECT_THAT(error_of([&] { check_writable(folder / "b.txt"); }), EndsWith("Permission denied"));
  ::chmod(folder.path().c_str(), 0755);
}

TEST(AtomicFile, leaves_nothing_after_the_next_file_whenever_it_was_killed) {
  const test::Folder folder;
  const std::filesystem::path target = folder / "a.txt";
  for (int life = 0; life < 100; ++life) {
    const pid_t child = ::fork();
    if (child == 0)
      while (true) write_text(target, "some text");
    std::this_thread::sleep_for(std::chrono::microseconds(1000 + 37 * life));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    if (std::filesystem::exists(target)) {
      EXPECT_EQ(read_text(target), "some text");
    }
    EXPECT_LE(folder.files(), 2U);
  }
  write_text(target, "the last");
  EXPECT_EQ(read_text(target), "the last");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, is_one_of_those_that_are_written_at_once) {
  const test::Folder folder;
  const std::filesystem::path target = folder / "a.txt";
  std::vector<std::jthread> writers;
  for (const char* text : {"one", "two", "three"})
    writers.emplace_back([&target, text] {
      for (int i = 0; i < 200; ++i) EXPECT_EQ(error_of([&] { write_text(target, text); }), "");
    });
  writers.clear();
  EXPECT_THAT(read_text(target), AnyOf("one", "two", "three"));
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, checking_leaves_nothing_behind) {
  const test::Folder folder;
  check_writable(folder / "a.txt");
  EXPECT_EQ(folder.files(), 0U);
  write_text(folder / "a.txt", "old");
  check_writable(folder / "a.txt");
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, reports_a_full_device_with_the_name_that_the_user_gave) {
  const test::Folder folder;
  std::filesystem::create_symlink("/dev/full", folder / "full.txt");
  EXPECT_EQ(error_of([&] { write_text(folder / "full.txt", "hello"); }),
            (folder / "full.txt").string() + ": cannot be written: No space left on device");
}

TEST(AtomicFile, leaves_the_old_file_when_the_disk_is_full) {
  const test::Folder folder;
  write_text(folder / "a.txt", "old");
  {
    const FileSizeLimit limit(100'000);
    EXPECT_EQ(error_of([&] { write_text(folder / "a.txt", std::string(1'000'000, 'x')); }),
              (folder / "a.txt").string() + ": cannot be written: File too large");
  }
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(AtomicFile, remembers_an_error_that_somebody_swallowed) {
  const test::Folder folder;
  AtomicFile file(folder / "a.txt");
  {
    const FileSizeLimit limit(100'000);
    EXPECT_THROW(file.write(std::string(1'000'000, 'x')), Error);
  }
  EXPECT_THROW(file.seek(0), Error);
  EXPECT_THROW(file.commit(), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
}

TEST(ReadFile, says_why_it_cannot) {
  const test::Folder folder;
  EXPECT_EQ(error_of([&] { read_file(folder / "sun.png"); }),
            (folder / "sun.png").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(error_of([&] { read_text(folder.path()); }),
            folder.path().string() + ": cannot be read: Is a directory");
}

TEST(ReadFile, gives_every_byte) {
  const test::Folder folder;
  std::string bytes(300'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = char(i * i >> 3);
  write_text(folder / "b", bytes);
  EXPECT_EQ(read_text(folder / "b"), bytes);
  EXPECT_EQ(read_file(folder / "b").size(), bytes.size());
}
