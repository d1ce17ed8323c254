#include "core/storage/model_file.h"

#include <new>
#include <utility>

#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/storage/array_file_reader.h"
#include "core/storage/array_file_writer.h"
#include "core/storage/atomic_file.h"
#include "core/storage/model_layout.h"

namespace limber {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKind = "model";
constexpr const char* kFormat = "limber model";

ValuesOfParts values_of(const PhysicalModel& model) {
  ValuesOfParts values;
  for (const SubobjectAttributes& part : model.parts) {
    values.emplace_back();
    for (const auto& [name, number] : part.values) values.back().push_back({name, number});
  }
  return values;
}

void give_values(PhysicalModel& model, const ValuesOfParts& values, const ArrayFileReader& file) {
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const NamedValue& value : values[i])
      if (!model.parts[i].values.emplace(value.name, value.number).second)
        file.refuse("values/name",
                    "names '" + value.name + "' twice for subobject " + std::to_string(i));
}

void write_arrays(const PhysicalModel& model, const AtomicFile& file, const fs::path& target) {
  ArrayFileWriter writer(file.descriptor(), kSealBytes, target);
  writer.attribute("format", kFormat);
  writer.attribute("version", kModelFileVersion);
  writer.attribute("units", "SI");
  const ValuesOfParts values = values_of(model);
  lay_out(writer, model, values);
  writer.close();
}

void require_version(std::int64_t version, const fs::path& file) {
  if (version == kModelFileVersion) return;
  throw InputError({file.string(),
                    "is a model file of version " + std::to_string(version) +
                        ", this is known up to version " + std::to_string(kModelFileVersion),
                    "use a newer Limber, or write the file anew with this one"});
}

// What the seal says, said again for other programs.
void require_attributes(const ArrayFileReader& reader, const fs::path& file) {
  if (reader.text_attribute("format") != kFormat)
    reader.refuse("", "attribute 'format' is not '" + std::string(kFormat) + "'");
  require_version(reader.number_attribute("version"), file);
  if (reader.text_attribute("units") != "SI") reader.refuse("", "attribute 'units' is not 'SI'");
}

PhysicalModel read_arrays(const OpenFile& file) {
  ArrayFileReader reader(file, kSealBytes);
  require_attributes(reader, file.path());
  PhysicalModel model;
  ValuesOfParts values;
  lay_out(reader, model, values);
  reader.require_all_read();
  give_values(model, values, reader);
  return model;
}

Seal known_seal(const OpenFile& file) {
  const Seal seal = read_seal(file);
  if (seal.kind != kKind)
    throw InputError({file.path().string(),
                      "is a file of Limber's, but of the kind '" + seal.kind + "'",
                      "name a model file, or use a newer Limber"});
  require_version(seal.version, file.path());
  return seal;
}

void require_valid_for(const PhysicalModel& model, const fs::path& file) {
  const std::vector<Diagnostic> found = validate(model, 1);
  if (found.empty()) return;
  Diagnostic first = found.front();
  first.where = file.string() + ": " + first.where;
  throw InputError(first);
}

}  // namespace

void write_model(const PhysicalModel& model, const fs::path& target) {
  require_valid_for(model, target);
  AtomicFile file(target);
  write_arrays(model, file, target);
  seal(file.descriptor(), kKind, kModelFileVersion, target);
  file.commit();
}

Seal model_file_seal(const fs::path& file) { return known_seal(OpenFile(file)); }

PhysicalModel read_model_unchecked(const fs::path& path) {
  const OpenFile file(path);
  require_intact(file, known_seal(file));
  try {
    return read_arrays(file);
  } catch (const std::bad_alloc&) {
    throw InputError({path.string(), "does not fit into memory", "use a machine with more"});
  }
}

PhysicalModel read_model(const fs::path& file) {
  PhysicalModel model = read_model_unchecked(file);
  require_valid_for(model, file);
  return model;
}

}  // namespace limber
