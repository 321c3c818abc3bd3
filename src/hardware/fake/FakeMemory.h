// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <atomic>
#include <cstddef>

namespace qplc {

/// Plays a device that is not there: a file of some bytes which the driver and whoever plays the
/// device (a test, a model, a person) share.
///
/// `device = fake:NAME` of a driver is the file NAME in folder(). Where there is no such file,
/// there is no such device: a file that is made is a device that is plugged in, one that is removed
/// was unplugged. What the bytes mean, is said by each driver. Whoever plays the device may also
/// read and write the file, without this class.
class FakeMemory
{
public:
    FakeMemory() = default;
    ~FakeMemory();
    FakeMemory(const FakeMemory &) = delete;
    FakeMemory &operator=(const FakeMemory &) = delete;

    /// Of the fake devices: the environment variable QTPLC_FAKE_DEVICES, else qtplc-devices in the
    /// folder of the user's session.
    static QString folder();
    /// If it is not there. \return false when it cannot be made, or is not of this user alone;
    /// errno tells why
    static bool makeFolder();
    /// Whether \a device is "fake:NAME".
    static bool isFake(const QString &device);
    /// File of "fake:NAME", or of NAME.
    static QString path(const QString &device);
    /// What a driver says when \a device is not there.
    static QString missingText(const QString &device);

    /// Plugs the device in: \a size bytes, all 0. A file that is there is replaced, and so
    /// unplugged. \return false, with the reason in \a error
    bool create(const QString &device, std::size_t size, QString *error);
    /// Takes the device as it is. \param size that it must have; 0: any \return false, with the
    /// reason and the remedy in \a error
    bool open(const QString &device, std::size_t size, QString *error);
    void close();
    /// Unplugs the device.
    static void remove(const QString &device);

    bool isOpen() const { return m_bytes; }
    /// false when the device has been unplugged since. Takes one system call.
    bool isThere() const noexcept;

    std::size_t size() const { return m_size; }
    /// \pre isOpen(), \a index < size()
    std::atomic<quint8> &at(std::size_t index) const noexcept { return m_bytes[index]; }

private:
    bool map(int descriptor, QString *error);

    int m_descriptor = -1;
    std::size_t m_size = 0;
    std::atomic<quint8> *m_bytes = nullptr;
};

static_assert(sizeof(std::atomic<quint8>) == 1 && std::atomic<quint8>::is_always_lock_free, "processes share these");

}  // namespace qplc
