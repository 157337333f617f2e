// What the user says of a file's columns: which holds what, and in what unit.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/machine/read_test.hpp"

namespace havers::io {

/// The column of each quantity, from 0.
using Chosen = std::map<Quantity, std::size_t>;

/// What a force or a strain is called while its factor is not known: load_volts, volts.
Quantity in_volts(Quantity quantity);

/// The names and units of the columns, for a sentence.
std::string list_of(const std::vector<Column>& columns);

/// How the user says something of the columns: "force = 2 in [specimen.columns]" or, of a test that
/// is in no study, "--set columns.force=2".
std::string column_setting(const ReadOptions& options, std::string_view key,
                           std::string_view value);

/// Where the user speaks of the columns: "in [specimen.columns]", "by --set columns.KEY=VALUE".
std::string column_place(const ReadOptions& options);

/// The key by which the user names a column of the quantity.
Quantity key_of(Quantity quantity);

/// The complaint about a unit that is not known.
std::string unknown_unit(const Column& column);
/// The key by which the user corrects a unit of the quantity, as the hint of a complaint.
std::string unit_hint_of(Quantity quantity, const ReadOptions& options);

/// Gives the columns that their names tell the user's units. @throws InputError when a unit is not
/// one of its quantity, or no column has such a name.
void take_units(TestFile& file, const std::string& where, const ReadOptions& options);

/// Gives the columns that the user names their quantities and units. @throws InputError when there
/// is no such column, or its unit is not one of the quantity.
Chosen take_hints(TestFile& file, const std::string& where, const ReadOptions& options);

}  // namespace havers::io
