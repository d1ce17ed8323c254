#include <cmath>
#include <numbers>

#include "core/modeller/box_lattice.h"
#include "core/modeller/material_assignment.h"
#include "core/modeller/mesh_lattice.h"
#include "core/modeller/particle_cloud.h"
#include "core/modeller/read_mesh.h"
#include "core/modeller/ring_shell.h"
#include "core/modeller/rope.h"
#include "core/modeller/round_solids.h"
#include "core/modeller/sheet.h"
#include "core/modeller/thin_material.h"
#include "core/storage/model_file.h"
#include "demos/scenes/teapot_model.h"
#include "demos/scripting/api.h"
#include "demos/scripting/lua_function.h"
#include "demos/scripting/script.h"

// Flexible, breakable shapes.

namespace limber::demos {
namespace {

using std::numbers::pi;

// Most cells along one side of anything.
constexpr double kMostCells = 500.0;

Field name_field(const char* usual) {
  return field("name", Kind::kText, "", "in reports").or_else(std::string(usual));
}

Field colour_field() {
  return field("colour", Kind::kColour, "", "linear red, green, blue")
      .or_else(Vec3(0.8, 0.8, 0.8))
      .between(0.0, 1.0);
}

Field cells_field(const char* name, const char* meaning) {
  return field(name, Kind::kWhole, "", meaning).between(1.0, kMostCells);
}

Field length(const char* name, const char* meaning) {
  return number(name, "m", meaning).above(0.0);
}

Field place_field(const char* name, const char* meaning) {
  return field(name, Kind::kVector, "m", meaning)
      .or_else(Vec3(0.0, 0.0, 0.0))
      .between(-kMostMetres, kMostMetres);
}

// What all shapes of a material take beside their own fields.
std::vector<Field> with_common(const char* usual_name, std::vector<Field> own) {
  std::vector<Field> fields = {name_field(usual_name),
                               field("material", Kind::kMaterial, "", "what it is made of")};
  fields.insert(fields.end(), own.begin(), own.end());
  fields.push_back(colour_field());
  return fields;
}

Field corner_field(const char* name, const char* meaning) {
  return field(name, Kind::kVector, "m", meaning).between(-kMostMetres, kMostMetres).optional();
}

// Of what is filled with cells: some of them may be of another material.
std::vector<Field> solid_fields(const char* usual_name, std::vector<Field> own) {
  std::vector<Field> fields = with_common(usual_name, std::move(own));
  fields.push_back(records("regions",
                           {field("material", Kind::kMaterial, "", "of the cells in it"),
                            corner_field("low", "the lowest corner of a box"),
                            corner_field("high", "and its highest"),
                            corner_field("centre", "of a ball, instead"),
                            number("radius", "m", "of it").between(1e-4, kMostMetres).optional()},
                           "where it is made of something else, as modelled; of two that overlap "
                           "the first counts")
                       .optional());
  return fields;
}

// The limit is asked before the shape is made, by what it will have at least.
void expect_points(const Arguments& given, double points) {
  script_of(given.lua()).take_points(points);
}

int give_model(const Arguments& given, PhysicalModel model) {
  for (SubobjectAttributes& part : model.parts) part.surface.colour = given.vector("colour");
  push(given.lua(), std::make_shared<PhysicalModel>(std::move(model)));
  return 1;
}

Region region_of(const Arguments& given) {
  const bool box = given.has("low") && given.has("high");
  const bool ball = given.has("centre") && given.has("radius");
  if (box == ball) {
    throw InputError({given.where(), "a region is neither a box nor a ball, or both",
                      "give it 'low' and 'high', or 'centre' and 'radius'"});
  }
  if (ball) return in_sphere(given.vector("centre"), given.number("radius"));
  return in_box(given.vector("low"), given.vector("high"));
}

// What an object has once is that of its main material.
PhysicalModel of_several(const Arguments& given, GeometricModel geometry) {
  std::vector<Material> materials = {given.material("material")};
  std::vector<std::pair<Region, std::size_t>> regions;
  given.each("regions", [&](const Arguments& region) {
    regions.emplace_back(region_of(region), materials.size());
    materials.push_back(region.material("material"));
  });
  const Material& main = materials.front();
  const WholeObjectValues whole{main.damping_ratio, main.internal_damping, main.friction,
                                main.restitution};
  return with_materials(std::move(geometry), given.text("name"), materials,
                        by_region(std::move(regions), 0), whole);
}

PhysicalModel solid(const Arguments& given, GeometricModel geometry) {
  if (given.has("regions")) return of_several(given, std::move(geometry));
  return with_material(std::move(geometry), given.text("name"), given.material("material"));
}

int make_box(const Arguments& given) {
  const std::array<int, 3> cells = given.wholes("cells");
  expect_points(given, (cells[0] + 1.0) * (cells[1] + 1.0) * (cells[2] + 1.0));
  const Vec3 size = given.vector("size");
  const Vec3 spacing = size.cwiseQuotient(Vec3(cells[0], cells[1], cells[2]));
  const Vec3 corner =
      given.has("corner") ? given.vector("corner") : Vec3(given.vector("centre") - 0.5 * size);
  return give_model(given, solid(given, box_lattice(cells, spacing, corner, given.text("name"))));
}

int make_sphere(const Arguments& given) {
  SolidSphere sphere;
  sphere.centre = given.vector("centre");
  sphere.radius = given.number("radius");
  sphere.cells_across = given.whole("cells_across");
  expect_points(given, std::pow(sphere.cells_across, 3));
  return give_model(given, solid(given, solid_sphere(sphere, given.text("name"))));
}

int make_cylinder(const Arguments& given) {
  SolidCylinder cylinder;
  cylinder.base = given.vector("base");
  cylinder.radius = given.number("radius");
  cylinder.height = given.number("height");
  cylinder.cells_across = given.whole("cells_across");
  const double wide = 2.0 * cylinder.radius / cylinder.cells_across;
  cylinder.cells_along = given.has("cells_along") ? given.whole("cells_along") : 0;
  const double along = cylinder.cells_along > 0 ? cylinder.cells_along : cylinder.height / wide;
  expect_points(given, std::pow(cylinder.cells_across, 2) * along);
  return give_model(given, solid(given, solid_cylinder(cylinder, given.text("name"))));
}

int make_turned(const Arguments& given) {
  const LuaFunction radius(given, "radius");
  SolidOfRevolution turned;
  turned.radius = [&](double y) { return radius.number(y); };
  turned.y_low = given.number("low");
  turned.y_high = given.number("high");
  turned.cells_across = given.whole("cells_across");
  turned.cells_along = given.whole("cells_along");
  expect_points(given, std::pow(turned.cells_across, 2) * turned.cells_along);
  return give_model(given, solid(given, solid_of_revolution(turned, given.text("name"))));
}

// The surface that (radius, height) of a profile sweeps about the y axis.
class Swept {
 public:
  explicit Swept(const LuaFunction& profile) : profile_(profile) {}

  Vec3 position(double u, double v) const {
    const auto [radius, height] = profile_.pair(v);
    return {radius * std::cos(2.0 * pi * u), height, -radius * std::sin(2.0 * pi * u)};
  }

  // Across the profile as it runs next to v, to the right of its way up.
  Vec3 normal(double u, double v) const {
    constexpr double kStep = 1e-5;
    const auto [r0, h0] = profile_.pair(std::max(0.0, v - kStep));
    const auto [r1, h1] = profile_.pair(std::min(1.0, v + kStep));
    const Vec3 outward((h1 - h0) * std::cos(2.0 * pi * u), r0 - r1,
                       -(h1 - h0) * std::sin(2.0 * pi * u));
    return outward.normalized();
  }

 private:
  const LuaFunction& profile_;
};

// Metres along the profile, and around it at its middle radius.
double area_of(const LuaFunction& profile) {
  constexpr int kSteps = 50;
  double area = 0.0;
  auto [last_radius, last_height] = profile.pair(0.0);
  for (int i = 1; i <= kSteps; ++i) {
    const auto [radius, height] = profile.pair(static_cast<double>(i) / kSteps);
    area += std::hypot(radius - last_radius, height - last_height) * pi *
            std::abs(radius + last_radius);
    last_radius = radius;
    last_height = height;
  }
  return area;
}

int make_vessel(const Arguments& given) {
  const LuaFunction profile(given, "profile");
  RingShellOptions options;
  options.spacing = given.number("spacing");
  options.wall_thickness = given.number("wall");
  expect_points(given, 2.0 * area_of(profile) / (options.spacing * options.spacing));
  const Swept swept(profile);
  const RingSurface surface{[&](double u, double v) { return swept.position(u, v); },
                            [&](double u, double v) { return swept.normal(u, v); }};
  GeometricModelBuilder builder;
  builder.begin_subobject(given.text("name"));
  add_ring_shell(builder, surface, options);
  return give_model(given, solid(given, builder.finish()));
}

int make_rope(const Arguments& given) {
  const int segments = given.whole("segments");
  expect_points(given, segments + 1.0);
  const double diameter = given.number("diameter");
  const RopeEnds ends = given.flag("closed") ? RopeEnds::kJoined : RopeEnds::kOpen;
  const auto points = points_along(polyline(given.vectors("points")), segments);
  return give_model(given,
                    with_rope_material(rope(points, given.text("name"), ends), given.text("name"),
                                       given.material("material"), round_section(diameter)));
}

// A flat sheet, its outer side up, where a script gives no surface.
ParametricSurface surface_of(const Arguments& given) {
  if (given.has("surface")) {
    const LuaFunction surface(given, "surface");
    return [surface](double u, double v) { return surface.vector(u, v); };
  }
  const Vec3 centre = given.vector("centre");
  const double width = given.number("width"), depth = given.number("depth");
  return [=](double u, double v) {
    return Vec3(centre + Vec3((u - 0.5) * width, 0.0, (0.5 - v) * depth));
  };
}

SheetGrid grid_of(const Arguments& given) {
  SheetGrid grid;
  grid.cells_u = given.whole("cells_u");
  grid.cells_v = given.whole("cells_v");
  grid.cells = given.text("pattern") == "squares" ? SheetCells::kSquares : SheetCells::kTriangles;
  grid.joined_u = given.flag("closed");
  expect_points(given, (grid.cells_u + 1.0) * (grid.cells_v + 1.0));
  return grid;
}

int make_sheet(const Arguments& given) {
  const SheetGrid grid = grid_of(given);
  SheetProperties properties;
  properties.thickness = given.number("thickness");
  properties.faces.normal_drag = given.number("normal_drag");
  properties.faces.tangential_drag = given.number("tangential_drag");
  GeometricModel geometry = sheet(surface_of(given), grid, given.text("name"));
  return give_model(given, with_sheet_material(std::move(geometry), given.text("name"),
                                               given.material("material"), properties));
}

int make_shell(const Arguments& given) {
  const SheetGrid grid = grid_of(given);
  expect_points(given, (grid.cells_u + 1.0) * (grid.cells_v + 1.0));  // the inner layer
  return give_model(given, solid(given, shell_patch(surface_of(given), grid, given.number("wall"),
                                                    given.text("name"))));
}

int make_grains(const Arguments& given) {
  const double spacing = given.number("spacing");
  const Vec3 half = 0.5 * given.vector("size"), centre = given.vector("centre");
  expect_points(given, 8.0 * half.prod() / std::pow(spacing, 3));
  const auto places = given.has("seed")
                          ? scattered_in_box(centre - half, centre + half, spacing,
                                             static_cast<std::uint64_t>(given.number("seed")))
                          : grid_in_box(centre - half, centre + half, spacing);
  const Particle grain = ball_particle(given.number("density"), 0.5 * spacing);
  return give_model(
      given, with_particles(particle_cloud(places, given.text("name")), given.text("name"), grain));
}

int make_from_mesh(const Arguments& given) {
  Script& script = script_of(given.lua());
  const TriangleMesh mesh = read_mesh(script.file(given.text("file")), given.number("scale"));
  MeshLatticeOptions options;
  options.spacing = given.number("spacing");
  options.name = given.text("name");
  const auto [low, high] = bounding_box(mesh);
  expect_points(given, (high - low).prod() / std::pow(options.spacing, 3));
  MeshLattice lattice = mesh_lattice(mesh, options);
  PhysicalModel model = solid(given, std::move(lattice.geometry));
  model.skins.push_back(std::move(lattice.skin));
  return give_model(given, std::move(model));
}

int read_file(const Arguments& given) {
  PhysicalModel model = read_model(script_of(given.lua()).file(given.text("file")));
  expect_points(given, static_cast<double>(model.points.size()));
  push(given.lua(), std::make_shared<PhysicalModel>(std::move(model)));
  return 1;
}

int make_teapot(const Arguments& given) {
  TeapotOptions options;
  options.spacing = given.number("spacing");
  options.wall_thickness = given.number("wall");
  options.density = given.number("density");
  options.softening = given.number("softening");
  options.seed = static_cast<std::uint64_t>(std::llround(given.number("seed")));
  constexpr double kArea = 0.17;  // m^2, of all its parts, inside and outside
  expect_points(given, kArea / (options.spacing * options.spacing));
  push(given.lua(), std::make_shared<PhysicalModel>(teapot_model(options)));
  return 1;
}

std::vector<Field> box_fields() {
  return solid_fields(
      "box", {field("size", Kind::kVector, "m", "its edges").between(1e-6, kMostMetres),
              field("cells", Kind::kWholes, "", "along each edge").between(1.0, kMostCells),
              place_field("centre", "its middle"),
              place_field("corner", "its lowest corner, instead of the centre").optional()});
}

std::vector<Field> surface_fields() {
  return {
      field("surface", Kind::kFunction, "",
            "function(u, v) that gives a place for u and v from 0 to 1; its outer side is that "
            "of dS/du x dS/dv; a flat one without it")
          .optional(),
      length("width", "along x, of a flat one").or_else(1.0),
      length("depth", "along z, of a flat one").or_else(1.0),
      place_field("centre", "of a flat one"),
      cells_field("cells_u", "along u"),
      cells_field("cells_v", "along v"),
      choice("pattern", {"triangles", "squares"}, "of its cells").or_else(std::string("triangles")),
      field("closed", Kind::kFlag, "", "is u = 1 the same as u = 0").or_else(false)};
}

std::vector<Field> plus(std::vector<Field> fields, const std::vector<Field>& more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

Field cells_across_field() {
  return field("cells_across", Kind::kWhole, "", "along a diameter")
      .or_else(8.0)
      .between(4.0, kMostCells);
}

}  // namespace

std::vector<ApiFunction> shape_functions() {
  const Field seed = number("seed", "", "of the random places").between(0.0, 1e15);
  return {
      {"shape", "box", "A box of cubic cells.", box_fields(), "model",
       R"(local jelly = material{density = 1000, youngs_modulus = 1e5, damping_ratio = 0.1}
spawn{model = shape.box{size = {0.2, 0.1, 0.2}, cells = {4, 2, 4}, centre = {0, 0.5, 0},
                        material = jelly}})",
       make_box},
      {"shape", "sphere", "A ball.",
       solid_fields("sphere", {length("radius", "of it"), place_field("centre", "its middle"),
                               cells_across_field()}),
       "model",
       "spawn{model = shape.sphere{radius = 0.1, centre = {0, 0.2, 0}, material = \"rubber\"}}",
       make_sphere},
      {"shape", "cylinder", "A cylinder that stands along y.",
       solid_fields(
           "cylinder",
           {length("radius", "of it"), length("height", "of it"),
            place_field("base", "the middle of its lower end"), cells_across_field(),
            cells_field("cells_along", "along y; as many as across without it").optional()}),
       "model",
       "spawn{model = shape.cylinder{radius = 0.05, height = 0.1, material = \"spruce\",\n"
       "                             cells_across = 4}}",
       make_cylinder},
      {"shape", "turned", "A solid as a lathe makes it, about the y axis.",
       solid_fields("turned",
                    {field("radius", Kind::kFunction, "", "function(y) that gives the radius, m"),
                     number("low", "m", "y of its lower end").between(-kMostMetres, kMostMetres),
                     number("high", "m", "y of its upper end").between(-kMostMetres, kMostMetres),
                     cells_across_field(), cells_field("cells_along", "along y").or_else(8.0)}),
       "model",
       R"(local pin = shape.turned{
  radius = function(y) return 0.04 + 0.02 * math.sin(20 * y) end,
  low = 0, high = 0.3, cells_across = 4, material = "spruce"})",
       make_turned},
      {"shape", "vessel", "A shell that a profile sweeps about the y axis: a cup, a plate, a vase.",
       solid_fields(
           "vessel",
           {field("profile", Kind::kFunction, "",
                  "function(t) that gives radius and height, m, for t from 0 to 1; its "
                  "outer side is to the right of the way from 0 to 1, the axis to the left"),
            length("spacing", "of neighbouring points"),
            length("wall", "its thickness, laid on the inner side")}),
       "model",
       R"(local cup = shape.vessel{
  profile = function(t) return 0.04, 0.08 * t end,
  spacing = 0.01, wall = 0.004, material = material{like = "stoneware", softening = 1000}})",
       make_vessel},
      {"shape", "rope", "A rope along the way from one point to the next.",
       with_common("rope",
                   {field("points", Kind::kVectors, "m", "that it runs through")
                        .between(-kMostMetres, kMostMetres),
                    field("segments", Kind::kWhole, "", "that it is made of").between(1.0, 10000.0),
                    length("diameter", "of it"),
                    field("closed", Kind::kFlag, "", "is it a ring").or_else(false)}),
       "model",
       R"(local rope = shape.rope{points = {{0, 1, 0}, {1, 1, 0}}, segments = 10,
                        diameter = 0.01, material = "hemp"}
rope:pin{index = 1}
spawn{model = rope})",
       make_rope},
      {"shape", "sheet", "A sheet that resists stretch and shear, but hardly any bending.",
       plus(with_common("sheet", surface_fields()),
            {length("thickness", "of it"),
             number("normal_drag", "", "of its faces across the wind")
                 .or_else(0.0)
                 .between(0.0, 1e3),
             number("tangential_drag", "", "along it").or_else(0.0).between(0.0, 1e3)}),
       "model",
       R"(spawn{model = shape.sheet{width = 0.3, depth = 0.2, centre = {0, 0.3, 0},
                          cells_u = 6, cells_v = 4, thickness = 1e-3, material = "rubber"}})",
       make_sheet},
      {"shape", "shell", "A surface with a wall, of one layer of cells.",
       plus(solid_fields("shell", surface_fields()), {length("wall", "its thickness")}), "model",
       R"(local glass = material{like = "glass", softening = 1000}
spawn{model = shape.shell{width = 0.2, depth = 0.2, cells_u = 8, cells_v = 8, wall = 0.004,
                          centre = {0, 0.3, 0}, material = glass}})",
       make_shell},
      {"shape",
       "grains",
       "Loose grains that fill a box.",
       {name_field("grains"),
        field("size", Kind::kVector, "m", "of the box").between(1e-6, kMostMetres),
        place_field("centre", "of the box"), length("spacing", "of the grains: their diameter"),
        number("density", "kg/m^3", "of a grain").above(0.0), seed.optional(), colour_field()},
       "model",
       "spawn{model = shape.grains{size = {0.1, 0.1, 0.1}, centre = {0, 0.1, 0}, spacing = 0.05,\n"
       "                           density = 2600}}",
       make_grains},
      {"shape", "mesh", "A lattice of cubes in the shape of a closed mesh: OBJ, PLY, STL or glTF.",
       solid_fields("mesh",
                    {field("file", Kind::kText, "", "in the scene's folder"),
                     length("spacing", "side of a cell"),
                     number("scale", "m", "in a unit of the file").or_else(1.0).above(0.0)}),
       "model",
       R"(-- Wants a file beside the script.
local found, why = pcall(shape.mesh, {file = "missing.obj", spacing = 0.01, material = "rubber"})
assert(not found))",
       make_from_mesh},
      {"shape",
       "file",
       "A model file, as `limber model -o` writes it.",
       {field("file", Kind::kText, "", "in the scene's folder")},
       "model",
       R"(-- Wants a file beside the script.
local found, why = pcall(shape.file, {file = "missing.limber"})
assert(not found))",
       read_file},
      {"shape",
       "teapot",
       "The Utah teapot of stoneware, its parts glued, with flaws and seams.",
       {length("spacing", "of neighbouring points").or_else(0.0075).between(0.003, 0.02),
        length("wall", "its thickness").or_else(0.005).between(1e-4, 0.01),
        number("density", "kg/m^3", "of the ceramic").or_else(2400.0).between(1.0, 1e5),
        number("softening", "", "S: modulus / S, strain at break x sqrt S")
            .or_else(2000.0)
            .between(1.0, 1e12),
        number("seed", "", "of the flaws").or_else(1.0).between(0.0, 1e15)},
       "model",
       "spawn{model = shape.teapot{}, position = {0, 0.01, 0}}",
       make_teapot}};
}

}  // namespace limber::demos
