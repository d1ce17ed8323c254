#include "core/storage/hdf5_sink.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

// The header of drivers moved in HDF5 1.13.
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

// A "virtual file driver" of HDF5: the functions it calls instead of the system's.

namespace limber {
namespace {

struct SinkFile {
  H5FD_t common;  // HDF5's own, has to come first
  Hdf5Sink* sink;
  haddr_t end_of_addresses;
  haddr_t end_of_file;
};

SinkFile& of(H5FD_t* file) { return *reinterpret_cast<SinkFile*>(file); }
const SinkFile& of(const H5FD_t* file) { return *reinterpret_cast<const SinkFile*>(file); }

H5FD_t* open_sink(const char*, unsigned, hid_t access, haddr_t) {
  const void* info = H5Pget_driver_info(access);
  if (info == nullptr) return nullptr;
  auto* file = new SinkFile{};
  std::memcpy(&file->sink, info, sizeof file->sink);
  return &file->common;
}

herr_t close_sink(H5FD_t* file) {
  delete &of(file);
  return 0;
}

// As HDF5's own driver of plain files: gather small pieces.
herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) { return a == b ? 0 : a < b ? -1 : 1; }

haddr_t end_of_addresses(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_addresses; }

herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  of(file).end_of_addresses = end;
  return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_file; }

// What was never written, or could not be, reads as zeros.
herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* into) {
  auto* bytes = static_cast<char*>(into);
  while (size > 0) {
    const ssize_t n = ::pread(of(file).sink->descriptor, bytes, size, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    bytes += n, at += static_cast<haddr_t>(n), size -= static_cast<std::size_t>(n);
  }
  std::memset(bytes, 0, size);
  return 0;
}

void write_all(Hdf5Sink& sink, haddr_t at, const char* bytes, std::size_t size) {
  while (size > 0 && sink.error == 0) {
    const ssize_t n = ::pwrite(sink.descriptor, bytes, size, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      sink.error = errno;
      return;
    }
    bytes += n, at += static_cast<haddr_t>(n), size -= static_cast<std::size_t>(n);
  }
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* from) {
  write_all(*of(file).sink, at, static_cast<const char*>(from), size);
  of(file).end_of_file = std::max<haddr_t>(of(file).end_of_file, at + size);
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  Hdf5Sink& sink = *of(file).sink;
  if (sink.error == 0 &&
      ::ftruncate(sink.descriptor, static_cast<off_t>(of(file).end_of_addresses)) != 0)
    sink.error = errno;
  of(file).end_of_file = of(file).end_of_addresses;
  return 0;
}

H5FD_class_t sink_driver() {
  H5FD_class_t driver{};
#if H5_VERSION_GE(1, 13, 0)
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(512);  // from the range for one's own
#endif
  driver.name = "limber";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(Hdf5Sink*);
  driver.open = open_sink;
  driver.close = close_sink;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = end_of_addresses;
  driver.set_eoa = set_end_of_addresses;
  driver.get_eof = end_of_file;
  driver.read = read;
  driver.write = write;
  driver.truncate = truncate;
  std::fill(std::begin(driver.fl_map), std::end(driver.fl_map), H5FD_MEM_SUPER);
  std::fill(driver.fl_map + H5FD_MEM_DRAW, driver.fl_map + H5FD_MEM_DRAW + 1, H5FD_MEM_DRAW);
  return driver;
}

}  // namespace

Hdf5Handle access_through(Hdf5Sink& sink) {
  static const H5FD_class_t driver = sink_driver();
  const Hdf5Handle id(H5FDregister(&driver), H5FDunregister);
  Hdf5Sink* const info = &sink;
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_driver(access, id, &info);
  return access;
}

}  // namespace limber
