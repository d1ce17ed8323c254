#include "tests/reference/flow.h"

#include <map>
#include <stdexcept>

namespace limber::reference {
namespace {

FlowKind kind_of_flow(const std::string& type) {
  static const std::map<std::string, FlowKind> kinds = {
      {"uniform", FlowKind::kUniform},          {"line_source", FlowKind::kLineSource},
      {"point_source", FlowKind::kPointSource}, {"line_vortex", FlowKind::kLineVortex},
      {"line_doublet", FlowKind::kLineDoublet}, {"point_doublet", FlowKind::kPointDoublet},
  };
  const auto found = kinds.find(type);
  if (found == kinds.end()) throw std::runtime_error("no flow primitive \"" + type + "\"");
  return found->second;
}

FlowPrimitive primitive_of(const Json& params) {
  const FlowKind kind = kind_of_flow(params.at("type"));
  if (kind == FlowKind::kUniform) return uniform_flow(vec3(params.at("velocity")));
  FlowPrimitive primitive;
  primitive.kind = kind;
  primitive.position = vec3(params.at("position"));
  primitive.strength = params.at("strength").get<double>();
  primitive.core_radius = 1e-6;
  if (params.contains("axis")) primitive.axis = vec3(params["axis"]);
  if (params.contains("moment_dir")) primitive.direction = vec3(params["moment_dir"]);
  return primitive;
}

}  // namespace

FlowField flow_of(const Json& primitives) {
  FlowField field;
  for (const Json& params : primitives) field.primitives.push_back(primitive_of(params));
  return field;
}

}  // namespace limber::reference
