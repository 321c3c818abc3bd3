// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace awe {

/// Reads one row of a table: \a count finite numbers with commas between them. Nothing depends on
/// the locale.
/// \param names  of the columns, for messages
/// \return empty when all is well, otherwise what is wrong and the remedy
std::string readCsvRow(std::string_view line, const char *const *names, double *values, std::size_t count);
/// Compares the line above the rows with the names of the columns.
/// \return empty when all is well, otherwise what is wrong and the remedy
std::string checkCsvNames(const std::string &line, const char *const *names, std::size_t count);

void writeCsvNames(std::ostream &stream, const char *const *names, std::size_t count);
/// With 17 significant digits, which is enough to get the same double back.
void writeCsvRow(std::ostream &stream, const double *values, std::size_t count);

/// Writes a file: first completely to a temporary one beside it, which then takes the name.
/// \return empty when all is well, otherwise one sentence; an older file of that name is then
///         untouched
std::string saveWhole(const std::string &path, const std::function<void(std::ostream &)> &write);

/// \return empty when \a text is a finite number, otherwise what is wrong and the remedy
std::string readNumber(std::string_view text, const char *what, double *value);

}  // namespace awe
