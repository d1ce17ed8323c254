#include "core/storage/atomic_file.h"

#include <gtest/gtest.h>

#include "core/model/errors.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_disk.h"

namespace limber {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::TemporaryFolder;
using test::write;

TEST(WriteFileAtomically, WritesAndReplaces) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.json", "first");
  write_file_atomically(folder / "a.json", std::string("second\0byte", 11));
  EXPECT_EQ(contents(folder / "a.json"), std::string("second\0byte", 11));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteFileAtomically, LeavesTheOldFileWhenItFails) {
  const TemporaryFolder folder;
  write(folder / "a.json", "old");
  {
    const test::TinyDisk disk(10);
    EXPECT_THROW(write_file_atomically(folder / "a.json", "much longer than ten bytes"),
                 InputError);
  }
  EXPECT_EQ(contents(folder / "a.json"), "old");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteFileAtomically, KeepsTheRightsOfTheOldFile) {
  const TemporaryFolder folder;
  write(folder / "a.json", "old");
  fs::permissions(folder / "a.json", fs::perms::owner_read | fs::perms::owner_write);
  write_file_atomically(folder / "a.json", "new");
  EXPECT_EQ(fs::status(folder / "a.json").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST(WriteFileAtomically, FollowsLinks) {
  const TemporaryFolder folder;
  write(folder / "real.json", "old");
  fs::create_symlink("real.json", folder / "link.json");
  write_file_atomically(folder / "link.json", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.json"));
  EXPECT_EQ(contents(folder / "real.json"), "new");
}

TEST(WriteFileAtomically, DoesNotReplaceADevice) {
  require_writable("/dev/null");
  write_file_atomically("/dev/null", "nothing");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(RequireWritable, LeavesNoTrace) {
  const TemporaryFolder folder;
  require_writable(folder / "a.json");
  EXPECT_EQ(folder.files(), 0u);
}

TEST(RequireWritable, RefusesFoldersAndMissingFolders) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  EXPECT_THROW(require_writable(folder / "sub"), InputError);
  EXPECT_THROW(require_writable(folder / "missing" / "a.json"), InputError);
  write(folder / "file", "");
  EXPECT_THROW(require_writable(folder / "file" / "a.json"), InputError);
}

TEST(RequireWritable, SaysWhatToDo) {
  const TemporaryFolder folder;
  try {
    require_writable(folder / "missing" / "a.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, (folder / "missing" / "a.json").string());
    EXPECT_EQ(error.diagnostic.remedy, "make the folder first or name another one");
  }
}

}  // namespace
}  // namespace limber
