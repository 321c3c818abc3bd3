// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SerialMode.h"

namespace qplc {

/// What both ends of a serial line have to agree upon.
struct SerialSettings
{
    enum Parity : quint8 { NoParity, Even, Odd };

    int baud = 9600;  // [bit/s]
    int dataBits = 8;
    Parity parity = NoParity;
    int stopBits = 1;
    SerialMode mode;

    /// "8N1", "7E2", ... \return false when it is something else; nothing has changed then
    bool setFormat(const QString &text);
    /// "4800 8N1"
    QString toString() const;
};

/// A serial line: bytes in and out, without waiting. It belongs to this program alone as long as it
/// is open.
///
/// `/dev/ttyUSB0`, a pseudo-terminal, or `fake:NAME`: the name NAME in FakeMemory::folder(), a
/// symbolic link to a pseudo-terminal as a rule.
class SerialLine
{
public:
    SerialLine() = default;
    ~SerialLine();
    SerialLine(const SerialLine &) = delete;
    SerialLine &operator=(const SerialLine &) = delete;

    /// Bytes that have come before are thrown away. \return false, with the reason and the remedy
    /// in \a error
    bool open(const QString &device, const SerialSettings &settings, QString *error);
    void close();
    bool isOpen() const { return m_descriptor >= 0; }

    /// \return how many bytes have come, at most \a size; 0: none; -1, with errno, when the line is
    ///         gone (ENODEV: unplugged)
    int read(char *bytes, int size) noexcept;
    /// Calls \a take with each byte that has come, up to a limit: a line that never rests does not
    /// hold the caller.
    /// \return how many bytes have come; -1, with errno, when the line is gone
    template<typename Take>
    int readEach(Take take);
    /// \return how many bytes were taken; -1, with errno, when the line is gone
    int write(const char *bytes, int size) noexcept;
    /// Bytes that were taken and have not left yet, as far as the kernel knows.
    int waiting() const noexcept;

    /// Rates that devices have usually [bit/s]. Other ones are possible, too.
    static bool isUsualRate(int baud);
    static QString usualRates();
    /// What to do when a line is gone, for QPlcDriver::remedy(). Empty for errors that are no
    /// errors of a line.
    static QString remedy(int errorNumber);

private:
    static constexpr int MostBytesAtOnce = 4096;  // of readEach()

    bool setUp(const SerialSettings &settings, QString *error);

    int m_descriptor = -1;
    QString m_device;
};

template<typename Take>
int SerialLine::readEach(Take take)
{
    char bytes[256];
    int taken = 0;
    for (int count = 1; count > 0 && taken < MostBytesAtOnce; taken += count) {
        count = read(bytes, sizeof bytes);
        if (count < 0)
            return -1;
        for (int i = 0; i < count; ++i)
            take(bytes[i]);
    }
    return taken;
}

}  // namespace qplc
