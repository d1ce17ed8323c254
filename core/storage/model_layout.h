#pragma once

#include <string>
#include <vector>

#include "core/model/physical_model.h"
#include "core/storage/array_values.h"

namespace limber {

// What a model file holds, told once: the writer and the reader both walk through it, so that they
// cannot differ. `File` is an ArrayFileWriter with a const model or an ArrayFileReader with one
// that is empty. docs/model_file.md is this for people.
//
// Arrays with a default (`absent`) may be left out; the default is that of the structs.

// std::map has no elements that could be filled one after the other.
struct NamedValue {
  std::string name;
  double number = 0.0;
};
using ValuesOfParts = std::vector<std::vector<NamedValue>>;

template <class File, class Model>
void lay_out_object(File& file, Model& model) {
  file.count("name", model.name);
  file.template table<std::uint8_t>({"name", "UTF-8"}, [&](auto each) {
    for (auto& c : model.name) each(c);
  });
  const auto one = [&](const char* path, const char* unit, auto& value) {
    file.template table<double>({path, unit, 0}, [&](auto each) { each(value); });
  };
  auto& o = model.object;
  one("object/friction", "1", o.friction);
  one("object/restitution", "1", o.restitution);
  one("object/internal_damping", "1/s", o.internal_damping);
  one("object/softening", "1", o.softening);
  one("object/contact_share", "1", o.contact_share);
  one("object/particle_radius", "m", o.particle_radius);
}

template <class File, class Model>
void lay_out_points(File& file, Model& model) {
  auto& places = model.geometry.points;
  file.count("points/position", places, model.points);
  file.template table<double>({"points/position", "m", 3}, [&](auto each) {
    for (auto& x : places)
      for (int k = 0; k < 3; ++k) each(x[k]);
  });
  file.template table<double>({"points/mass", "kg"}, [&](auto each) {
    for (auto& p : model.points) each(p.mass);
  });
  file.template table<double>({"points/velocity", "m/s", 3, 0.0}, [&](auto each) {
    for (auto& p : model.points)
      for (int k = 0; k < 3; ++k) each(p.velocity[k]);
  });
  file.template table<std::uint8_t>({"points/pinned", "0 or 1", 1, 0}, [&](auto each) {
    for (auto& p : model.points) each(p.pinned);
  });
}

template <class File, class Model>
void lay_out_edges(File& file, Model& model) {
  auto& edges = model.geometry.edges;
  file.count("edges/ends", edges, model.edges);
  file.template table<std::int32_t>({"edges/ends", "point", 2}, [&](auto each) {
    for (auto& e : edges) each(e.a), each(e.b);
  });
  const auto numbers = [&](const char* path, const char* unit, auto member,
                           std::optional<double> absent = {}) {
    file.template table<double>({path, unit, 1, absent}, [&](auto each) {
      for (auto& e : model.edges) each(e.*member);
    });
  };
  numbers("edges/stiffness", "N/m", &EdgeAttributes::stiffness);
  numbers("edges/damping", "N s/m", &EdgeAttributes::damping);
  numbers("edges/rest_length", "m", &EdgeAttributes::rest_length);
  numbers("edges/break_threshold", "m", &EdgeAttributes::break_threshold, kUnbreakable);
  numbers("edges/crush_threshold", "m", &EdgeAttributes::crush_threshold, kUnbreakable);
  file.template table<std::uint8_t>({"edges/broken", "0 or 1", 1, 0}, [&](auto each) {
    for (auto& e : model.edges) each(e.broken);
  });
}

template <class File, class Model>
void lay_out_faces(File& file, Model& model) {
  auto& faces = model.geometry.faces;
  file.count("faces/corners", faces, model.faces);
  file.template table<std::int32_t>({"faces/corners", "point", 3}, [&](auto each) {
    for (auto& f : faces)
      for (auto& corner : f.corners) each(corner);
  });
  file.template table<std::int32_t>({"faces/cell", "cell, -1 for none", 1, -1}, [&](auto each) {
    for (auto& f : faces) each(f.cell);
  });
  const char* laws = "0 quadratic, 1 linear, 2 pressure";
  file.template table<std::uint8_t>({"faces/drag_law", laws, 1, 0}, [&](auto each) {
    for (auto& f : model.faces) each(f.drag_law);
  });
  const char* unit = "1; kg/(m^2 s) where the law is linear";
  file.template table<double>({"faces/normal_drag", unit, 1, 0.0}, [&](auto each) {
    for (auto& f : model.faces) each(f.normal_drag);
  });
  file.template table<double>({"faces/tangential_drag", unit, 1, 0.0}, [&](auto each) {
    for (auto& f : model.faces) each(f.tangential_drag);
  });
}

template <class File, class Model>
void lay_out_cells(File& file, Model& model) {
  auto& cells = model.geometry.cells;
  file.count_lists("cells/edge_start", cells, model.cells);
  file.lists("cells/edge_start", "cells/edges", [&](auto each) {
    for (auto& c : cells) each(c.edges);
  });
  file.template table<std::int32_t>({"cells/edges", "edge"}, [&](auto each) {
    for (auto& c : cells)
      for (auto& e : c.edges) each(e);
  });
  file.lists("cells/face_start", "cells/faces", [&](auto each) {
    for (auto& c : cells) each(c.faces);
  });
  file.template table<std::int32_t>({"cells/faces", "face"}, [&](auto each) {
    for (auto& c : cells)
      for (auto& f : c.faces) each(f);
  });
  file.template table<std::uint8_t>({"cells/valid", "0 or 1", 1, 1}, [&](auto each) {
    for (auto& c : model.cells) each(c.valid);
  });
}

// Texts one behind the other; visit(each) calls each(text) for all of them.
template <class File, class Visit>
void lay_out_texts(File& file, const char* start_path, const char* path, Visit visit) {
  file.lists(start_path, path, visit);
  file.template table<std::uint8_t>({path, "UTF-8"}, [&](auto each) {
    visit([&](auto& text) {
      for (auto& c : text) each(c);
    });
  });
}

template <class File, class Model>
void lay_out_subobjects(File& file, Model& model) {
  auto& subobjects = model.geometry.subobjects;
  file.count_lists("subobjects/name_start", subobjects, model.parts);
  lay_out_texts(file, "subobjects/name_start", "subobjects/name", [&](auto each) {
    for (auto& s : subobjects) each(s.name);
  });
  const auto ranges = [&](const char* path, const char* unit, auto member) {
    file.template table<std::int32_t>({path, unit, 2}, [&](auto each) {
      for (auto& s : subobjects) each((s.*member).begin), each((s.*member).end);
    });
  };
  ranges("subobjects/point_range", "point", &Subobject::points);
  ranges("subobjects/edge_range", "edge", &Subobject::edges);
  ranges("subobjects/face_range", "face", &Subobject::faces);
  ranges("subobjects/cell_range", "cell", &Subobject::cells);
}

template <class Parts>
bool any_texture(const Parts& parts) {
  for (const auto& part : parts)
    if (!part.surface.texture.empty()) return true;
  return false;
}

template <class File, class Model>
void lay_out_surfaces(File& file, Model& model) {
  const SurfaceProperties usual;
  file.template table<double>({"subobjects/colour", "linear RGB", 3, usual.colour[0]},
                              [&](auto each) {
                                for (auto& part : model.parts)
                                  for (int k = 0; k < 3; ++k) each(part.surface.colour[k]);
                              });
  const auto numbers = [&](const char* path, auto member) {
    file.template table<double>({path, "1", 1, usual.*member}, [&](auto each) {
      for (auto& part : model.parts) each(part.surface.*member);
    });
  };
  numbers("subobjects/specularity", &SurfaceProperties::specularity);
  numbers("subobjects/transparency", &SurfaceProperties::transparency);
  numbers("subobjects/index_of_refraction", &SurfaceProperties::index_of_refraction);
  numbers("subobjects/strand_radius", &SurfaceProperties::strand_radius);
  if (!file.has("subobjects/texture_start", any_texture(model.parts))) return;
  lay_out_texts(file, "subobjects/texture_start", "subobjects/texture", [&](auto each) {
    for (auto& part : model.parts) each(part.surface.texture);
  });
}

template <class Values>
bool any_value(const Values& values) {
  for (const auto& list : values)
    if (!list.empty()) return true;
  return false;
}

template <class File, class Values>
void lay_out_values(File& file, Values& values) {
  if (!file.has("values/start", any_value(values))) return;
  const auto all = [&](auto each) {
    for (auto& list : values)
      for (auto& value : list) each(value);
  };
  file.lists("values/start", "values/number", [&](auto each) {
    for (auto& list : values) each(list);
  });
  file.template table<double>({"values/number", "SI"},
                              [&](auto each) { all([&](auto& value) { each(value.number); }); });
  lay_out_texts(file, "values/name_start", "values/name",
                [&](auto each) { all([&](auto& value) { each(value.name); }); });
}

template <class File, class Skins>
void lay_out_skin_cells(File& file, Skins& skins) {
  const auto all = [&](auto each) {
    for (auto& skin : skins)
      for (auto& cell : skin.cells) each(cell);
  };
  file.lists("skins/cell_start", "skins/cell", [&](auto each) {
    for (auto& skin : skins) each(skin.cells);
  });
  file.template table<std::int32_t>({"skins/cell", "cell"},
                                    [&](auto each) { all([&](auto& cell) { each(cell.cell); }); });
  file.template table<std::int32_t>({"skins/cell_corners", "point", 8}, [&](auto each) {
    all([&](auto& cell) {
      for (auto& corner : cell.corners) each(corner);
    });
  });
  file.template table<std::int32_t>({"skins/cell_grid", "1", 3}, [&](auto each) {
    all([&](auto& cell) {
      for (auto& k : cell.grid) each(k);
    });
  });
}

template <class File, class Skins>
void lay_out_skin_vertices(File& file, Skins& skins) {
  const auto all = [&](auto each) {
    for (auto& skin : skins)
      for (auto& vertex : skin.vertices) each(vertex);
  };
  file.lists("skins/vertex_start", "skins/vertex_host", [&](auto each) {
    for (auto& skin : skins) each(skin.vertices);
  });
  file.template table<std::int32_t>({"skins/vertex_host", "cell of the skin"}, [&](auto each) {
    all([&](auto& vertex) { each(vertex.host); });
  });
  file.template table<double>({"skins/vertex_place", "1", 3}, [&](auto each) {
    all([&](auto& vertex) {
      for (int k = 0; k < 3; ++k) each(vertex.place[k]);
    });
  });
}

template <class File, class Skins>
void lay_out_skin_triangles(File& file, Skins& skins) {
  const auto all = [&](auto each) {
    for (auto& skin : skins)
      for (auto& triangle : skin.triangles) each(triangle);
  };
  file.lists("skins/triangle_start", "skins/triangle_owner", [&](auto each) {
    for (auto& skin : skins) each(skin.triangles);
  });
  file.template table<std::int32_t>({"skins/triangle_owner", "cell of the skin"}, [&](auto each) {
    all([&](auto& triangle) { each(triangle.owner); });
  });
  const char* unit = "vertex of the skin";
  file.template table<std::int32_t>({"skins/triangle_corners", unit, 3}, [&](auto each) {
    all([&](auto& triangle) {
      for (auto& corner : triangle.corners) each(corner);
    });
  });
}

template <class File, class Model>
void lay_out_skins(File& file, Model& model) {
  if (!file.has("skins/cell_start", !model.skins.empty())) return;
  file.count_lists("skins/cell_start", model.skins);
  lay_out_skin_cells(file, model.skins);
  lay_out_skin_vertices(file, model.skins);
  lay_out_skin_triangles(file, model.skins);
}

// `values` are the model's parts' own, in the order of the parts.
template <class File, class Model, class Values>
void lay_out(File& file, Model& model, Values& values) {
  lay_out_object(file, model);
  lay_out_points(file, model);
  lay_out_edges(file, model);
  lay_out_faces(file, model);
  lay_out_cells(file, model);
  lay_out_subobjects(file, model);
  lay_out_surfaces(file, model);
  file.count_lists("subobjects/name_start", values);
  lay_out_values(file, values);
  lay_out_skins(file, model);
}

}  // namespace limber
