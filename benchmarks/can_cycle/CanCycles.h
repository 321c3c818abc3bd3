// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/DriverRunner.h"
#include "hardware/HardwareConfiguration.h"
#include "realtime/Histogram.h"

#include <QtCore/QJsonObject>

/// Cycles at a fixed rate, with or without a CAN driver in them, and how they went.
class CanCycles
{
public:
    CanCycles(const QString &device, int frames, qint64 period);

    /// \param withCan the driver exchanges its frames in each cycle \return false with
    ///         errorString()
    bool begin(bool withCan);
    /// Stops the cycles of begin().
    void end();
    QString errorString() const { return m_error; }

    /// Since the object was made.
    QJsonObject result() const;
    /// Frames that the driver has received since the last begin().
    quint64 received() const { return quint64(m_received); }
    quint64 cycles(bool withCan) const { return m_lateness[withCan].count(); }

private:
    /// A frame whose stamp is judged when the next one has told how long it was under way.
    struct Seen
    {
        quint32 count = 0;
        qint64 delay = 0;  // of the stamp after the making of the frame [us]
    };

    static QByteArray configurationText(const QString &device, int frames);
    bool makeDriver();
    void run();
    void exchange(qint64 now, quint32 cycle);
    void look(std::size_t message, qint64 now);
    void judge(const Seen &seen, quint32 count, quint32 took);
    void addFigures(QJsonObject *fields, const QString &name, const qplc::Histogram &histogram) const;

    QString m_device;
    int m_frames;
    qint64 m_period;
    QString m_error;
    std::unique_ptr<qplc::HardwareConfiguration> m_configuration;
    std::unique_ptr<qplc::DriverRunner> m_runner;
    std::vector<Seen> m_last;  // of each message
    double m_received = 0.0;
    bool m_withCan = false;
    std::atomic<bool> m_stop{false};
    std::thread m_thread;

    qplc::Histogram m_lateness[2];  // without and with CAN
    qplc::Histogram m_execution[2];
    quint64 m_skipped[2] = {0, 0};
    quint64 m_wentBack = 0;  // a count that was smaller than the one before
    quint64 m_judgedAges = 0;
    quint64 m_wrongAges = 0;  // stamps from before the frame was made, or after it was sent
    qplc::Histogram m_age;
    quint64 m_lost = 0;
    quint64 m_unsent = 0;
};
