#include "core/dynamics/memory_use.h"

#include <type_traits>

namespace limber {
namespace {

std::size_t bytes(const auto&... arrays) {
  return (std::size_t{0} + ... +
          (arrays.size() * sizeof(typename std::remove_cvref_t<decltype(arrays)>::value_type)));
}

std::size_t bytes(const IndexRows& rows) { return bytes(rows.start, rows.items); }

template <class IdType, class T>
std::size_t bytes_of_entries(const IdVector<IdType, T>& array) {
  return array.size() * sizeof(T);
}

std::size_t bytes(const GeometricModel& geometry) {
  std::size_t sum = bytes_of_entries(geometry.points) + bytes_of_entries(geometry.edges) +
                    bytes_of_entries(geometry.faces) + bytes_of_entries(geometry.cells);
  for (const Cell& cell : geometry.cells) sum += bytes(cell.edges, cell.faces);
  return sum;
}

std::size_t bytes(const PhysicalModel& model) {
  return bytes(model.geometry) + bytes_of_entries(model.points) + bytes_of_entries(model.edges) +
         bytes_of_entries(model.faces) + bytes_of_entries(model.cells);
}

}  // namespace

MemoryUse memory_use(const Lattice& lattice) {
  MemoryUse use;
  use.points = bytes(lattice.motion, lattice.force, lattice.mass, lattice.inverse_mass,
                     lattice.role, lattice.authored_position, lattice.contact_radius,
                     lattice.point_object, lattice.touched, lattice.peak_load,
                     lattice.dynamic_points, lattice.carried_points, lattice.carrier);
  use.springs = bytes(lattice.springs, lattice.active, lattice.active_edge, lattice.active_of_edge,
                      lattice.point_neighbours) +
                bytes(lattice.point_edges);
  const BreakingTopology& topology = lattice.topology;
  use.breaking = bytes(topology.cell_edges) + bytes(topology.edge_cells) +
                 bytes(topology.cell_faces) + bytes(topology.edge_sheet_faces) +
                 bytes(topology.face_cell, topology.face_twin) +
                 bytes(lattice.breaking.edge_broken, lattice.breaking.valid_cells,
                       lattice.breaking.cell_valid, lattice.breaking.face_external);
  for (const LatticeObject& object : lattice.objects) use.authored += bytes(object.authored);
  return use;
}

}  // namespace limber
