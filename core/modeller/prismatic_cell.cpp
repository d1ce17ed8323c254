#include "core/modeller/prismatic_cell.h"

namespace limber {

CellId add_prism(GeometricModelBuilder& builder, const std::array<PointId, 3>& outer,
                 const std::array<PointId, 3>& inner) {
  std::vector<std::array<PointId, 2>> edges;
  std::vector<std::array<PointId, 3>> faces = {outer, {inner[0], inner[2], inner[1]}};
  for (std::size_t p = 0; p < 3; ++p) {
    const std::size_t q = (p + 1) % 3;
    edges.push_back({outer[p], outer[q]});
    edges.push_back({inner[p], inner[q]});
    edges.push_back({outer[p], inner[p]});
    edges.push_back({outer[p], inner[q]});
    edges.push_back({inner[p], outer[q]});
    for (const auto& side : split_square({outer[p], inner[p], inner[q], outer[q]})) {
      faces.push_back(side);
    }
  }
  return builder.add_cell(edges, faces);
}

}  // namespace limber
