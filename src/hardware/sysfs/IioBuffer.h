// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "IioScan.h"
#include "SysfsFolder.h"

#include <QtCore/QStringList>

#include <sys/types.h>

namespace qplc {

/// The buffer of an IIO device: the kernel puts a scan into it each time its trigger fires, and
/// read() takes the newest one.
///
/// open(), an add() for each channel, start(); then read() and value(). close() switches the buffer
/// off, and sets back what it has changed.
///
/// It does not use libiio: that library finds devices in /sys and /dev only, so that nothing could
/// play a device, and it reads all files of all devices before it opens one.
class IioBuffer
{
public:
    enum Result : quint8 {
        Scan,    ///< a new scan is there
        None,    ///< no new scan
        Failed,  ///< errno
        Full,    ///< the kernel has dropped scans, so that the newest one that is left is too old
        Torn     ///< not a whole scan: it has to be opened anew
    };
    static constexpr int ShortestLength = 2;  // [scans]
    static constexpr int LongestLength = 16384;

    struct Settings
    {
        QString trigger;    // empty: as the driver of the kernel has it
        int length = 1024;  // [scans]
    };

    IioBuffer() = default;
    ~IioBuffer();
    IioBuffer(const IioBuffer &) = delete;
    IioBuffer &operator=(const IioBuffer &) = delete;

    /// All functions that return false leave errno, file() and problem().
    /// \param root  "/sys" \param device  its folder; it stays open until close()
    bool open(const QString &root, const SysfsFolder *device, const Settings &settings);
    /// Channels that a scan can contain: "voltage0".
    QStringList channels() const;
    /// \return false if channels() does not contain it
    bool add(const QByteArray &channel, int *number);
    /// \param now  CLOCK_MONOTONIC [ns]
    bool start(qint64 now);
    void close();

    /// Neither waits nor allocates.
    Result read();
    /// Of the newest scan: the number that the kernel stores. \param number  of add()
    double value(int number) const noexcept { return m_scan.value(m_channels[std::size_t(number)], m_newest); }
    /// When the newest scan was measured, or \a now if the kernel does not tell [ns].
    qint64 time(qint64 now) const noexcept;

    /// The file that was used last, in the folder of the device or as a path.
    QByteArray file() const { return m_file; }
    /// What is wrong, and what to do, if errno is EBADMSG.
    QString problem() const { return m_problem; }

private:
    struct Element
    {
        QByteArray name;  // "in_voltage0"
        bool wasEnabled = false;
        bool isWanted = false;
        int place = -1;  // in the scan
    };
    struct Change
    {
        QByteArray file;
        QByteArray before;
    };

    bool openNode(const QString &path);
    bool findElements();
    bool setTrigger();
    bool setElements();
    bool setLength();
    bool enable();
    bool layOut();
    bool addPlace(Element *element);
    bool useTimestamp();
    ssize_t take(std::size_t most);

    bool readFile(const QByteArray &file, QByteArray *text);
    bool write(const QByteArray &file, const QByteArray &text);
    /// Remembers what was there.
    bool change(const QByteArray &file, const QByteArray &text);
    bool failWith(const QString &problem);
    QStringList triggers() const;

    QString m_root;
    Settings m_settings;
    const SysfsFolder *m_device = nullptr;
    QByteArray m_nodePath;
    int m_node = -1;             // descriptor of the character device
    QByteArray m_elementFolder;  // "scan_elements/"
    QByteArray m_bufferFolder;   // "buffer/"
    QByteArray m_enable;         // "buffer/enable"
    std::vector<Element> m_elements;
    std::vector<std::size_t> m_wanted;  // of add(): in m_elements
    std::vector<int> m_channels;        // of add(): in the scan
    std::vector<Change> m_changes;

    IioScan m_scan;
    int m_timestamp = -1;  // in the scan
    qint64 m_started = 0;  // [ns]
    std::vector<quint8> m_bytes;
    const quint8 *m_newest = nullptr;  // null before the first scan
    QByteArray m_file;
    QString m_problem;
};

}  // namespace qplc
