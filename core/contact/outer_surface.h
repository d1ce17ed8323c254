#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/triangle.h"
#include "core/dynamics/components.h"
#include "core/dynamics/lattice.h"
#include "core/model/index_rows.h"

namespace limber {

// What can be touched: the outer faces of all pieces that are simulated or carried, and the points
// that can come to touch one. Faces and points are numbered as in the lattice.
class OuterSurface {
 public:
  // Costs the number of faces and points.
  void rebuild(const Lattice& lattice, const Components& pieces);

  const std::vector<std::int32_t>& faces() const { return faces_; }    // ascending
  const std::vector<std::int32_t>& points() const { return points_; }  // ascending

  const std::array<std::int32_t, 3>& corners(std::int32_t face) const { return corners_[face]; }
  std::span<const std::int32_t> faces_at(std::int32_t point) const { return faces_at_[point]; }

  // Has it two sides that can be touched, or is there a cell behind it?
  bool is_sheet(std::int32_t face) const { return is_sheet_[face]; }

  // Piece, or carrying body, of each point; of one point, 0 .. groups() - 1.
  const Components& pieces() const { return pieces_; }
  std::int32_t group(std::int32_t point) const { return pieces_.label[point]; }
  std::int32_t group_of_face(std::int32_t face) const { return group(corners_[face][0]); }
  std::int32_t groups() const { return pieces_.count; }

  // m, the mean longest side of a face; 0 without faces.
  double mean_face_size() const { return mean_face_size_; }
  double least_face_size() const { return least_face_size_; }

  Triangle triangle(const Lattice& lattice, std::int32_t face) const;
  Triangle authored_triangle(const Lattice& lattice, std::int32_t face) const;

  // Do two faces share a corner?
  bool adjacent(std::int32_t face, std::int32_t other) const;
  // Does some other face share the side opposite to this corner (0..2) of the face?
  bool continues_beyond(std::int32_t face, int corner) const;
  // Neighbours that run along a common side the same way face opposite ways.
  bool same_orientation(std::int32_t face, std::int32_t other) const;

 private:
  void list_faces(const Lattice& lattice);
  void list_points(const Lattice& lattice);
  void link_points();

  std::vector<std::array<std::int32_t, 3>> corners_;  // shape (F)
  std::vector<std::uint8_t> is_sheet_;                // shape (F)
  std::vector<std::int32_t> faces_, points_;
  IndexRows faces_at_;  // shape (P)
  Components pieces_;   // with carriers
  double mean_face_size_ = 0.0, least_face_size_ = 0.0;
};

}  // namespace limber
