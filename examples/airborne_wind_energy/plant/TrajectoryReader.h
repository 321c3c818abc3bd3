// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Trajectory.h"

#include <iosfwd>
#include <string>
#include <string_view>

namespace awe {

/// Reads the text of a Trajectory line by line and stops at the first thing that is wrong.
class TrajectoryReader
{
public:
    TrajectoryReader(std::istream &stream, const std::string &name);

    /// \return false when the text is wrong; message() then says what, where, and how to mend it
    bool read(Trajectory &trajectory);

    const std::string &message() const { return m_message; }

private:
    bool nextLine();
    bool fail(const std::string &what);
    bool accept(const std::string &wrong);
    bool readComments(Trajectory &trajectory);
    bool readWindLine(Trajectory &trajectory);
    bool readInitialState(Trajectory &trajectory);
    bool readColumnNames();
    bool readRows(Trajectory &trajectory);
    bool readRow(Trajectory::Row &row);
    bool checkParameters(const Trajectory &trajectory);
    bool readNumber(std::string_view text, const char *what, double &value);
    bool readNumbers(std::string_view text, const char *what, double *values, std::size_t count);

    std::istream &m_stream;
    std::string m_name;
    std::string m_line;
    long m_lineNumber = 0;
    std::string m_message;
};

}  // namespace awe
