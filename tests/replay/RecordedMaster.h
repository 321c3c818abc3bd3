// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeFixtures.h"
#include "recording/PlantRecorder.h"

#include <QtCore/QTemporaryDir>

#include <map>
#include <mutex>

inline QPlcSignalTable probeTable()
{
    return QPlcSignalTable::fromIni(
        "[time]\ntype = DateTime\n[jitter]\ntype = Real64\n[set]\ntype = Real64\n"
        "[moved]\ntype = Real64\nslope = 50 per second\n[s0]\ntype = Real64\nhold = 2\nsafe = -3\n"
        "[s1]\ntype = Real64\nhold = 3\nsafe = 8\n[s2]\ntype = Real64\n[s3]\ntype = Real64\n"
        "[s4]\ntype = Real64\nmax = 40\nmin = -40\n[s5]\ntype = Real64\n[note]\ntype = String(5)\n");
}

/// Computes its outputs from all of its inputs, and keeps the inputs of each cycle.
class Probe : public QPlcCompactSlaveNode
{
public:
    struct In
    {
        const char *name;
        QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle;
    };
    Probe(const char *name, const std::vector<In> &inputs, const std::vector<const char *> &outputs)
        : QPlcCompactSlaveNode(name, SilentZeroOrderHold)
    {
        for (const In &input : inputs)
            m_inputs.push_back(std::make_unique<QPlcInput<double>>(this, input.name, input.timing));
        for (const char *output : outputs)
            m_outputs.push_back(std::make_unique<QPlcOutput<double>>(this, output));
    }
    ~Probe() override { disconnectFromMaster(); }
    std::function<void(const QPlcCycle &)> onStep;
    double gain = 0.1;
    double offset = 0.0;  // of its first sum
    double missedGain = 0.25;
    /// The values of all inputs, by cycle, as they lie in a payload.
    std::map<quint64, QByteArray> seen()
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        return m_seen;
    }

private:
    void reset() override { m_sum = offset; }
    void step(const QPlcCycle &cycle) override
    {
        compute(cycle);
        write();
    }
    void outputs() override { write(); }
    void update(const QPlcCycle &cycle) override { compute(cycle); }
    void compute(const QPlcCycle &cycle)
    {
        QByteArray values;
        m_sum *= 0.9;
        for (const auto &input : m_inputs) {
            const double value = *input;
            m_sum += gain * value;
            values.append(reinterpret_cast<const char *>(&value), sizeof value);
        }
        m_sum += double(cycle.number() % 13) + missedGain * double(cycle.missedCycles());
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_seen[cycle.number()] = values;
        if (onStep)
            onStep(cycle);
    }
    void write()
    {
        double factor = 1.0;
        for (const auto &output : m_outputs)
            *output = m_sum * (factor *= 0.5);
    }

    std::vector<std::unique_ptr<QPlcInput<double>>> m_inputs;
    std::vector<std::unique_ptr<QPlcOutput<double>>> m_outputs;
    std::mutex m_mutex;
    std::map<quint64, QByteArray> m_seen;
    double m_sum = 0.0;
};

/// A master whose phase is recorded.
class RecordedMaster : public TestMaster
{
public:
    explicit RecordedMaster(QPlcClock clock, const QPlcSignalTable &table = probeTable())
        : TestMaster(clock, table)
    {
        setProfile(QPlcProfile::Simulation);
        setInterval(std::chrono::milliseconds(2));
        setLocalName(QString("recorded-%1").arg(QCoreApplication::applicationPid()));
        if (table.indexOf("time") != QPlcInvalidSignalIndex) {
            setTimeSignal("time");
            activateJitterMeasurement("jitter");
        }
        const auto isReady = [this](const QString &file) {
            ring = QFile::encodeName(file);
            if (recordsAtOnce)
                record();
        };
        connect(this, &QPlcMasterNode::ringIsReady, this, isReady, Qt::DirectConnection);
    }
    void record()
    {
        if (!recorder.attach(ring, &error)
            || !recorder.begin(qplc::mcap::FileSink::create(recording(), &error), &error))
            qFatal("%s", qPrintable(error));
    }
    ~RecordedMaster() override { recorder.removeRing(); }
    bool admitOver(QPlcSlaveNode &node, const QString &kind)
    {
        if (kind == "in process")
            return addLocalNode(&node);
        return node.connectToMasterAndWaitForConnected(
            kind == "shared memory" ? QPlcUnderlyingProtocol::local(QString::number(serverPort())) : protocol(kind));
    }
    QString recording() const { return folder.filePath("flight.mcap"); }
    bool finish()
    {
        stop();
        qplc::PlantRecorder::Progress progress = qplc::PlantRecorder::Recorded;
        while (progress == qplc::PlantRecorder::Recorded)
            progress = recorder.proceed(&error);
        return progress == qplc::PlantRecorder::Ended && recorder.finish(&error);
    }

    bool recordsAtOnce = true;
    QTemporaryDir folder;
    qplc::PlantRecorder recorder;
    QByteArray ring;  // its file
    QString error;
};

/// Nodes in three stages, and a two-phase one that closes the loop.
struct Chain
{
    Chain() { integrator.setTwoPhase(true); }
    std::vector<QPlcSlaveNode *> all() { return {&first, &second, &third, &integrator}; }

    Probe first{"First", {{"s0"}, {"set"}, {"moved"}, {"jitter"}}, {"s1", "s2"}};
    Probe second{"Second", {{"s1", QPlcInputTiming::SameCycle}, {"s2"}, {"s4"}}, {"s3"}};
    Probe third{"Third", {{"s3", QPlcInputTiming::SameCycle}, {"s1", QPlcInputTiming::SameCycle}, {"s0"}}, {"s4"}};
    Probe integrator{"Integrator", {{"s4", QPlcInputTiming::SameCycle}, {"moved"}}, {"s0"}};
};
