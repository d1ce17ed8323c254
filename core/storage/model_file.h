#pragma once

#include <filesystem>

#include "core/model/physical_model.h"
#include "core/storage/sealed_file.h"

namespace limber {

// Files of models: HDF5 behind a seal, described in docs/model_file.md. What is read has the same
// bits as what was written, and the same model gives the same bytes.
inline constexpr int kModelFileVersion = 1;

// Replaces the target as a whole or not at all. Throws InputError where the model violates an
// invariant or the file cannot be written.
void write_model(const PhysicalModel& model, const std::filesystem::path& target);

// Throws InputError, naming the file, where it is not a whole, unchanged model file of a version
// that is known, or where the model in it violates an invariant. Needs memory for the model and at
// most 1 MiB beside, whatever a damaged file claims: less than thirty times the size of the file.
PhysicalModel read_model(const std::filesystem::path& file);

// The same without the invariants, for those who want to see all that is wrong (validate()).
PhysicalModel read_model_unchecked(const std::filesystem::path& file);

// What the file says it is, if that is a model of a version that is known; otherwise InputError.
Seal model_file_seal(const std::filesystem::path& file);

}  // namespace limber
