#include <gtest/gtest.h>

#include "core/modeller/box_lattice.h"
#include "core/modeller/material_assignment.h"
#include "core/modeller/material_table.h"

// The C++ of docs/materials.md.

namespace limber {
namespace {

// Ten cells of 2 cm side by side: two parts, "body" and "handle".
GeometricModel body_and_handle() {
  GeometricModel geometry =
      box_lattice({10, 1, 1}, Vec3::Constant(0.02), {-0.1, 0.06, 0.0}, "body");
  const auto whole = geometry.subobjects[0];
  geometry.subobjects[0].cells.end = 5;
  Subobject handle = whole;
  handle.name = "handle";
  handle.points.begin = handle.points.end;
  handle.edges.begin = handle.edges.end;
  handle.faces.begin = geometry.subobjects[0].faces.end = whole.faces.end / 2;
  handle.cells.begin = 5;
  geometry.subobjects.push_back(handle);
  return geometry;
}

TEST(DocumentedMaterials, CompileAndRun) {
  GeometricModel geometry = body_and_handle();
  const Vec3 rim(0.1, 0.07, 0.01);

  Material clay = material_named("terracotta").material;
  clay.softening = 1000;  // S: nothing softens unless you say so, and every report names it
  PhysicalModel pot = with_material(geometry, "pot", clay);
  EXPECT_NEAR(total_mass(pot), clay.density * 10 * 8e-6, 1e-12);

  Material oak = material_named("oak").material;
  oak.softening = clay.softening;
  const Material materials[] = {clay, oak};
  const WholeObjectValues whole{
      .damping_ratio = 0.1, .internal_damping = 0.0, .friction = 0.5, .restitution = 0.1};
  with_materials(geometry, "pot", materials, by_subobject({{"body", 0}, {"handle", 1}}), whole);
  with_materials(geometry, "pot", materials, by_region({{in_sphere(rim, 0.02), 1}}, 0), whole);
  pot = with_materials(
      geometry, "pot", materials,
      [](const CellPlace& place) -> std::size_t { return place.centre.x() > 0.0; }, whole);
  EXPECT_NEAR(total_mass(pot), (clay.density + oak.density) * 5 * 8e-6, 1e-12);
}

}  // namespace
}  // namespace limber
