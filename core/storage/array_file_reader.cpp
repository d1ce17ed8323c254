#include "core/storage/array_file_reader.h"

#include "core/model/errors.h"

namespace limber {

ArrayFileReader::ArrayFileReader(const OpenFile& file, std::size_t user_block)
    : file_(file), catalogue_(read_catalogue(file, user_block)) {}

void ArrayFileReader::refuse(const std::string& array, const std::string& what) const {
  const std::string file = file_.path().string();
  throw InputError(
      {array.empty() ? file : file + ": " + array, what, "write it as docs/model_file.md says"});
}

const StoredArray& ArrayFileReader::array_at(const std::string& path) const {
  const auto found = catalogue_.arrays.find(path);
  if (found == catalogue_.arrays.end()) refuse(path, "is missing");
  return found->second;
}

std::size_t ArrayFileReader::rows_at(const std::string& path) const {
  const StoredArray& array = array_at(path);
  return array.extents.empty() ? 1 : array.extents[0];
}

std::size_t ArrayFileReader::numbers_at(const std::string& path) const {
  const StoredArray& array = array_at(path);
  return array.bytes / bytes_of(array.type);
}

std::uint64_t ArrayFileReader::admit(const std::string& path, NumberType type,
                                     const ArrayShape& shape) {
  const StoredArray& array = array_at(path);
  if (array.type != type)
    refuse(path, std::string("holds ") + name_of(array.type) + ", not " + name_of(type));
  if (array.extents != shape.extents())
    refuse(path,
           "has " + text_of_extents(array.extents) + ", not " + text_of_extents(shape.extents()));
  read_.insert(path);
  return array.offset;
}

void ArrayFileReader::read(const std::string& path, std::uint64_t offset, void* into,
                           std::size_t bytes) const {
  if (read_at(file_.descriptor(), offset, into, bytes, file_.path()) != bytes)
    refuse(path, "is not wholly in the file");
}

void ArrayFileReader::require_all_read() const {
  for (const auto& [path, array] : catalogue_.arrays)
    if (!read_.contains(path)) refuse(path, "does not belong into such a file");
}

std::string ArrayFileReader::text_attribute(const char* name) const {
  const auto found = catalogue_.attributes.texts.find(name);
  if (found == catalogue_.attributes.texts.end())
    refuse("", std::string("has no attribute '") + name + "' that is a text of fixed length");
  return found->second;
}

std::int32_t ArrayFileReader::number_attribute(const char* name) const {
  const auto found = catalogue_.attributes.numbers.find(name);
  if (found == catalogue_.attributes.numbers.end())
    refuse("", std::string("has no attribute '") + name + "' that is an int32");
  return found->second;
}

}  // namespace limber
