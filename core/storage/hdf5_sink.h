#pragma once

#include "core/storage/hdf5_handle.h"

namespace limber {

// Where HDF5 writes a new file to: a descriptor that is open for reading and writing. libhdf5 1.10
// crashes at the end of the program after a file that it could not close, on a full disk for
// instance. So it never hears of an error; who wrote asks for it.
struct Hdf5Sink {
  int descriptor = -1;
  int error = 0;  // the system's number of the first failure, 0 if there was none
};

// Properties for H5Fcreate(), which then ignores its name. The sink has to outlive the file.
Hdf5Handle access_through(Hdf5Sink& sink);

}  // namespace limber
