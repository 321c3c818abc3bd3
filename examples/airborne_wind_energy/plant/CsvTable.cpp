// SPDX-License-Identifier: Apache-2.0
#include "CsvTable.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace awe {

std::string readNumber(std::string_view text, const char *what, double *value)
{
    const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), *value);
    if (end.ec == std::errc() && end.ptr == text.data() + text.size() && std::isfinite(*value))
        return {};
    return std::string(what) + " is '" + std::string(text) + "'; write a finite number such as 1.5e-3";
}

std::string readCsvRow(std::string_view line, const char *const *names, double *values, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        const bool isLast = i + 1 == count;
        const std::size_t comma = line.find(',');
        if ((comma == std::string_view::npos) != isLast) {
            const std::string all = std::to_string(count);
            return isLast ? "more than " + all + " values; remove the surplus"
                          : "only " + std::to_string(i + 1) + " of " + all + " values; complete the row";
        }
        const std::string wrong = readNumber(line.substr(0, comma), names[i], &values[i]);
        if (!wrong.empty())
            return wrong;
        if (!isLast)
            line.remove_prefix(comma + 1);
    }
    return {};
}

std::string checkCsvNames(const std::string &line, const char *const *names, std::size_t count)
{
    std::istringstream found(line);
    std::string name;
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::getline(found, name, ','))
            name.clear();
        if (name != names[i])
            return "column " + std::to_string(i + 1) + " is '" + name + "'; it must be '" + names[i] + "'";
    }
    if (std::getline(found, name, ','))
        return "column " + std::to_string(count + 1) + " is '" + name + "'; remove it, the table has "
            + std::to_string(count) + " columns";
    return {};
}

void writeCsvNames(std::ostream &stream, const char *const *names, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i)
        stream << (i > 0 ? "," : "") << names[i];
    stream << '\n';
}

void writeCsvRow(std::ostream &stream, const double *values, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0)
            stream << ',';
        std::array<char, 32> text{};
        const std::to_chars_result end
            = std::to_chars(text.data(), text.data() + text.size(), values[i], std::chars_format::general, 17);
        stream.write(text.data(), end.ptr - text.data());
    }
    stream << '\n';
}

std::string saveWhole(const std::string &path, const std::function<void(std::ostream &)> &write)
{
    const std::string temporary = path + ".part";
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    if (!file)
        return path + ": '" + temporary + "' cannot be opened for writing; check the folder and the permissions";
    write(file);
    file.close();
    if (!file) {
        std::remove(temporary.c_str());
        return path + ": writing failed; check the free space of the disk";
    }
    if (std::rename(temporary.c_str(), path.c_str()) != 0) {
        std::remove(temporary.c_str());
        return path + ": cannot be replaced; check that it is a file you may write";
    }
    return {};
}

}  // namespace awe
