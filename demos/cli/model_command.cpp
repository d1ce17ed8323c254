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
#include "core/storage/atomic_file.h"
#include "core/storage/model_file.h"
#include "demos/cli/numbers.h"
#include "demos/cli/options.h"
#include "demos/cli/text_table.h"

namespace limber::demos {
namespace {

constexpr double kDefaultCells = 16.0;  // along the mesh's longest side

struct ModelOptions {
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

std::string size_line(const TriangleMesh& mesh, double spacing) {
  const auto [low, high] = bounding_box(mesh);
  const Vec3 size = high - low;
  return fmt::format("{} x {} x {} m, cells of {} m\n", significant(size.x()), significant(size.y()),
                     significant(size.z()), significant(spacing));
}

// 0 for what rounds to it: no "-0.00 %".
std::string percent(double share) {
  const double hundredths = std::round(1e4 * share);
  return fmt::format("{:.2f} %", hundredths == 0.0 ? 0.0 : 0.01 * hundredths);
}

std::string mesh_table(const MeshLatticeReport& report) {
  TextTable table;
  table.add_row({"", "mesh", "lattice", "error"});
  table.add_row({"volume, m^3", significant(report.mesh.volume), significant(report.cells.volume),
                 percent(report.volume_error)});
  table.add_row({"centre", "", "", fmt::format("{} cells", significant(report.centre_error))});
  table.add_row({"inertia", "", "", percent(report.inertia_error)});
  return table.text();
}

// Counts have no exponent.
std::string whole(double number) { return fmt::format("{:.0f}", std::ceil(number)); }

std::string counts(const PhysicalModel& model, const MaterialReport& report) {
  return fmt::format(
      "{} points, {} edges, {} cells, {} kg\n"
      "{} substeps in a tick of 1/60 s with softening S {}, {} with S 1\n",
      grouped(model.points.size()), grouped(model.edges.size()), grouped(model.cells.size()),
      significant(total_mass(model)), whole(report.substeps_per_tick),
      significant(report.softening), whole(report.substeps_per_tick_unsoftened));
}

void say_notes(const std::vector<Diagnostic>& notes, Terminal& terminal) {
  for (const Diagnostic& note : notes) terminal.out << "note: " << note.text() << '\n';
}

void make_model(const ModelOptions& options, Terminal& terminal) {
  const Material material = material_of(options);
  if (!options.output.empty()) {
    require_other_file(options.mesh, options.output);
    require_writable(options.output);
  }
  const TriangleMesh mesh = read_mesh(options.mesh, options.scale);
  const double spacing = spacing_of(options, mesh);
  terminal.out << size_line(mesh, spacing);
  MeshLattice made = mesh_lattice(mesh, {.spacing = spacing, .name = mesh.name, .edges = {}});
  PhysicalModel model = with_material(std::move(made.geometry), mesh.name, material);
  model.skins.push_back(std::move(made.skin));
  const MaterialReport report = material_report(model);

  terminal.out << mesh_table(made.report) << counts(model, report);
  say_notes(made.notes, terminal);
  say_notes(modelling_notes(model, report, {&material, 1}), terminal);
  if (options.output.empty()) return;
  write_model(model, options.output);
  terminal.out << fmt::format("{}: written; `limber run {}` drops it\n", options.output,
                              options.output);
}

void add_number(CLI::App& command, const std::string& name, double& value, double least,
                const std::string& unit, const std::string& help) {
  command
      .add_option_function<std::string>(
          name,
          [name, least, &value](const std::string& text) {
            value = parse_number(text, name);
            if (value >= least) return;
            throw InputError({name, fmt::format("{} is out of range", text),
                              fmt::format("give {} or more", least)});
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
  add_number(command, "--spacing", options.spacing, 1e-6, "M",
             "side of a cell, m; a 16th of the mesh's longest side without it");
  add_number(command, "--scale", options.scale, 1e-9, "M",
             "m in a unit of the file, 0.001 for millimetres; 1 without it");
  add_number(command, "--softening", options.softening, 1.0, "S",
             "modulus / S, strain at break x sqrt S; 1, the real material, without it");
  add_number(command, "--damping-ratio", options.damping_ratio, 0.0, "Z",
             "at the highest frequency; the material's without it");
  add_number(command, "--internal-damping", options.internal_damping, 0.0, "1/S",
             "draws pieces to their rigid motion, 1/s; 0 without it");
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
      throw InputError(
          {"command line", "MESH is missing", "name an OBJ, PLY, STL or glTF file"});
    }
    chosen = [options](Terminal& terminal) { make_model(*options, terminal); };
  });
}

}  // namespace limber::demos
