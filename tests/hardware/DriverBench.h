// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDriverSettings.h"
#include "hardware/DriverCatalog.h"
#include "hardware/DriverRunner.h"
#include "hardware/HardwareConfiguration.h"
#include "realtime/TimeSource.h"

#include <QtCore/QStringList>

#include <cmath>
#include <limits>

/// One driver on a bench, without a node: configured by text, called step by step, on a clock that
/// the test sets.
///
/// ```cpp
/// DriverBench bench("gpio", "device = fake:board\ninput.button = 3\n");
/// QVERIFY2(bench.errors().isEmpty(), qPrintable(bench.errors()));
/// bench.wireRead("button");
/// QVERIFY2(bench.open(), qPrintable(bench.errorString()));
/// bench.exchange();
/// QCOMPARE(bench.value("button"), 1.0);
/// ```
class DriverBench
{
public:
    /// \param keys  of the section of the driver
    DriverBench(const QString &kind, const QByteArray &keys, const QString &fileName = QStringLiteral("bench.ini"))
        : DriverBench(kind, keys, fileName, qplc::DriverCatalog::instance().kinds().value(kind).make)
    {
    }
    DriverBench(const QString &kind, const QByteArray &keys, const QString &fileName,
                const std::function<std::unique_ptr<QPlcDriver>()> &make)
        : m_configuration("[bench]\ndriver = " + kind.toUtf8() + "\n" + keys, fileName)
        , m_runner(QStringLiteral("bench"), kind, make())
    {
        if (!m_configuration.errors().isEmpty())
            return;
        const auto settings = m_configuration.settings(m_configuration.drivers().first());
        m_runner.configure(*settings);
        m_configuration.checkUse(*settings);
    }

    qplc::DriverRunner &runner() { return m_runner; }
    /// Returns the errors of the keys; empty if all are right.
    QString errors() const { return QPlcParseError::toString(m_configuration.errors()); }
    QVector<QPlcParseError> warnings() const { return m_configuration.warnings(); }
    QString errorString() { return m_runner.driver().errorString(); }

    /// All wires before open(). \return the error; empty if the channel is wired
    QString wireRead(const QString &channel) { return wire(channel, QPlcChannel::Read); }
    QString wireWrite(const QString &channel) { return wire(channel, QPlcChannel::Write); }

    bool open()
    {
        m_now = qplc::monotonicNow();
        return m_runner.openNow([this] { return m_now; });
    }
    void close() { m_runner.closeNow(); }
    bool isOnline() const { return m_runner.isOnline(); }

    /// Time of the next exchange(); it is that of open() at first.
    qint64 now() const { return m_now; }
    void advance(std::chrono::nanoseconds time) { m_now += time.count(); }

    /// For the next exchange(); before open() an exchange() makes it known to the device that is
    /// opened.
    void set(const QString &channel, double value, bool isSafe = false)
    {
        m_runner.setValue(m_writeNames.indexOf(channel), value, isSafe);
    }
    /// Writes and reads once, as a cycle or the thread of the driver would. \return false when the
    /// device was lost: errorString()
    bool exchange()
    {
        m_runner.write(m_now);
        if (m_runner.isOnline() && m_runner.driver().pace() == QPlcDriver::OwnPace
            && !(m_runner.writeNow(m_now) && m_runner.readNow(m_now)))
            m_runner.closeNow();
        m_runner.read(m_now);
        return m_runner.isOnline();
    }
    /// Of the last exchange(); NaN: there is no fresh one.
    double value(const QString &channel) const
    {
        const qplc::DriverRunner::Sample sample = m_runner.sample(m_readNames.indexOf(channel), m_now);
        return sample.isFresh ? sample.value : std::numeric_limits<double>::quiet_NaN();
    }
    bool isFresh(const QString &channel) const { return !std::isnan(value(channel)); }
    /// When the value was measured [ns].
    qint64 time(const QString &channel) const { return m_runner.sample(m_readNames.indexOf(channel), m_now).time; }

private:
    QString wire(const QString &channel, QPlcChannel::Direction direction)
    {
        QString error;
        const int number = m_runner.wire(channel, direction, &error);
        QStringList &names = direction == QPlcChannel::Read ? m_readNames : m_writeNames;
        if (number == names.size())
            names << channel;
        m_runner.prepare();
        return error;
    }

    qplc::HardwareConfiguration m_configuration;
    qplc::DriverRunner m_runner;
    QStringList m_readNames;
    QStringList m_writeNames;
    qint64 m_now = 0;  // [ns]
};
