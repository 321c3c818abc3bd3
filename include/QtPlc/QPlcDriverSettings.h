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

/// The keys of one driver in the configuration of a node: `bitrate = 500000`. See QPlcDriver::configure().
///
/// Each function reads one key. A key that is missing has its default value. One that cannot be meant gets an error with file, line, the offending text and what would be right;
/// the default is returned then, and the configuration is refused as a whole in the end. Keys that nobody has read are errors, too: they are misspelt.
/// Threads: that of the node.
class QTPLC_HARDWARE_EXPORT QPlcDriverSettings
{
public:
    ~QPlcDriverSettings();
    Q_DISABLE_COPY(QPlcDriverSettings)

    /// Name of the section.
    QString name() const;
    bool has(const QString &key) const;

    QString text(const QString &key, const QString &defaultValue = QString());
    /// As text(); a missing or empty one is an error. \param example  is shown there
    QString requiredText(const QString &key, const QString &example);
    double number(const QString &key, double defaultValue, double minimum, double maximum);
    /// Decimal, or hexadecimal with 0x.
    qint64 integer(const QString &key, qint64 defaultValue, qint64 minimum, qint64 maximum);
    /// yes, no, true, false, on, off, 1, 0
    bool truth(const QString &key, bool defaultValue);
    /// With its unit: "10 ms", "250us", "2 s".
    std::chrono::nanoseconds duration(const QString &key, std::chrono::nanoseconds defaultValue,
                                      std::chrono::nanoseconds minimum, std::chrono::nanoseconds maximum);
    /// One of a few words. \return the index of the word in \a words
    int choice(const QString &key, const QStringList &words, int defaultValue = 0);
    /// Words with commas between them.
    QStringList list(const QString &key);
    /// A file; a relative name begins at the folder of the configuration. Empty: the key is missing.
    QString fileName(const QString &key);
    /// Keys of the section that begin with \a prefix, without it, in the order of the file: for keys with names in them, like `line.brake = 4`.
    QStringList namesBehind(const QString &prefix) const;

    /// What the driver itself finds wrong with the value of \a key; empty: with the section as a whole.
    void addError(const QString &key, const QString &message);
    /// Errors of a file that the configuration names, a DBC file for example.
    void addErrors(const QVector<QPlcParseError> &errors);

private:
    friend class qplc::HardwareConfiguration;
    struct Private;
    explicit QPlcDriverSettings(std::unique_ptr<Private> data);
    std::unique_ptr<Private> d;
};
