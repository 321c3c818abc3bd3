// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanFrame.h"
#include "QPlcParseError.h"

namespace qplc {

/// One line of a log of a CAN bus: `(1436509052.249713) can0 044#2A366C2BBA`.
struct CanLogLine
{
    qint64 time = 0;  // of the wall clock [ns]
    QString interface;
    CanFrame frame;  // its own time is not used
};

/// The text format of `candump -L`, which `canplayer` and others read.
///
/// An id is 3 hexadecimal digits, or 8 for an extended one; R behind '#' is a remote frame, with
/// its size; '##' and a digit of flags (1: bit rate switch, 2: sender is error passive) is a frame
/// of CAN FD. An error frame is an extended id with bit 29. Times have 1 ... 9 digits behind the
/// point.
class CanLog
{
public:
    /// With line feed; times in microseconds, as candump writes them.
    static QByteArray text(const CanLogLine &line);
    /// \return false, with what is wrong in \a error (its column and message)
    static bool parse(const QByteArray &text, CanLogLine *line, QPlcParseError *error);
    /// All lines of a file; blank ones are skipped. Lines that are wrong are told in \a errors, of
    /// which there are at most MaximumErrors, and left out.
    static QVector<CanLogLine> read(const QByteArray &text, const QString &fileName, QVector<QPlcParseError> *errors);

    static constexpr int MaximumErrors = 20;
};

}  // namespace qplc
