#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <random>

#include "core/model/errors.h"
#include "core/storage/model_file.h"
#include "tests/support/blocks.h"
#include "tests/support/same_model.h"
#include "tests/support/temporary_folder.h"

// Files that nobody should have: damaged ones, and whole, well sealed ones with bad contents.

namespace limber {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::TemporaryFolder;
using testing::HasSubstr;

void seal_again(const fs::path& file, const std::string& kind = "model", int version = 1) {
  const int descriptor = ::open(file.c_str(), O_RDWR);
  seal(descriptor, kind, version, file);
  ::close(descriptor);
}

// What reading says; empty when it gave a model.
std::string complaint_of(const fs::path& file) {
  try {
    read_model(file);
  } catch (const InputError& error) {
    EXPECT_THAT(error.diagnostic.where, testing::StartsWith(file.string()));
    return error.diagnostic.text();
  }
  return "";
}

class HostileModelFile : public testing::Test {
 protected:
  HostileModelFile() {
    write_model(test::rich_model(), file_);
    good_ = contents(file_);
  }

  void overwrite(std::size_t at, char byte) {
    std::fstream out(file_, std::ios::binary | std::ios::in | std::ios::out);
    out.seekp(std::streamoff(at)).put(byte);
  }

  // Changes the file through HDF5, seals it again and expects a complaint.
  void expect_refused(const std::function<void(hid_t)>& change, const std::string& complaint) {
    test::write(file_, good_);
    const hid_t f = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(f, 0);
    change(f);
    ASSERT_GE(H5Fclose(f), 0);
    seal_again(file_);
    EXPECT_THAT(complaint_of(file_), HasSubstr(complaint));
  }

  const TemporaryFolder folder_;
  const fs::path file_ = folder_ / "a.limber";
  std::string good_;
};

struct NewArray {
  const char* path;
  hid_t type;
  std::vector<hsize_t> extents;
  std::function<void(hid_t)> change_properties = [](hid_t) {};
  bool written = true;
};

// Puts another array in the place of one.
void replace(hid_t file, const NewArray& array) {
  if (H5Lexists(file, array.path, H5P_DEFAULT) > 0) H5Ldelete(file, array.path, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(int(array.extents.size()), array.extents.data(), nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  array.change_properties(properties);
  const hid_t set =
      H5Dcreate2(file, array.path, array.type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  ASSERT_GE(set, 0) << array.path;
  if (array.written) {
    const std::vector<char> zeros(std::size_t(H5Sget_simple_extent_npoints(space)) * 8);
    EXPECT_GE(H5Dwrite(set, array.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data()), 0);
  }
  H5Dclose(set);
  H5Pclose(properties);
  H5Sclose(space);
}

// Overwrites one number of an array.
template <class T>
void put(hid_t file, const char* path, hid_t type, std::size_t at, T value) {
  const hid_t set = H5Dopen2(file, path, H5P_DEFAULT);
  ASSERT_GE(set, 0) << path;
  const hid_t space = H5Dget_space(set);
  std::vector<T> all(std::size_t(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), 0);
  all.at(at) = value;
  EXPECT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), 0);
  H5Sclose(space);
  H5Dclose(set);
}

void put_int(hid_t file, const char* path, std::size_t at, std::int64_t value) {
  put<std::int64_t>(file, path, H5T_NATIVE_INT64, at, value);
}
void put_double(hid_t file, const char* path, std::size_t at, double value) {
  put<double>(file, path, H5T_NATIVE_DOUBLE, at, value);
}

TEST_F(HostileModelFile, IsReadWhenOnlySealedAgain) {
  seal_again(file_);
  EXPECT_EQ(complaint_of(file_), "");
}

TEST_F(HostileModelFile, TruncatedAnywhere) {
  for (std::size_t size = good_.size(); size-- > 0;) {
    fs::resize_file(file_, size);
    ASSERT_NE(complaint_of(file_), "") << size;
  }
}

// The seal does not help here, HDF5 and the reader have to.
TEST_F(HostileModelFile, TruncatedAndSealed) {
  for (std::size_t size = good_.size() - 1; size > 512; size -= std::min<std::size_t>(size, 61)) {
    fs::resize_file(file_, size);
    seal_again(file_);
    ASSERT_NE(complaint_of(file_), "") << size;
  }
}

TEST_F(HostileModelFile, LongerThanItWas) {
  test::write(file_, contents(file_) + "x");
  EXPECT_THAT(complaint_of(file_), HasSubstr("checksum does not match"));
}

TEST_F(HostileModelFile, WithAnyByteChanged) {
  std::mt19937 random(1);
  for (std::size_t at = 0; at < good_.size(); at += at < 600 ? 1 : 7) {
    overwrite(at, static_cast<char>(good_[at] ^ static_cast<char>(1 + random() % 255)));
    ASSERT_NE(complaint_of(file_), "") << at;
    overwrite(at, good_[at]);
  }
}

// Whatever the bytes say: a valid model or a complaint, within a bounded time.
TEST_F(HostileModelFile, WithBytesChangedAndSealed) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(3);
  std::mt19937 random(2);
  std::size_t models = 0, complaints = 0;
  for (int run = 0; run < 3000 && Clock::now() < end; ++run) {
    std::vector<std::size_t> places(1 + random() % 4);
    for (std::size_t& at : places) {
      at = 512 + random() % (good_.size() - 512);
      overwrite(at, static_cast<char>(random()));
    }
    seal_again(file_);
    ++(complaint_of(file_).empty() ? models : complaints);
    for (std::size_t at : places) overwrite(at, good_[at]);
  }
  EXPECT_GT(models, 0u);
  EXPECT_GT(complaints, 0u);
}

TEST_F(HostileModelFile, OfAnotherKindOrVersion) {
  seal_again(file_, "model", 2);
  EXPECT_THAT(complaint_of(file_), HasSubstr("version 2, this is known up to version 1; use a "
                                             "newer Limber"));
  seal_again(file_, "recording");
  EXPECT_THAT(complaint_of(file_), HasSubstr("of the kind 'recording'"));
  expect_refused(
      [](hid_t f) {
        const hid_t a = H5Aopen(f, "version", H5P_DEFAULT);
        const int version = 3;
        H5Awrite(a, H5T_NATIVE_INT, &version);
        H5Aclose(a);
      },
      "version 3");
  expect_refused([](hid_t f) { H5Adelete(f, "format"); }, "has no attribute 'format'");
}

TEST_F(HostileModelFile, NotAModelFileAtAll) {
  EXPECT_THAT(complaint_of(folder_ / "missing"), HasSubstr("No such file"));
  EXPECT_THAT(complaint_of(folder_ / ""), HasSubstr("is no regular file"));
  EXPECT_THAT(complaint_of("/dev/zero"), HasSubstr("is no regular file"));
  test::write(file_, "");
  EXPECT_THAT(complaint_of(file_), HasSubstr("is empty"));
  test::write(file_, "{\"json\": true}");
  EXPECT_THAT(complaint_of(file_), HasSubstr("is not a file of Limber's"));
  test::write(file_, "limber model 1\n");
  seal_again(file_);
  EXPECT_THAT(complaint_of(file_), HasSubstr("holds no HDF5 where it should"));
  H5Fclose(H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_THAT(complaint_of(file_), HasSubstr("is an HDF5 file, but not one of Limber's"));
}

TEST_F(HostileModelFile, WithoutAnArray) {
  for (const char* path :
       {"name", "object/friction", "points/position", "points/mass", "edges/ends",
        "edges/stiffness", "edges/damping", "edges/rest_length", "faces/corners",
        "cells/edge_start", "cells/edges", "cells/face_start", "cells/faces",
        "subobjects/name_start", "subobjects/point_range", "values/name", "skins/vertex_host"})
    expect_refused([&](hid_t f) { H5Ldelete(f, path, H5P_DEFAULT); },
                   std::string(path) + ": is missing");
}

TEST_F(HostileModelFile, WithAnArrayTooMany) {
  expect_refused(
      [](hid_t f) {
        replace(f, {"points/velocty", H5T_IEEE_F64LE, {3}});
      },
      "points/velocty: does not belong into such a file");
}

TEST_F(HostileModelFile, WithTheWrongTypeOrShape) {
  const hsize_t n = test::rich_model().points.size();
  expect_refused(
      [&](hid_t f) {
        replace(f, {"points/mass", H5T_IEEE_F32LE, {n}});
      },
      "points/mass: does not hold");
  expect_refused(
      [&](hid_t f) {
        replace(f, {"points/mass", H5T_STD_I64LE, {n}});
      },
      "points/mass: holds int64, not float64");
  expect_refused(
      [&](hid_t f) {
        replace(f, {"points/mass", H5T_IEEE_F64LE, {n + 1}});
      },
      "points/mass: has ");
  expect_refused(
      [&](hid_t f) {
        replace(f, {"points/mass", H5T_IEEE_F64LE, {n, 1}});
      },
      "points/mass: has ");
  expect_refused(
      [&](hid_t f) {
        replace(f, {"points/position", H5T_IEEE_F64LE, {n, 2}});
      },
      "points/position: has ");
  expect_refused(
      [&](hid_t f) {
        replace(f, {"points/position", H5T_IEEE_F64LE, {n, 3, 1}});
      },
      "points/position: is not a list or a table");
  expect_refused(
      [&](hid_t f) {
        replace(f, {"cells/edge_start", H5T_STD_I64LE, {0}});
      },
      "cells/edge_start: has ");
}

// They claim what the file does not hold.
TEST_F(HostileModelFile, WithAbsurdSizes) {
  const auto claim = [](hsize_t rows) {
    return [rows](hid_t f) {
      replace(f, {.path = "points/position",
                  .type = H5T_IEEE_F64LE,
                  .extents = {rows, 3},
                  .written = false});
    };
  };
  expect_refused(claim(1000000000000000), "points/position: claims 1000000000000000 x 3 numbers");
  expect_refused(claim(2147483647), "points/position: claims 2147483647 x 3 numbers, more than");
  expect_refused(claim(5000), "points/position: claims");
  expect_refused(claim(10), "points/position: is not wholly in the file");
}

TEST_F(HostileModelFile, StoredInAnotherWay) {
  const hsize_t n = test::rich_model().points.size();
  const auto mass = [&](std::function<void(hid_t)> properties) {
    return [=](hid_t f) { replace(f, {"points/mass", H5T_IEEE_F64LE, {n}, properties}); };
  };
  expect_refused(mass([](hid_t p) { H5Pset_layout(p, H5D_COMPACT); }), "not stored contiguously");
  expect_refused(mass([&](hid_t p) {
                   H5Pset_chunk(p, 1, &n);
                   H5Pset_deflate(p, 9);
                 }),
                 "points/mass: is not stored contiguously");
  const std::string outside = (folder_ / "outside").string();
  expect_refused(mass([&](hid_t p) { H5Pset_external(p, outside.c_str(), 0, 8 * n); }),
                 "points/mass: is stored in another file");
}

TEST_F(HostileModelFile, WithLinksAndThingsThatAreNoArrays) {
  const auto remove_mass = [](hid_t f) { H5Ldelete(f, "points/mass", H5P_DEFAULT); };
  expect_refused(
      [&](hid_t f) {
        remove_mass(f);
        H5Lcreate_external("/etc/passwd", "/mass", f, "points/mass", H5P_DEFAULT, H5P_DEFAULT);
      },
      "points: has with 'mass' a link to something elsewhere");
  expect_refused(
      [&](hid_t f) {
        remove_mass(f);
        H5Lcreate_soft("/points/mass", f, "points/mass", H5P_DEFAULT, H5P_DEFAULT);
      },
      "points: has with 'mass' a link to something elsewhere");
  expect_refused(
      [](hid_t f) { H5Lcreate_hard(f, "/", f, "points/loop", H5P_DEFAULT, H5P_DEFAULT); },
      "points/loop: is there under two names");
  expect_refused([](hid_t f) { H5Lcreate_hard(f, "/", f, "loop", H5P_DEFAULT, H5P_DEFAULT); },
                 "loop: is there under two names");
}

TEST_F(HostileModelFile, WithImpossibleIndices) {
  for (std::int64_t wrong : {-1L, -2147483648L, 1000000L, 2147483647L}) {
    expect_refused([&](hid_t f) { put_int(f, "edges/ends", 3, wrong); }, "G1 end point");
    expect_refused([&](hid_t f) { put_int(f, "faces/corners", 3, wrong); }, "G1 corner point");
    expect_refused([&](hid_t f) { put_int(f, "cells/edges", 3, wrong); }, "G1 edge");
    expect_refused([&](hid_t f) { put_int(f, "cells/faces", 3, wrong); }, "G1 face");
    expect_refused([&](hid_t f) { put_int(f, "subobjects/point_range", 1, wrong); }, "G9");
    expect_refused([&](hid_t f) { put_int(f, "cells/edge_start", 1, wrong); },
                   "cells/edge_start: has " + std::to_string(wrong) + " at entry 1");
    expect_refused([&](hid_t f) { put_int(f, "subobjects/name_start", 0, wrong); },
                   "subobjects/name_start: has ");
    expect_refused([&](hid_t f) { put_int(f, "skins/cell", 0, wrong); }, "S1 ");
    expect_refused([&](hid_t f) { put_int(f, "skins/cell_corners", 9, wrong); }, "S1 ");
    expect_refused([&](hid_t f) { put_int(f, "skins/vertex_host", 1, wrong); }, "S1 ");
    expect_refused([&](hid_t f) { put_int(f, "skins/triangle_corners", 3, wrong); }, "S1 ");
    expect_refused([&](hid_t f) { put_int(f, "skins/triangle_owner", 0, wrong); }, "S1 ");
  }
  expect_refused([](hid_t f) { put_int(f, "cells/face_start", 2, 3); }, "cells/face_start: has 3");
}

TEST_F(HostileModelFile, WithImpossibleNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused([&](hid_t f) { put_double(f, "points/position", 4, nan); }, "G10 position");
  expect_refused([&](hid_t f) { put_double(f, "points/mass", 1, nan); }, "P2 mass");
  expect_refused([&](hid_t f) { put_double(f, "edges/break_threshold", 1, nan); }, "P6");
  expect_refused([&](hid_t f) { put_double(f, "object/softening", 0, nan); }, "P9 softening");
  expect_refused([&](hid_t f) { put_double(f, "skins/vertex_place", 1, nan); }, "S3 ");
  expect_refused([](hid_t f) { put_int(f, "points/pinned", 2, 2); },
                 "points/pinned: has 2 at entry 2");
  expect_refused([](hid_t f) { put_int(f, "faces/drag_law", 5, 3); },
                 "faces/drag_law: has 3 at entry 5");
}

TEST_F(HostileModelFile, IsNoticedWhenNotSealedAgain) {
  const hid_t f = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  put_double(f, "points/mass", 0, 7.0);
  H5Fclose(f);
  EXPECT_THAT(complaint_of(file_), HasSubstr("checksum does not match"));
}

}  // namespace
}  // namespace limber
