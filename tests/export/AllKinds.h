// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <stdexcept>

/// Gives back what it reads, in each type that there is. A mode makes it fail.
class AllKinds : public QPlcSlaveNode
{
public:
    AllKinds()
        : QPlcSlaveNode("AllKinds")
    {
        if (qEnvironmentVariableIsSet("ALL_KINDS_REFUSES"))
            throw std::runtime_error("no device");
    }
    ~AllKinds() override { disconnectFromMaster(); }

protected:
    QPlcSignalIndexList declareInputSignals() override
    {
        QPlcSignalIndexList list;
        for (const char *name : names)
            m_inputs.append(list.insert(QString::fromLatin1(name)));
        m_mode = list.insert("mode");
        return list;
    }
    QPlcSignalIndexList declareOutputSignals() override
    {
        QPlcSignalIndexList list;
        for (const char *name : names)
            m_outputs.append(list.insert(QString::fromLatin1(name) + "Out"));
        m_count = list.insert("count");
        return list;
    }
    QPlcSignalList initialOutputSignals() override
    {
        m_cycles = 0;
        return {};
    }
    QPlcSignalList realTimeout(const QPlcSignalList &inputs) override
    {
        QPlcSignalList outputs;
        for (int i = 0; i < m_inputs.size(); ++i)
            outputs.insert(m_outputs.at(i), inputs.value(m_inputs.at(i)));
        outputs.insert(m_count, ++m_cycles);
        if (inputs.value(m_mode).toInt() == 1)
            throw std::runtime_error("mode 1 is an error");
        if (inputs.value(m_mode).toInt() == 2)
            requestSafeStop();
        return outputs;
    }

private:
    static constexpr const char *names[] = {"real", "array", "flag", "phase", "text", "big"};
    QVector<QPlcSignalIndex> m_inputs, m_outputs;
    QPlcSignalIndex m_mode = 0, m_count = 0;
    int m_cycles = 0;
};
