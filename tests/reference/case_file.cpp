#include "tests/reference/case_file.h"

#include <fmt/format.h>

#include <fstream>
#include <set>

#include "core/model/errors.h"

namespace limber::reference {
namespace {

constexpr const char* kSchema =
    "give a file with {\"cases\": [{\"id\": \"GROUP.KIND.NUMBER\", \"params\": {...}, "
    "\"expected\": {NAME: {\"value\": ..., \"how\": ..., \"tol\": {...}}}}]}";

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw InputError({where, what, kSchema});
}

Json parse(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file)) {
    throw InputError({file.string(), "cannot be read", "name a file of cases that exists"});
  }
  try {
    return Json::parse(in);
  } catch (const Json::parse_error& error) {
    throw InputError({fmt::format("{}: byte {}", file.string(), error.byte), "is not JSON",
                      "check that the file is complete"});
  }
}

void require_object(const Json& parent, const char* key, const std::string& where) {
  if (!parent.contains(key)) refuse(where, fmt::format("has no \"{}\"", key));
  if (!parent[key].is_object()) refuse(where, fmt::format("its \"{}\" is no object", key));
}

std::string id_of(const Json& item, const std::string& where) {
  if (!item.is_object()) refuse(where, "is no object");
  if (!item.contains("id") || !item["id"].is_string()) refuse(where, "has no \"id\"");
  if (kind_of(item["id"]).empty())
    refuse(where, fmt::format("id {} names no kind", item["id"].dump()));
  return item["id"];
}

// A table asks by its columns nx, ny, nz and expects the others.
Json sizes_asked_for(const Json& expected) {
  Json sizes = Json::array();
  const Json& columns = expected.at("columns").at("value");
  if (columns.size() < 3 || columns[0] != "nx" || columns[1] != "ny" || columns[2] != "nz") {
    return sizes;
  }
  for (const Json& row : expected.at("rows").at("value")) {
    sizes.push_back({row.at(0), row.at(1), row.at(2)});
  }
  return sizes;
}

Json inputs_of(const Json& expected) {
  Json inputs = Json::object();
  for (const auto& [name, quantity] : expected.items()) {
    if (is_input(quantity)) inputs[name] = quantity.at("value");
  }
  if (expected.contains("columns") && expected.contains("rows")) {
    inputs["rows"] = sizes_asked_for(expected);
  }
  return inputs;
}

CaseRecord record_of(const Json& item, const std::string& where) {
  const std::string id = id_of(item, where);
  require_object(item, "params", where + " " + id);
  require_object(item, "expected", where + " " + id);
  for (const auto& [name, quantity] : item["expected"].items()) {
    require_object(item["expected"], name.c_str(), where + " " + id);
    if (!quantity.contains("value")) refuse(where + " " + id + ": " + name, "has no \"value\"");
  }
  try {
    return {id, {item["params"], inputs_of(item["expected"])}, item["expected"]};
  } catch (const Json::exception&) {
    refuse(where + " " + id, "its table cannot be read");
  }
}

}  // namespace

std::string kind_of(const std::string& case_id) {
  const std::size_t first = case_id.find('.');
  if (first == std::string::npos) return {};
  const std::size_t second = case_id.find('.', first + 1);
  return case_id.substr(first + 1, second == std::string::npos ? second : second - first - 1);
}

bool is_input(const Json& quantity) { return quantity.value("how", "") == "input"; }

std::vector<CaseRecord> read_cases(const std::filesystem::path& file) {
  const Json document = parse(file);
  if (!document.is_object() || !document.contains("cases") || !document["cases"].is_array()) {
    refuse(file.string(), "has no list \"cases\"");
  }
  std::vector<CaseRecord> cases;
  std::set<std::string> ids;
  for (const Json& item : document["cases"]) {
    const std::string where = fmt::format("{}: case {}", file.string(), cases.size());
    cases.push_back(record_of(item, where));
    if (!ids.insert(cases.back().id).second) refuse(where, "its id was there before");
  }
  return cases;
}

}  // namespace limber::reference
