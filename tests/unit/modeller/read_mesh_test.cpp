#include "core/modeller/read_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "core/model/errors.h"
#include "core/modeller/mesh_defects.h"
#include "core/modeller/mesh_repair.h"
#include "core/modeller/run_apart.h"
#include "tests/support/meshes.h"

namespace limber {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

// A folder of this test's own that goes with it.
class ReadMesh : public testing::Test {
 protected:
  ReadMesh() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / ("limber_read_mesh_" + std::string(info->name()));
    fs::create_directories(folder_);
  }
  ~ReadMesh() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  std::string refusal(const std::string& name, double scale = 1.0) const {
    try {
      read_mesh(file(name), scale);
    } catch (const InputError& error) {
      return error.what();
    }
    return "read";
  }

  fs::path folder_;
};

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

const TriangleMesh& shape() {
  static const TriangleMesh mesh =
      test::moved(test::torus_mesh(2, 0.5, 16, 10), Vec3(1.0, 0.5, 0.25).asDiagonal(), {3, 1, -2});
  return mesh;
}

void expect_shape(const TriangleMesh& found, double scale) {
  const RepairedMesh joined = repaired(found);
  EXPECT_TRUE(mesh_defects(joined.mesh).closed());
  EXPECT_EQ(joined.mesh.triangles.size(), shape().triangles.size());
  EXPECT_EQ(joined.mesh.positions.size(), shape().positions.size());
  const SolidMoments a = solid_moments(found), b = solid_moments(shape());
  EXPECT_NEAR(a.volume / (b.volume * scale * scale * scale), 1.0, 1e-5);  // float32 in files
  EXPECT_LT((a.centre - scale * b.centre).norm(), 1e-5 * scale);
}

TEST_F(ReadMesh, ReadsWhatWasWrittenInEveryFormat) {
  test::write_obj(shape(), file("a.obj"));
  test::write_ply(shape(), file("b.ply"));
  test::write_ascii_stl(shape(), file("c.stl"));
  test::write_binary_stl(shape(), file("D.STL"));
  for (const char* name : {"a.obj", "b.ply", "c.stl", "D.STL"}) {
    SCOPED_TRACE(name);
    expect_shape(read_mesh(file(name)), 1.0);
    expect_shape(read_mesh(file(name), 0.001), 0.001);
  }
  EXPECT_EQ(read_mesh(file("a.obj")).name, "a");
}

// The mesh as it is, and mirrored in x and shifted: both outside out.
TEST_F(ReadMesh, AppliesTheTransformsOfNodes) {
  const TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 2, 3});
  test::write_gltf_twice(box, {10, 20, 30}, file("two.gltf"));
  const TriangleMesh found = read_mesh(file("two.gltf"));
  EXPECT_EQ(found.triangles.size(), 24u);
  const SolidMoments m = solid_moments(found);
  EXPECT_NEAR(m.volume, 12.0, 1e-5);
  EXPECT_LT((m.centre - 0.5 * (Vec3(0.5, 1, 1.5) + Vec3(9.5, 21, 31.5))).norm(), 1e-5);
}

// A stranger's mesh must not read what lies elsewhere, neither by its name nor through a link.
TEST_F(ReadMesh, ReadsFurtherFilesFromItsOwnFolderAlone) {
  fs::create_directories(file("own/below"));
  test::write_gltf_twice(test::box_mesh({0, 0, 0}, {1, 2, 3}), {3, 0, 0}, file("own/a.gltf"));
  const auto points_to = [&](const std::string& place) {
    std::ifstream in(file("own/a.gltf"));
    std::string text(std::istreambuf_iterator<char>(in), {});
    text.replace(text.find("a.bin"), 5, place);
    write_text(file("own/b.gltf"), text);
  };
  fs::copy(file("own/a.bin"), file("own/below/in.bin"));
  points_to("below/in.bin");
  EXPECT_EQ(read_mesh(file("own/b.gltf")).triangles.size(), 24u);
  fs::copy(file("own/a.bin"), file("outside.bin"));
  fs::create_symlink(file("outside.bin"), file("own/linked.bin"));
  for (const char* place : {"../outside.bin", "linked.bin"}) {
    points_to(place);
    EXPECT_THAT(refusal("own/b.gltf"), HasSubstr("a file that it names is not in its folder"));
  }
}

TEST_F(ReadMesh, CutsPolygonsAndLeavesLinesOut) {
  write_text(file("p.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 3\n");
  EXPECT_EQ(read_mesh(file("p.obj")).triangles.size(), 2u);
}

TEST_F(ReadMesh, NamesFileDefectAndRemedy) {
  EXPECT_THAT(refusal("none.obj"), HasSubstr("none.obj: there is no such file; check the path"));
  write_text(file("mesh.txt"), "v 0 0 0\n");
  EXPECT_THAT(refusal("mesh.txt"), HasSubstr("is not an OBJ, PLY, STL or glTF file"));
  fs::create_directory(file("folder.obj"));
  EXPECT_THAT(refusal("folder.obj"), HasSubstr("folder.obj: is a folder; name a file in it"));
  for (const char* name : {"empty.obj", "empty.ply", "empty.stl", "empty.gltf", "empty.glb"}) {
    write_text(file(name), "");
    EXPECT_THAT(refusal(name), HasSubstr(std::string(name) + ": is empty; export")) << name;
  }
  write_text(file("points.obj"), "v 0 0 0\nv 1 0 0\n");
  EXPECT_THAT(refusal("points.obj"), HasSubstr("points.obj: holds no triangles; export"));
  test::write_obj(shape(), file("a.obj"));
  EXPECT_THAT(refusal("a.obj", 0.0), HasSubstr("the scale is 0"));
  EXPECT_THAT(refusal("a.obj", std::numeric_limits<double>::quiet_NaN()), HasSubstr("scale"));
}

// Another format's bytes under a name of this one are refused, not guessed.
TEST_F(ReadMesh, ReadsOnlyWhatTheNameSays) {
  test::write_binary_stl(shape(), file("a.stl"));
  fs::rename(file("a.stl"), file("a.ply"));
  EXPECT_THAT(refusal("a.ply"), HasSubstr("a.ply: is cut short or is not a .ply file; write it"));
}

// Another user's, when the tests are run by one who may read all.
TEST_F(ReadMesh, NamesWantOfPermission) {
  test::write_obj(shape(), file("a.obj"));
  fs::permissions(file("a.obj"), fs::perms::none);
  const bool almighty = ::geteuid() == 0;
  if (almighty) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  const std::string text = refusal("a.obj");
  if (almighty) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_THAT(text, HasSubstr("may not be read by this user; give the user permission"));
}

// The second triangle has a corner 9 of 3.
TEST_F(ReadMesh, RefusesCornersThatTheFileDoesNotHave) {
  write_text(file("a.ply"),
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
             "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 9\n");
  EXPECT_THAT(refusal("a.ply"), HasSubstr("is cut short or is not a .ply file"));
}

// A sparse file: its size alone is looked at.
TEST_F(ReadMesh, RefusesHugeFiles) {
  write_text(file("huge.stl"), "solid");
  fs::resize_file(file("huge.stl"), kMostMeshBytes + 1);
  EXPECT_THAT(refusal("huge.stl"), HasSubstr("536870913 bytes"));
}

// What there is of a mesh of so many triangles: whether it is sound as far as it goes. Holes and
// copies are for mesh_lattice() to judge.
void expect_sound_part(const TriangleMesh& part, std::size_t whole) {
  EXPECT_FALSE(part.triangles.empty());
  EXPECT_LE(part.triangles.size(), whole);
  const MeshDefects defects = mesh_defects(part);
  EXPECT_EQ(defects.missing_corners, 0u);
  EXPECT_EQ(defects.non_finite_positions, 0u);
}

// Cut off anywhere: read in part, or refused with the file's name and a remedy.
TEST_F(ReadMesh, SurvivesTruncatedFiles) {
  const TriangleMesh ball = test::icosphere(1, 1);
  test::write_obj(ball, file("a.obj"));
  test::write_ply(ball, file("a.ply"));
  test::write_ascii_stl(ball, file("a.stl"));
  test::write_binary_stl(ball, file("b.stl"));
  test::write_gltf_twice(ball, {3, 0, 0}, file("a.gltf"));
  for (const char* name : {"a.obj", "a.ply", "a.stl", "b.stl", "a.gltf"}) {
    const std::string whole = contents(file(name));
    const std::size_t triangles = read_mesh(file(name)).triangles.size();
    int refused = 0;
    for (int tenth = 0; tenth < 10; ++tenth) {
      SCOPED_TRACE(testing::Message() << name << ", " << tenth << " tenths");
      write_text(file(name), whole.substr(0, whole.size() * tenth / 10));
      try {
        expect_sound_part(read_mesh(file(name)), triangles);
      } catch (const InputError& error) {
        ++refused;
        EXPECT_THAT(error.what(),
                    testing::AllOf(HasSubstr(std::string(name) + ": "), HasSubstr("; ")));
      }
    }
    EXPECT_GE(refused, 2) << name;  // more than the empty file
  }
}

// run_apart(): what the child returns, and that its end is not ours.
TEST(RunApart, HandsOverBytes) {
  const std::string large(1'000'000, 'x');
  const ApartResult result = run_apart([&] { return large + '\0' + "end"; });
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.bytes, large + '\0' + "end");
}

TEST(RunApart, OutlivesItsChild) {
  EXPECT_THAT(run_apart([]() -> std::string { std::abort(); }).failure, HasSubstr("crashed"));
  const ApartLimits brief{.memory_bytes = std::size_t{1} << 30, .seconds = 1};
  const auto endless = []() -> std::string {
    for (volatile bool again = true; again;) {
    }
    return "";
  };
  EXPECT_EQ(run_apart(endless, brief).failure, "it took too long");
}

// What a host may do to signals; undone at the end.
class HostSignals {
 public:
  explicit HostSignals(sighandler_t on_child) : before_(std::signal(SIGCHLD, on_child)) {
    sigset_t all;
    sigfillset(&all);
    sigdelset(&all, SIGCHLD);
    ::sigprocmask(SIG_BLOCK, &all, &mask_);
  }
  ~HostSignals() {
    ::sigprocmask(SIG_SETMASK, &mask_, nullptr);
    std::signal(SIGCHLD, before_);
  }

 private:
  sighandler_t before_;
  sigset_t mask_;
};

void reap_children(int) {
  while (::waitpid(-1, nullptr, WNOHANG) > 0) {
  }
}

TEST(RunApart, NeedsNoStatusOfItsChild) {
  for (sighandler_t on_child : {SIG_IGN, reap_children}) {
    const HostSignals host(on_child);
    const ApartResult result = run_apart([] { return std::string("bytes"); });
    EXPECT_EQ(result.failure, "");
    EXPECT_EQ(result.bytes, "bytes");
    EXPECT_EQ(run_apart([] { return std::string(); }).failure, "");
    EXPECT_NE(run_apart([]() -> std::string { std::abort(); }).failure, "");
  }
}

// Signals that the host blocks end the child nevertheless.
TEST(RunApart, EndsAChildOfAHostThatBlocksSignals) {
  const HostSignals host(SIG_DFL);
  const ApartLimits brief{.memory_bytes = std::size_t{1} << 30, .seconds = 1};
  const auto mask_is_empty = [] {
    sigset_t mask;
    ::sigprocmask(SIG_BLOCK, nullptr, &mask);
    return std::string(sigisemptyset(&mask) ? "empty" : "blocked");
  };
  EXPECT_EQ(run_apart(mask_is_empty, brief).bytes, "empty");
  const auto endless = []() -> std::string {
    for (volatile bool again = true; again;) {
    }
    return "";
  };
  EXPECT_EQ(run_apart(endless, brief).failure, "it took too long");
}

// One that blocks signals itself and takes no time of the processor is killed by the clock.
TEST(RunApart, KillsAChildThatHearsNothing) {
  const ApartLimits brief{.memory_bytes = std::size_t{1} << 30, .seconds = 1};
  const auto deaf = []() -> std::string {
    sigset_t all;
    sigfillset(&all);
    ::sigprocmask(SIG_BLOCK, &all, nullptr);
    ::sleep(60);
    return "woke up";
  };
  EXPECT_EQ(run_apart(deaf, brief).failure, "it took too long");
}

}  // namespace
}  // namespace limber
