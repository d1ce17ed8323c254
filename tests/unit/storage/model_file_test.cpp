#include "core/storage/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/model/errors.h"
#include "core/operators/breaking_operator.h"
#include "core/operators/gluing_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"
#include "tests/support/same_model.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_disk.h"

namespace limber {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::TemporaryFolder;
using testing::HasSubstr;

void expect_round_trip(const PhysicalModel& model) {
  const TemporaryFolder folder;
  write_model(model, folder / "a.limber");
  test::expect_same_model(read_model(folder / "a.limber"), model);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(ModelFile, KeepsEveryFieldToTheBit) { expect_round_trip(test::rich_model()); }

TEST(ModelFile, KeepsModelsOfEveryDimension) {
  expect_round_trip(test::chain({.points = 5}));
  expect_round_trip(test::sheet(3, false));
  expect_round_trip(test::sheet(3, true));
  expect_round_trip(test::block({.cells = {2, 3, 1}}));
}

TEST(ModelFile, KeepsPointsWithoutAnything) {
  GeometricModelBuilder builder;
  builder.begin_subobject("grain");
  builder.add_point({1, 2, 3});
  expect_round_trip(test::with_plausible_attributes(builder.finish(), "sand"));
}

TEST(ModelFile, KeepsAModelOfNothing) { expect_round_trip(PhysicalModel()); }

TEST(ModelFile, KeepsGluedMixtures) {
  const PhysicalModel rope = test::chain({.points = 4, .origin = {1.25, 0, 0}});
  expect_round_trip(glue(test::block({}), rope, {0.25, 100.0, 1.0}).model);
}

TEST(ModelFile, KeepsABrokenModel) {
  PhysicalModel model = test::block({.cells = {3, 2, 2}});
  const std::vector<EdgeId> edges = {EdgeId(0), EdgeId(17), EdgeId(40)};
  break_edges(model, edges);
  expect_round_trip(model);
}

TEST(ModelFile, KeepsAnyName) {
  PhysicalModel model = test::block({});
  for (const std::string& name :
       {std::string(), std::string("t\xc3\xb6pfer / \xe5\x9c\x9f"), std::string("a\0b\0", 4),
        std::string("\xff\xfe not UTF-8\n"), std::string(100000, 'x')}) {
    model.name = model.geometry.subobjects[0].name = model.parts[0].surface.texture = name;
    expect_round_trip(model);
  }
}

TEST(ModelFile, KeepsExtremeNumbers) {
  PhysicalModel model = test::block({});
  using Limits = std::numeric_limits<double>;
  model.points[PointId(0)].mass = Limits::denorm_min();
  model.points[PointId(1)].mass = Limits::max();
  model.edges[EdgeId(0)].break_threshold = Limits::infinity();
  model.edges[EdgeId(1)].break_threshold = Limits::denorm_min();
  model.points[PointId(2)].velocity = {-0.0, Limits::min(), std::nextafter(1.0, 2.0)};
  expect_round_trip(model);
}

// Attributes at their defaults are left out of the file, -0.0 is none of them.
TEST(ModelFile, KeepsMinusZeroWhereZeroIsLeftOut) {
  PhysicalModel model = test::block({});
  model.points[PointId(0)].velocity = {-0.0, 0.0, 0.0};
  expect_round_trip(model);
}

// More numbers than pass through memory at a time.
TEST(ModelFile, KeepsArraysLongerThanTheBuffer) {
  PhysicalModel model = test::block({.cells = {14, 14, 14}});
  ASSERT_GT(2 * model.edges.size(), 65536u);
  double x = 0.0;
  for (PointAttributes& p : model.points) {
    x += 0.1;
    p.velocity = {x, -x, 1 / x};
  }
  for (EdgeAttributes& e : model.edges) e.stiffness = (x += 0.1);
  expect_round_trip(model);
}

TEST(ModelFile, IsTheSameForTheSameModel) {
  const TemporaryFolder folder;
  write_model(test::rich_model(), folder / "a.limber");
  write_model(test::rich_model(), folder / "b.limber");
  write_model(read_model(folder / "a.limber"), folder / "c.limber");
  write_model(test::rich_model(), folder / "a.limber");
  const std::string once = contents(folder / "b.limber");
  EXPECT_EQ(contents(folder / "a.limber"), once);
  EXPECT_EQ(contents(folder / "c.limber"), once);
}

TEST(ModelFile, DoesNotWriteWhatCouldNotBeRead) {
  const TemporaryFolder folder;
  PhysicalModel model = test::block({});
  model.points[PointId(3)].mass = -1.0;
  EXPECT_THROW(write_model(model, folder / "a.limber"), InputError);
  model = test::rich_model();
  model.skins[0].triangles[1].owner = 7;
  EXPECT_THROW(write_model(model, folder / "a.limber"), InputError);
  EXPECT_EQ(folder.files(), 0u);
}

TEST(ModelFile, LeavesTheOldFileWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  write_model(test::block({}), folder / "a.limber");
  const std::string before = contents(folder / "a.limber");
  for (unsigned long room : {0ul, 600ul, 3000ul, before.size() - 100}) {
    const test::TinyDisk disk(room);
    EXPECT_THROW(write_model(test::block({.cells = {3, 3, 3}}), folder / "a.limber"), InputError);
  }
  EXPECT_EQ(contents(folder / "a.limber"), before);
  EXPECT_EQ(folder.files(), 1u);
  write_model(test::rich_model(), folder / "a.limber");  // and goes on when there is room
  test::expect_same_model(read_model(folder / "a.limber"), test::rich_model());
}

TEST(ModelFile, SaysWhereItCannotWrite) {
  const TemporaryFolder folder;
  const fs::path target = folder / "missing" / "a.limber";
  try {
    write_model(test::block({}), target);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, target.string());
    EXPECT_EQ(error.diagnostic.remedy, "make the folder first or name another one");
  }
  EXPECT_THROW(write_model(test::block({}), "/dev/null"), InputError);
}

TEST(ModelFile, StartsWithWhatItIs) {
  const TemporaryFolder folder;
  write_model(test::block({}), folder / "a.limber");
  EXPECT_THAT(contents(folder / "a.limber"), testing::StartsWith("limber model 1\nxxh3-64 "));
  const Seal seal = model_file_seal(folder / "a.limber");
  EXPECT_EQ(seal.kind, "model");
  EXPECT_EQ(seal.version, kModelFileVersion);
  EXPECT_EQ(seal.file_size, fs::file_size(folder / "a.limber"));
}

}  // namespace
}  // namespace limber
