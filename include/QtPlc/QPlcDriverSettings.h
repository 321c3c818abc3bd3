// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcHardwareGlobal.h"
#include "QPlcParseError.h"

#include <QtCore/QPair>
#include <QtCore/QStringList>

#include <chrono>
#include <memory>

namespace qplc {
class HardwareConfiguration;
}

/// The keys of one driver in the configuration of a node, for example `bitrate = 500000`.
/// QPlcDriver::configure() reads them.
///
/// \code
/// class CanLamp : public QPlcDriver
/// {
/// public:
///     CanLamp() : QPlcDriver(EveryCycle) {}
///
/// private:
///     QString m_device;
///     qint64 m_bitrate = 0;  // [bit/s]
///     void configure(QPlcDriverSettings &settings) override
///     {
///         m_device = settings.requiredText("device", "can0");
///         m_bitrate = settings.integer("bitrate", 500000, 10000, 1000000);
///     }
///     bool open() override { return true; }
///     void close() override {}
/// };
/// \endcode
///
/// Each function reads one key. A missing key has its default value. A wrong value gives an error
/// with file, line, offending text and remedy; the function then returns the default, and the whole
/// configuration is refused in the end. A key that no function has read is an error, too: it is
/// misspelt.
///
/// \threadsafe no: use it in the thread of the node, inside of configure()
///
/// \ingroup hardware
class QTPLC_HARDWARE_EXPORT QPlcDriverSettings
{
public:
    /// Destroys the settings; the configuration keeps the errors.
    ~QPlcDriverSettings();
    Q_DISABLE_COPY(QPlcDriverSettings)

    /// Returns the name of the device: that of its section in the configuration.
    QString name() const;
    /// Returns true if the section has the key. The key does not count as read.
    bool has(const QString &key) const;

    /// Returns a text as it stands in the file.
    QString text(const QString &key, const QString &defaultValue = QString());
    /// Returns a text; a missing or empty one is an error.
    /// \param example  a value for the error message
    QString requiredText(const QString &key, const QString &example);
    /// Returns a number with a decimal point.
    /// \param minimum,  maximum allowed range, both included
    double number(const QString &key, double defaultValue, double minimum, double maximum);
    /// Returns a whole number, decimal or with 0x hexadecimal.
    /// \param minimum,  maximum allowed range, both included
    qint64 integer(const QString &key, qint64 defaultValue, qint64 minimum, qint64 maximum);
    /// Returns a truth value: yes, no, true, false, on, off, 1 or 0.
    bool truth(const QString &key, bool defaultValue);
    /// Returns a duration, which has a unit: "10 ms", "250us", "2 s". Units are ns, us, ms, s, min
    /// and h.
    /// \param minimum,  maximum allowed range, both included
    std::chrono::nanoseconds duration(const QString &key, std::chrono::nanoseconds defaultValue,
                                      std::chrono::nanoseconds minimum, std::chrono::nanoseconds maximum);
    /// Returns which word of \a words the value is.
    /// \param defaultValue  index of a word
    /// \return index in \a words
    int choice(const QString &key, const QStringList &words, int defaultValue = 0);
    /// Returns words that are separated by commas; an empty list for a missing key.
    QStringList list(const QString &key);
    /// Returns the name of a file; a relative one begins at the folder of the configuration. Empty
    /// if the key is missing.
    QString fileName(const QString &key);
    /// Returns the keys of the section that begin with \a prefix, without it, in the order of the
    /// file: for keys that contain a name, such as `line.brake = 4`. They do not count as read.
    QStringList namesBehind(const QString &prefix) const;

    /// Returns the names of the channels that the sections read, write and safe of the device use,
    /// in the order of the file, also of channels that do not exist.
    QStringList usedChannels() const;

    /// Adds an error that the driver finds in the value of a key.
    /// \param key  empty: the section as a whole
    /// \param message  what is wrong, and what to do
    void addError(const QString &key, const QString &message);
    /// Adds a warning: the configuration is accepted, and people are told.
    /// \param key  empty: the section as a whole
    /// \param message  what is doubtful, and what to do
    void addWarning(const QString &key, const QString &message);
    /// Claims something that can be used once, for example a line of a chip. A second claim, also
    /// by another device of the node, is an error that names both lines.
    /// \param key  that uses it
    /// \param what  a name of it for people: "line 17 of gpiochip0"
    /// \param user  who may claim it again, for example "the master"; empty: nobody
    void claim(const QString &key, const QString &what, const QString &user = QString());
    /// Adds errors of another file that the configuration names, for example a DBC file.
    void addErrors(const QVector<QPlcParseError> &errors);

private:
    friend class qplc::HardwareConfiguration;
    struct Q_DECL_HIDDEN Private;
    Q_DECL_HIDDEN explicit QPlcDriverSettings(std::unique_ptr<Private> data);
    std::unique_ptr<Private> d;
};
