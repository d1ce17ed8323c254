#pragma once

#include <span>
#include <string_view>

#include "core/modeller/material.h"

namespace limber {

// How far a value of the table can be trusted.
enum class Basis {
  kStated,    // the source gives this value
  kMidRange,  // the source gives a range, this is about its middle; specimens differ as much
  kEstimate,  // of the right order; the source is about something like it
};
std::string_view word_for(Basis basis);

// A material as handbooks have it: not softened, without internal damping (a setting of the
// simulation and no property). docs/materials.md explains the columns.
//
// Strain at break is the elongation at break where the source has it, else tensile (or flexural)
// strength over Young's modulus. Damping ratio is half the loss factor. Contacts multiply the
// values of both partners, so friction and restitution are the roots of those of the material on
// itself; both, and the damping ratio, depend on surface, speed and frequency so much that all are
// estimates (order of magnitude: Kaye and Laby; Ashby).
struct NamedMaterial {
  std::string_view name;
  Material material;
  Basis basis = Basis::kEstimate;  // of density, modulus, Poisson ratio and strain at break
  std::string_view source;
  std::string_view remark;  // what the numbers leave out; may be empty
  // Which of them were compared with what; empty: none, they are typical values from memory of the
  // source.
  std::string_view checked = {};
};

// By name, ascending.
std::span<const NamedMaterial> named_materials();

// Throws InputError with the nearest name where there is none of this name.
const NamedMaterial& material_named(std::string_view name);

}  // namespace limber
