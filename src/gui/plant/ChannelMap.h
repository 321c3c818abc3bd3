// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalTable.h"

#include <QtCore/QVector>

namespace qplc {

/// Where the signals of a table lie: in the payload of a listener that reads all of them in the
/// order of the table, and in the channels of a SignalStore, one for each element of each numeric
/// signal. A value type.
class ChannelMap
{
public:
    static constexpr int NoChannel = -1;

    ChannelMap() = default;
    explicit ChannelMap(const QPlcSignalTable &table);

    int channels() const { return m_channels; }
    int payloadSize() const { return m_payloadSize; }  // [byte]
    /// The channel of an element; NoChannel for texts, times, and what is not there.
    int channel(QPlcSignalIndex signal, int element = 0) const;
    /// Where the value begins. \pre the signal is in the table
    int offset(QPlcSignalIndex signal) const { return m_signals.at(signal).offset; }  // [byte]
    /// Writes one number for each channel.
    void toFloats(const char *payload, float *values) const;

private:
    struct Signal
    {
        int offset;  // [byte]
        int channel;
        int count;
    };
    /// Numbers of one type, side by side in the payload as in the channels.
    struct Run
    {
        QPlcSignalType::Scalar scalar;
        int offset;  // [byte]
        int channel;
        int count;
    };
    void addRun(const Run &run, int elementSize);

    QVector<Signal> m_signals;
    QVector<Run> m_runs;
    int m_channels = 0;
    int m_payloadSize = 0;
};

}  // namespace qplc
