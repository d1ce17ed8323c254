#include "demos/cli/model_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>

#include "core/model/errors.h"
#include "core/modeller/material.h"
#include "core/modeller/material_report.h"
#include "core/modeller/material_table.h"
#include "core/modeller/mesh_lattice.h"
#include "core/modeller/read_mesh.h"
#include "core/modeller/softness.h"
#include "core/storage/atomic_file.h"
#include "core/storage/model_file.h"
#include "demos/cli/model_report.h"
#include "demos/cli/numbers.h"
#include "demos/cli/options.h"
#include "demos/cli/progress_bar.h"
#include "demos/cli/text_table.h"

namespace limber::demos {
namespace {

constexpr double kDefaultCells = 16.0;  // along the mesh's longest side

struct ModelOptions : OutputOptions {
  std::string mesh;
  std::string output;
  std::string material = "porcelain";
  double spacing = 0.0;  // m; 0: the longest side / kDefaultCells
  double scale = 1.0;    // m in a unit of the file
  double softening = 1.0;
  double damping_ratio = -1.0;    // < 0: the material's
  double internal_damping = 0.0;  // 1/s
  bool list_materials = false;
};

void list_materials(Terminal& terminal) {
  TextTable table;
  table.add_row({"material", "density, kg/m^3", "modulus, Pa", "Poisson", "strain at break"});
  for (const NamedMaterial& named : named_materials()) {
    const Material& m = named.material;
    table.add_row({std::string(named.name), significant(m.density), significant(m.youngs_modulus),
                   significant(m.poisson_ratio), significant(m.strain_at_break)});
  }
  terminal.out << table.text() << "\nSources and remarks: docs/materials.md\n";
}

Material material_of(const ModelOptions& options) {
  Material material = material_named(options.material).material;
  material.softening = options.softening;
  if (options.damping_ratio >= 0.0) material.damping_ratio = options.damping_ratio;
  material.internal_damping = options.internal_damping;
  return material;
}

double spacing_of(const ModelOptions& options, const TriangleMesh& mesh) {
  if (options.spacing > 0.0) return options.spacing;
  const auto [low, high] = bounding_box(mesh);
  const double longest = (high - low).maxCoeff();
  if (longest > 0.0 && std::isfinite(longest)) return longest / kDefaultCells;
  throw InputError({options.mesh, fmt::format("is {} m long", longest),
                    "mend its positions: they have to be finite and not all in one place"});
}

Vec3 size_of(const TriangleMesh& mesh) {
  const auto [low, high] = bounding_box(mesh);
  return high - low;
}

// Names the user's file, not the object that was made of it.
std::vector<Diagnostic> from_file(std::vector<Diagnostic> notes, const std::string& name,
                                  const std::string& file) {
  for (Diagnostic& note : notes)
    if (note.where.starts_with(name)) note.where = file + note.where.substr(name.size());
  return notes;
}

void append(std::vector<Diagnostic>& all, const std::vector<Diagnostic>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// Of a fall of a metre, as `limber run FILE` has it.
void note_landing(const PhysicalModel& model, MadeModel& made) {
  constexpr double kGravity = 9.81, kHeight = 1.0;  // m/s^2, m
  const auto note = softness_note(made.mesh, model, std::sqrt(2.0 * kGravity * kHeight), kGravity);
  if (note) made.notes.push_back(*note);
}

// Writes the model where that was asked for.
MadeModel make(const ModelOptions& options, TriangleMesh mesh, const Material& material,
               ProgressBar& bar) {
  const std::string name = mesh.name;
  mesh.name = options.mesh;  // the messages are about the file
  MadeModel made;
  made.mesh = options.mesh;
  made.material = options.material;
  made.output = options.output;
  made.size = size_of(mesh);
  made.spacing = spacing_of(options, mesh);
  bar.show("cells", 0.1);
  MeshLattice lattice = mesh_lattice(mesh, {.spacing = made.spacing, .name = name, .edges = {}});
  bar.show("springs", 0.5);
  PhysicalModel model = with_material(std::move(lattice.geometry), name, material);
  model.skins.push_back(std::move(lattice.skin));
  made.fit = lattice.report;
  made.count = {model.points.size(), model.edges.size(), model.faces.size(), model.cells.size()};
  made.mass_kg = total_mass(model);
  bar.show("judging", 0.7);
  made.cost = material_report(model);
  append(made.notes, lattice.notes);
  append(made.notes,
         from_file(modelling_notes(model, made.cost, {&material, 1}), name, options.mesh));
  note_landing(model, made);
  bar.show("writing", 0.9);
  if (!options.output.empty()) write_model(model, options.output);
  return made;
}

void require_targets(const ModelOptions& options) {
  if (!options.output.empty()) {
    require_other_file(options.mesh, options.output);
    require_writable(options.output);
  }
  require_other_file(options.mesh, options.json);
  require_json_target(options);
  if (options.json.empty() || options.json != options.output) return;
  throw InputError({options.json, "is to hold both the model and the JSON", "name two files"});
}

void make_model(const ModelOptions& options, Terminal& terminal) {
  const Material material = material_of(options);
  require_targets(options);
  TriangleMesh mesh = read_mesh(options.mesh, options.scale);
  const double volume = std::abs(solid_moments(mesh).volume);
  std::vector<Diagnostic> early = size_notes(options.mesh, size_of(mesh));
  append(early, count_notes(options.mesh, volume, spacing_of(options, mesh)));
  say_notes(early, terminal);
  MadeModel made;
  {
    ProgressBar bar(terminal.err);
    made = make(options, std::move(mesh), material, bar);
  }
  made.early = std::move(early);
  write_json(options, model_json(made), terminal);
  if (tables_wanted(options)) terminal.out << model_report(made);
}

struct Span {
  double least, most;
  std::string unit;
};

void add_number(CLI::App& command, const std::string& name, double& value, Span range,
                const std::string& unit, const std::string& help) {
  command
      .add_option_function<std::string>(
          name,
          [=, &value](const std::string& text) {
            value = parse_number(text, name);
            if (value >= range.least && value <= range.most) return;
            throw InputError({name, fmt::format("{} is out of range", text),
                              fmt::format("give {} to {}{}", range.least, range.most, range.unit)});
          },
          help)
      ->type_name(unit);
}

void add_options(CLI::App& command, ModelOptions& options) {
  command.add_option("MESH", options.mesh, "an OBJ, PLY, STL or glTF file")->type_name("");
  command.add_option("-o,--output", options.output, "the model file to write")->type_name("FILE");
  command.add_option("--material", options.material, "one of the list below --materials")
      ->type_name("NAME")
      ->capture_default_str();
  command.add_flag("--materials", options.list_materials, "list the materials and do nothing else");
  add_number(command, "--spacing", options.spacing, {1e-6, 1e3, " m"}, "M",
             "side of a cell, m; a 16th of the mesh's longest side without it");
  add_number(command, "--scale", options.scale, {1e-9, 1e6, " m"}, "M",
             "m in a unit of the file, 0.001 for millimetres; 1 without it");
  add_number(command, "--softening", options.softening, {1.0, 1e8, ""}, "S",
             "modulus / S, strain at break x sqrt S; 1, the real material, without it");
  add_number(command, "--damping-ratio", options.damping_ratio, {0.0, 10.0, ""}, "Z",
             "at the highest frequency; the material's without it");
  add_number(command, "--internal-damping", options.internal_damping, {0.0, 1e6, " 1/s"}, "1/S",
             "draws pieces to their rigid motion, 1/s; 0 without it");
  add_json(command, options);
}

}  // namespace

void add_model_command(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<ModelOptions>();
  CLI::App* command = app.add_subcommand(
      "model", "Make a lattice of a material from a triangle mesh and report how well it fits");
  add_options(*command, *options);
  command->callback([options, &chosen] {
    if (options->list_materials) {
      chosen = list_materials;
      return;
    }
    if (options->mesh.empty()) {
      throw InputError({"command line", "MESH is missing", "name an OBJ, PLY, STL or glTF file"});
    }
    chosen = [options](Terminal& terminal) { make_model(*options, terminal); };
  });
}

}  // namespace limber::demos
