#include "core/storage/array_file_writer.h"

#include "core/model/errors.h"
#include "core/storage/atomic_file.h"

namespace limber {
namespace {

// A group keeps this many links in its own header; more would need a heap and a tree.
constexpr unsigned kMostLinks = 256;

// Times of creation would make each rewrite another file.
void make_plain(hid_t properties) {
  H5Pset_obj_track_times(properties, false);
  H5Pset_link_phase_change(properties, kMostLinks, 0);
}

Hdf5Handle create_file(Hdf5Sink& sink, std::size_t user_block) {
  const Hdf5Handle access = access_through(sink);
  // The format of HDF5 1.8: every version since reads it, and its headers carry checksums.
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  const Hdf5Handle properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(properties, user_block);
  make_plain(properties);
  return {H5Fcreate("limber", H5F_ACC_TRUNC, properties, access), H5Fclose};
}

hid_t type_of(NumberType type) {
  switch (type) {
    case NumberType::kFloat64:
      return H5T_IEEE_F64LE;
    case NumberType::kInt32:
      return H5T_STD_I32LE;
    case NumberType::kInt64:
      return H5T_STD_I64LE;
    case NumberType::kUint8:
      break;
  }
  return H5T_STD_U8LE;
}

Hdf5Handle dataset_properties() {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  H5Pset_layout(properties, H5D_CONTIGUOUS);
  H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);  // all of it is written
  return properties;
}

Hdf5Handle space_of(const ArrayShape& shape) {
  const std::vector<std::uint64_t> shown = shape.extents();
  const std::vector<hsize_t> extents(shown.begin(), shown.end());
  if (extents.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose};
}

}  // namespace

ArrayFileWriter::ArrayFileWriter(int descriptor, std::size_t user_block,
                                 std::filesystem::path target)
    : target_(std::move(target)), sink_{descriptor, 0} {
  file_ = create_file(sink_, user_block);
  checked(file_);
}

void ArrayFileWriter::refuse() const {
  if (sink_.error != 0) refuse_writing(target_, sink_.error);
  throw InputError({target_.string(), "cannot be written (HDF5: " + hdf5_complaint() + ")",
                    "choose another disk, or report it if none will do"});
}

hid_t ArrayFileWriter::checked(hid_t id) const {
  if (id < 0) refuse();
  return id;
}

void ArrayFileWriter::attribute(const char* name, const std::string& text) {
  write_text(file_, name, text);
}

void ArrayFileWriter::attribute(const char* name, std::int32_t number) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate2(file_, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(attribute);
  checked(H5Awrite(attribute, H5T_NATIVE_INT32, &number));
}

void ArrayFileWriter::write_text(hid_t object, const char* name, const std::string& text) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, text.size());
  H5Tset_cset(type, H5T_CSET_UTF8);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  checked(attribute);
  checked(H5Awrite(attribute, type, text.data()));
}

Hdf5Handle ArrayFileWriter::group_of(const std::string& path) {
  const std::size_t slash = path.find('/');
  const std::string name = slash == std::string::npos ? "/" : path.substr(0, slash);
  if (name == "/" || H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0)
    return {checked(H5Gopen2(file_, name.c_str(), H5P_DEFAULT)), H5Gclose};
  const Hdf5Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  make_plain(properties);
  return {checked(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT)), H5Gclose};
}

Hdf5Handle ArrayFileWriter::create(const std::string& path, const char* unit, NumberType type,
                                   const ArrayShape& shape) {
  const Hdf5Handle group = group_of(path);
  const std::string name = path.substr(path.find('/') + 1);  // npos + 1 is 0
  Hdf5Handle dataset(checked(H5Dcreate2(group, name.c_str(), type_of(type), space_of(shape),
                                        H5P_DEFAULT, dataset_properties(), H5P_DEFAULT)),
                     H5Dclose);
  write_text(dataset, "unit", unit);
  return dataset;
}

void ArrayFileWriter::write_rows(hid_t dataset, NumberType type, const ArrayShape& shape,
                                 std::size_t first, std::size_t count, const void* numbers) {
  const hsize_t size[] = {count, shape.numbers_a_row()};
  const hsize_t offset[] = {first, 0};
  const hsize_t in_all[] = {count * shape.numbers_a_row()};
  const Hdf5Handle in_memory(H5Screate_simple(1, in_all, nullptr), H5Sclose);
  const Hdf5Handle in_file(H5Dget_space(dataset), H5Sclose);
  if (shape.width != kScalar)
    checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, offset, nullptr, size, nullptr));
  checked(H5Dwrite(dataset, type_of(type), in_memory, in_file, H5P_DEFAULT, numbers));
  if (sink_.error != 0) refuse();  // early: the rest would be in vain
}

void ArrayFileWriter::close() {
  if (!file_.close() || sink_.error != 0) refuse();
}

}  // namespace limber
