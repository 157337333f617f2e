// Finished simulations in an SQLite file: a kill at any moment loses only those in flight.
#pragma once

#include <filesystem>
#include <memory>

#include "calib/fit/evaluation_store.hpp"

namespace havers::io {

/// Opens or creates the store. Several processes may share one file.
/// @throws InputError when the file is not a store of ours or cannot be written.
std::unique_ptr<calib::EvaluationStore> open_store(const std::filesystem::path& file);

}  // namespace havers::io
